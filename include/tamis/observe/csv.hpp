#pragma once
#include <tamis/core/each_of.hpp>
#include <tamis/observe/atomic_file.hpp>
#include <tamis/observe/record.hpp>
#include <tamis/run/integrate.hpp>
#include <tamis/run/walk.hpp>

#include <cctype>
#include <charconv>
#include <concepts>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>

namespace tamis {

namespace detail {

/// Names of a field's columns, after commas.
template <class Field> std::string columns_of() {
    std::string all;
    for (int c = 0; c < Field::components; ++c) all += ',' + Field::column(c);
    return all;
}
/// The shortest digits that read back as the same number: streams take several times as long, which short runs of small
/// bodies would feel.
template <class Real> void put_number(std::string& out, const Real& value) {
    if constexpr (std::floating_point<Real>) {
        char digits[64];
        out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    } else {
        std::ostringstream text;
        text.precision(std::numeric_limits<double>::max_digits10);
        text << value;
        out += text.str();
    }
}
template <class Vector> void put_vector(std::string& out, const Vector& value) {
    for (int d = 0; d < value.rows(); ++d) put_number(out += ',', value[d]);
}
template <class Field, class Tensor> void put_symmetric(std::string& out, const Tensor& value) {
    for (int c = 0; c < Field::components; ++c) {
        const auto [row, column] = place_in_tensor(Field::kind, Field::rows, c);
        put_number(out += ',', value(row, column));
    }
}

/// Is this the name of a file that csv_output writes?
inline bool is_csv_output(const std::string& name) {
    const std::size_t begin = name.rfind("particles_", 0) == 0 ? 10 : name.rfind("nodes_", 0) == 0 ? 6 : 0;
    if (begin == 0 || name.size() < begin + 5 || name.substr(name.size() - 4) != ".csv") return false;
    for (std::size_t k = begin; k < name.size() - 4; ++k)
        if (!std::isdigit(static_cast<unsigned char>(name[k]))) return false;
    return true;
}

/// The files of a run's tables, drafts until they are put in place together.
class csv_files {
  public:
    explicit csv_files(std::filesystem::path folder) : folder_(std::move(folder)) {
        std::error_code failed;
        made_folder_ = std::filesystem::create_directories(folder_, failed);
        // A folder that may not be written to is told before the run, not after it.
        { const atomic_file probe(folder_ / "particles_probe"); }
        // A run that was killed could not take its drafts away.
        remove([](const std::string& name) {
            for (const std::string end : {".part", ".before"})
                if (name.size() > end.size() && name.substr(name.size() - end.size()) == end)
                    return is_csv_output(name.substr(0, name.size() - end.size()));
            return false;
        });
    }
    csv_files(const csv_files&) = delete;
    csv_files& operator=(const csv_files&) = delete;
    ~csv_files() {
        drafts_.clear();
        std::error_code ignored;
        if (made_folder_ && names_.empty()) std::filesystem::remove(folder_, ignored);
    }
    /// The number of the tables of now: the step's, counted on from run to run.
    long number_of(const progress_state& now) {
        const bool is_new_run = now.step < step_ || (now.step == step_ && now.time != time_);
        number_ += is_new_run ? 1 : now.step - step_;
        step_ = now.step;
        time_ = now.time;
        return number_;
    }
    void add(const std::string& name, const std::string& text) {
        drafts_.erase(name);
        atomic_file& draft = drafts_.emplace(name, folder_ / name).first->second;
        draft.out().write(text.data(), static_cast<std::streamsize>(text.size()));
        draft.close();
    }
    void commit() {
        std::vector<atomic_file*> all;
        for (auto& [name, draft] : drafts_) all.push_back(&draft);
        commit_together(all);
        for (const auto& [name, draft] : drafts_) names_.insert(name);
        drafts_.clear();
        remove([this](const std::string& name) { return is_csv_output(name) && names_.count(name) == 0; });
    }

  private:
    std::filesystem::path folder_;
    bool made_folder_ = false;
    std::map<std::string, atomic_file> drafts_;
    std::set<std::string> names_;
    long number_ = -1, step_ = -1;  // of the last tables
    double time_ = 0;

    /// Removes the files of the folder whose names is_stale(name).
    template <class IsStale> void remove(const IsStale& is_stale) const {
        std::error_code failed;
        std::vector<std::filesystem::path> stale;
        for (auto entry = std::filesystem::directory_iterator(folder_, failed);
             !failed && entry != std::filesystem::directory_iterator(); entry.increment(failed))
            if (entry->is_regular_file(failed) && is_stale(entry->path().filename().string()))
                stale.push_back(entry->path());
        for (const auto& path : stale) std::filesystem::remove(path, failed);
    }
};

}  // namespace detail

/// An observer that writes two tables each time it is called, `particles_<step>.csv` and `nodes_<step>.csv`: time,
/// position, density, velocity, stress and strain, of particles also the mass and every further field that all bodies
/// store (ids, a law's, one's own; not the reference volume), in full precision under a line of column names. Node
/// values are mass-weighted means over the particles in a node's reach; nodes without mass are left out. With several
/// bodies a column `body` (0, 1, ...) comes first. Density and strain are left out where neither a stored field nor the
/// law tells them.
///
///     integrate(mpm, bodies(bar), {0, 2}, courant{0.1}, every(100, csv_output{mpm, bodies(bar), "out"}));
///
/// The files of a run appear together at its end, in place of those of an earlier run in that folder; where it fails
/// there are none. Who keeps the tables, for runs in several parts, whose steps count on, says when:
///
///     csv_output tables(mpm, bodies(bar), "out");
///     integrate(mpm, bodies(bar), {0, 2}, courant{0.1}, every(100, std::ref(tables)));
///     tables.commit();
///
/// A copy writes to the same tables. Throws `error` where they cannot be written. Solver and bodies must outlive it.
template <class Lattice, class Shape, class... Body> class csv_output {
  public:
    /// Of these bodies, into a folder that is made if need be. Throws `error` if it may not be written to.
    template <class Solver> csv_output(const Solver& mpm, std::tuple<Body&...> all, std::filesystem::path folder)
        : csv_output(mpm.lattice(), mpm.functions(), all, std::move(folder)) {}
    /// The same, of what the solver tells.
    csv_output(const Lattice& lattice, const Shape& functions, std::tuple<Body&...> all, std::filesystem::path folder)
        : lattice_(lattice),
          functions_(functions),
          all_(all),
          files_(std::make_shared<detail::csv_files>(std::move(folder))) {}

    void operator()(const progress_state& now) {
        const long number = files_->number_of(now);
        write("particles", number, [&] { put_particles(now.time); });
        write("nodes", number, [&] { put_nodes(now.time); });
    }
    /// Puts the files in place, of all copies.
    void commit() { files_->commit(); }

  private:
    static constexpr int dim = Lattice::D;
    using first_body = std::tuple_element_t<0, std::tuple<Body...>>;
    template <class F> using column = stored_field<first_body, F>;
    /// Fields that have their place in the tables' first columns.
    using listed = fields<field::position, field::mass, field::velocity, field::volume, field::stress, field::density,
                          field::strain>;
    static constexpr bool has_density = (tells_density<Body> && ...), has_strain = (tells_strain<Body> && ...);
    const Lattice& lattice_;
    const Shape& functions_;
    std::tuple<Body&...> all_;
    std::shared_ptr<detail::csv_files> files_;
    std::string text_;  // of the table being written

    /// f of the type of every further field that all bodies store.
    template <class F> static void each_further(F&& f) {
        detail::each_field<stored_fields<first_body>>::run([&](auto tag) {
            using field_type = typename decltype(tag)::type;
            if constexpr (!contains<listed, field_type> && (contains<stored_fields<Body>, field_type> && ...)) f(tag);
        });
    }
    template <class Put> void write(const char* what, long number, Put put) {
        char name[64];
        std::snprintf(name, sizeof name, "%s_%09ld.csv", what, number);
        text_.clear();
        put();
        files_->add(name, text_);
    }
    void put_columns() {
        text_ += "time" + detail::columns_of<column<field::position>>();
        if constexpr (has_density) text_ += detail::columns_of<column<field::density>>();
        text_ += detail::columns_of<column<field::velocity>>() + detail::columns_of<column<field::stress>>();
        if constexpr (has_strain) text_ += detail::columns_of<column<field::strain>>();
    }
    template <class Record> void put_row(double time, const Record& r) {
        detail::put_number(text_, time);
        detail::put_vector(text_, r.position);
        if constexpr (has_density) detail::put_number(text_ += ',', r.density);
        detail::put_vector(text_, r.velocity);
        detail::put_symmetric<column<field::stress>>(text_, r.stress);
        if constexpr (has_strain) detail::put_symmetric<column<field::strain>>(text_, r.strain);
    }
    void put_particles(double time) {
        constexpr bool several = sizeof...(Body) > 1;
        text_ += several ? "body," : "";
        put_columns();
        text_ += detail::columns_of<column<field::mass>>();
        each_further([&](auto tag) { text_ += detail::columns_of<column<typename decltype(tag)::type>>(); });
        text_ += '\n';
        int k = 0;
        const auto put = [&](const auto& body) {
            using body_type = std::remove_cvref_t<decltype(body)>;
            for (const auto p : body) {
                const auto r = record_of(body, p);
                if (several) text_ += std::to_string(k) + ',';
                put_row(time, r);
                detail::put_number(text_ += ',', r.mass);
                each_further([&](auto tag) {
                    using field_type = stored_field<body_type, typename decltype(tag)::type>;
                    for (const auto& value : field_type::values(p)) detail::put_number(text_ += ',', value);
                });
                text_ += '\n';
            }
            ++k;
        };
        detail::each_of(all_, put);
    }
    void put_nodes(double time) {
        put_columns();
        text_ += '\n';
        for (const auto& node : node_records(lattice_, functions_, all_)) {
            put_row(time, node.mean);
            text_ += '\n';
        }
    }
};
template <class Solver, class... Body> csv_output(const Solver& mpm, std::tuple<Body&...>, std::filesystem::path)
    -> csv_output<std::remove_cvref_t<decltype(mpm.lattice())>, std::remove_cvref_t<decltype(mpm.functions())>,
                  Body...>;

}  // namespace tamis
