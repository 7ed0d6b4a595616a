#pragma once
#include <tamis/core/each_of.hpp>
#include <tamis/observe/atomic_file.hpp>
#include <tamis/observe/record.hpp>
#include <tamis/solver/integrate.hpp>

#include <cctype>
#include <charconv>
#include <concepts>
#include <cstdio>
#include <limits>
#include <set>
#include <sstream>
#include <string>

namespace tamis {

namespace detail {

inline constexpr const char* axis_names[] = {"x", "y", "z"};

/// Column names of a vector and of a symmetric tensor: the bare name in 1D, else with _x, _y, _z and _xx, _yy, ...,
/// _xy, ...
inline std::string vector_columns(const std::string& name, int dim) {
    if (dim == 1) return name;
    std::ostringstream all;
    for (int d = 0; d < dim; ++d) all << (d ? "," : "") << name << '_' << axis_names[d];
    return all.str();
}
inline std::string symmetric_columns(const std::string& name, int dim) {
    if (dim == 1) return name;
    std::ostringstream all;
    for (int d = 0; d < dim; ++d) all << (d ? "," : "") << name << '_' << axis_names[d] << axis_names[d];
    for (int d = 0; d < dim; ++d)
        for (int e = d + 1; e < dim; ++e) all << ',' << name << '_' << axis_names[d] << axis_names[e];
    return all.str();
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
template <class Tensor> void put_symmetric(std::string& out, const Tensor& value) {
    for (int d = 0; d < value.rows(); ++d) put_number(out += ',', value(d, d));
    for (int d = 0; d < value.rows(); ++d)
        for (int e = d + 1; e < value.rows(); ++e) put_number(out += ',', value(d, e));
}

/// Is this the name of a file that csv_output writes?
inline bool is_csv_output(const std::string& name) {
    const std::size_t begin = name.rfind("particles_", 0) == 0 ? 10 : name.rfind("nodes_", 0) == 0 ? 6 : 0;
    if (begin == 0 || name.size() < begin + 5 || name.substr(name.size() - 4) != ".csv") return false;
    for (std::size_t k = begin; k < name.size() - 4; ++k)
        if (!std::isdigit(static_cast<unsigned char>(name[k]))) return false;
    return true;
}

}  // namespace detail

/// An observer that writes two tables each time it is called, `particles_<step>.csv` and `nodes_<step>.csv`: time,
/// position, density, velocity, stress and strain, of particles also the mass, in full precision under a line of column
/// names. Node values are mass-weighted means over the particles in a node's reach; nodes without mass are left out.
/// With several bodies a column `body` (0, 1, ...) comes first. Density and strain are left out where neither a stored
/// field nor the law tells them.
///
///     csv_output tables(mpm, bodies(bar), "out");
///     integrate(mpm, bodies(bar), {0, 2}, courant{0.1}, every(100, std::ref(tables)));
///     tables.commit();
///
/// The files of a run appear together at `commit`, in place of those of an earlier run in that folder; without it there
/// are none. Throws `error` where they cannot be written. Solver and bodies must outlive it.
template <class Lattice, class Shape, class... Body> class csv_output {
  public:
    template <class Solver> csv_output(const Solver& mpm, std::tuple<Body&...> all, std::filesystem::path folder)
        : csv_output(mpm.lattice(), mpm.functions(), all, std::move(folder)) {}
    csv_output(const Lattice& lattice, const Shape& functions, std::tuple<Body&...> all, std::filesystem::path folder)
        : lattice_(lattice), functions_(functions), all_(all), folder_(std::move(folder)) {
        std::error_code failed;
        made_folder_ = std::filesystem::create_directories(folder_, failed);
        // A folder that may not be written to is told before the run, not after it.
        atomic_file probe(folder_ / "particles_probe");
    }
    csv_output(const csv_output&) = delete;
    csv_output& operator=(const csv_output&) = delete;
    ~csv_output() {
        drafts_.clear();
        std::error_code ignored;
        if (made_folder_ && names_.empty()) std::filesystem::remove(folder_, ignored);
    }

    void operator()(const progress_state& now) {
        write("particles", now, [&] { put_particles(now.time); });
        write("nodes", now, [&] { put_nodes(now.time); });
    }
    /// Puts the files in place.
    void commit() {
        for (atomic_file& draft : drafts_) draft.commit();
        for (atomic_file& draft : drafts_) names_.insert(draft.path().filename().string());
        drafts_.clear();
        std::vector<std::filesystem::path> stale;
        for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
            const std::string name = entry.path().filename().string();
            if (detail::is_csv_output(name) && names_.count(name) == 0) stale.push_back(entry.path());
        }
        for (const auto& path : stale) std::filesystem::remove(path);
    }

  private:
    static constexpr int dim = Lattice::D;
    static constexpr bool has_density = (tells_density<Body> && ...), has_strain = (tells_strain<Body> && ...);
    const Lattice& lattice_;
    const Shape& functions_;
    std::tuple<Body&...> all_;
    std::filesystem::path folder_;
    bool made_folder_ = false;
    std::vector<atomic_file> drafts_;
    std::set<std::string> names_;
    std::string text_;  // of the table being written

    template <class Put> void write(const char* what, const progress_state& now, Put put) {
        char name[64];
        std::snprintf(name, sizeof name, "%s_%09ld.csv", what, now.step);
        atomic_file& draft = drafts_.emplace_back(folder_ / name);
        text_.clear();
        put();
        draft.out().write(text_.data(), static_cast<std::streamsize>(text_.size()));
        draft.close();
    }
    void put_columns() {
        text_ += "time," + detail::vector_columns("position", dim);
        if constexpr (has_density) text_ += ",density";
        text_ += ',' + detail::vector_columns("velocity", dim) + ',' + detail::symmetric_columns("stress", dim);
        if constexpr (has_strain) text_ += ',' + detail::symmetric_columns("strain", dim);
    }
    template <class Record> void put_row(double time, const Record& r) {
        detail::put_number(text_, time);
        detail::put_vector(text_, r.position);
        if constexpr (has_density) detail::put_number(text_ += ',', r.density);
        detail::put_vector(text_, r.velocity);
        detail::put_symmetric(text_, r.stress);
        if constexpr (has_strain) detail::put_symmetric(text_, r.strain);
    }
    void put_particles(double time) {
        constexpr bool several = sizeof...(Body) > 1;
        text_ += several ? "body," : "";
        put_columns();
        text_ += ",mass\n";
        int k = 0;
        const auto put = [&](const auto& body) {
            for (const auto p : body) {
                const auto r = record_of(body, p);
                if (several) text_ += std::to_string(k) + ',';
                put_row(time, r);
                detail::put_number(text_ += ',', r.mass);
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
