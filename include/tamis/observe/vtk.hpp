#pragma once
#include <tamis/core/each_of.hpp>
#include <tamis/observe/atomic_file.hpp>
#include <tamis/observe/vtk_file.hpp>
#include <tamis/run/integrate.hpp>
#include <tamis/run/walk.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <system_error>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace tamis {

namespace detail {

/// How VTK has a field's values: vectors have three components, symmetric tensors six, other tensors nine.
template <class Field> struct vtk_layout {
    static constexpr int components = Field::kind == field_kind::vector      ? 3
                                      : Field::kind == field_kind::symmetric ? 6
                                      : Field::kind == field_kind::tensor    ? 9
                                                                             : Field::components;
    /// Where component c of the field goes.
    static constexpr int place(int c) {
        if (Field::kind == field_kind::scalar || Field::kind == field_kind::vector || Field::kind == field_kind::other)
            return c;
        const auto [row, column] = place_in_tensor(Field::kind, Field::rows, c);
        if (Field::kind == field_kind::tensor) return 3 * row + column;
        return row == column ? row : row + column == 1 ? 3 : row + column == 3 ? 4 : 5;
    }
    static std::vector<std::string> names() {
        switch (Field::kind) {
            case field_kind::vector:
                return {"X", "Y", "Z"};
            case field_kind::symmetric:
                return {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
            case field_kind::tensor:
                return {"XX", "XY", "XZ", "YX", "YY", "YZ", "ZX", "ZY", "ZZ"};
            default:
                return {};
        }
    }
};
/// Kinds of numbers that VTK has not, dual ones for example, are written as double.
template <class Number> auto to_vtk(const Number& a) {
    if constexpr (std::is_same_v<Number, float>)
        return a;
    else
        return to_double(a);
}
/// A particle's number; -1 where somebody wrote what is none.
template <class Number> std::int64_t to_whole(const Number& a) {
    const double value = to_double(a);
    return value >= 0 && value <= 9007199254740992. ? static_cast<std::int64_t>(value) : -1;
}

/// A series of files, one a frame, `<name>_<number>.vtp`, and the list of them by time, `<name>.pvd`.
class vtk_series {
  public:
    explicit vtk_series(std::filesystem::path list) : list_(std::move(list)) {
        if (list_.extension() != ".pvd" || list_.stem().empty())
            throw error(sentence("vtk_output: the series of files is called ", list_.string(),
                                 "; give it a name that ends in .pvd"));
        // A place that may not be written to is told before the run, not at its first frame.
        atomic_file probe(list_);
    }
    /// Adds a frame, in the place of those of its time or later: a run that goes on tells of the same time twice, and
    /// one that begins anew of all.
    void add(double time, const vtk_points& points) {
        while (!times_.empty() && times_.back() >= time) {
            times_.pop_back();
            is_new_ = true;
        }
        const std::filesystem::path frame = list_.parent_path() / name_of(times_.size());
        write(frame, [&](std::ostream& out) { points.write(out); });
        times_.push_back(time);
        write(list_, [&](std::ostream& out) { put_list(out); });
        if (std::exchange(is_new_, false)) remove_others();
    }

  private:
    std::filesystem::path list_;
    std::vector<double> times_;
    bool is_new_ = true;  // there may be files of an earlier run

    template <class Put> static void write(const std::filesystem::path& path, const Put& put) {
        atomic_file file(path);
        put(file.out());
        file.commit();
    }
    std::string name_of(std::size_t number) const {
        char digits[32];
        std::snprintf(digits, sizeof digits, "_%09zu.vtp", number);
        return list_.stem().string() + digits;
    }
    void put_list(std::ostream& out) const {
        out << vtk_root("Collection", "0.1") << ">\n<Collection>\n";
        for (std::size_t k = 0; k < times_.size(); ++k)
            out << "<DataSet timestep=\"" << digits_of(times_[k]) << "\" group=\"\" part=\"0\" file=\""
                << xml_text(name_of(k)) << "\"/>\n";
        out << "</Collection>\n</VTKFile>\n";
    }
    /// Is this the name of one of the series' files that the list does not have?
    bool is_left_over(const std::string& name) const {
        const std::string begin = list_.stem().string() + '_', end = ".vtp";
        if (name.size() != begin.size() + 9 + end.size() || name.compare(0, begin.size(), begin) != 0 ||
            name.compare(name.size() - end.size(), end.size(), end) != 0)
            return false;
        const std::string number = name.substr(begin.size(), 9);
        return std::all_of(number.begin(), number.end(), [](unsigned char c) { return std::isdigit(c) != 0; }) &&
               std::stoul(number) >= times_.size();
    }
    void remove_others() const {
        const auto folder = list_.has_parent_path() ? list_.parent_path() : std::filesystem::path(".");
        std::vector<std::filesystem::path> others;
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            if (entry.is_regular_file() && is_left_over(entry.path().filename().string()))
                others.push_back(entry.path());
        std::error_code ignored;
        for (const auto& path : others) std::filesystem::remove(path, ignored);
    }
};

}  // namespace detail

/// An observer that writes the particles for ParaView each time it is called: `bar_000000000.vtp`, `bar_000000001.vtp`,
/// ... and `bar.pvd`, which lists them by time and is what to open. Every particle is a vertex with its place, the
/// number of its body (`body`: 0, 1, ...), and the fields named, or else all that the bodies store, as they lie in
/// memory: floats stay floats, what is not a number stays that. Components out of the grid's dimensions are 0; where
/// another body has a field and this one has not, it is NaN, and an id -1.
///
///     integrate(mpm, bodies(bar), {0, 2}, courant{0.1}, every(100, vtk_output{mpm, bodies(bar), "out/bar.pvd"}));
///
///     vtk_output slim(mpm, bodies(bar), "out/slim.pvd", fields<field::velocity, field::id>{});
///
/// Unlike tables' files, each frame's appear at once, whole, and the list after them: it can be opened at any time of
/// the run. A new series takes the place of an old one of its name. A copy goes on with the same series. Throws `error`
/// where files cannot be written. The bodies must outlive it.
template <class List, class... Body> class vtk_output;

/// Of the fields F.
template <class... F, class... Body> class vtk_output<fields<F...>, Body...> {
  public:
    /// Of all that the bodies store; `series` is the name of the list, ending in .pvd.
    template <class Solver> vtk_output(const Solver&, std::tuple<Body&...> all, std::filesystem::path series)
        : all_(all), series_(std::make_shared<detail::vtk_series>(std::move(series))) {
        (check<F>(), ...);
    }
    /// Of the fields named.
    template <class Solver, class... Chosen>
    vtk_output(const Solver& mpm, std::tuple<Body&...> all, std::filesystem::path series, fields<Chosen...>)
        : vtk_output(mpm, all, std::move(series)) {}

    void operator()(const progress_state& now) const {
        std::uint64_t count = 0;
        detail::each_of(all_, [&](const auto& body) { count += body.size(); });
        detail::vtk_points points(count, now.time);
        std::set<std::string> names;
        points.template set_places<number<field::position>>(put<field::position>());
        points.template add<std::int32_t>(unique("body", names), "", 1, {}, [this](std::vector<std::int32_t>& to) {
            std::int32_t k = 0;
            detail::each_of(all_, [&](const auto& body) { to.insert(to.end(), body.size(), k++); });
        });
        (add<F>(points, names), ...);
        series_->add(now.time, points);
    }

  private:
    using first_body = std::tuple_element_t<0, std::tuple<Body...>>;
    std::tuple<Body&...> all_;
    std::shared_ptr<detail::vtk_series> series_;

    template <class G> using shown = stored_field<first_body, G>;
    template <class G> using number =
        std::conditional_t<std::same_as<G, field::id>, std::int64_t,
                           decltype(detail::to_vtk(std::declval<typename first_body::real>()))>;

    template <class G> static void check() {
        static_assert((contains<stored_fields<Body>, G> || ...),
                      "tamis: vtk_output is asked for a field that none of the bodies stores; name it in make_body's "
                      "last argument, fields<...>{}");
    }
    template <class G> void add(detail::vtk_points& points, std::set<std::string>& names) const {
        using layout = detail::vtk_layout<shown<G>>;
        if constexpr (!std::same_as<G, field::position>)
            points.template add<number<G>>(unique(std::string(G::name), names), shown<G>::unit(), layout::components,
                                           layout::names(), put<G>());
    }
    /// Fields may have the same name, as those of several loads.
    static std::string unique(const std::string& name, std::set<std::string>& names) {
        std::string free = name;
        for (int k = 2; !names.insert(free).second; ++k) free = name + '_' + std::to_string(k);
        return free;
    }
    /// Appends the values of all particles.
    template <class G> std::function<void(std::vector<number<G>>&)> put() const {
        return [this](std::vector<number<G>>& to) {
            detail::each_of(all_, [&](const auto& body) { put_body<G>(body, to); });
        };
    }
    template <class G, class B> static void put_body(const B& body, std::vector<number<G>>& to) {
        using layout = detail::vtk_layout<shown<G>>;
        constexpr auto width = static_cast<std::size_t>(layout::components);
        if constexpr (contains<stored_fields<B>, G>) {
            for (const auto p : body) {
                const auto values = stored_field<B, G>::values(p);
                std::array<number<G>, width> row{};
                for (std::size_t c = 0; c < values.size(); ++c) {
                    number<G>& at = row[static_cast<std::size_t>(layout::place(static_cast<int>(c)))];
                    if constexpr (std::same_as<G, field::id>)
                        at = detail::to_whole(values[c]);
                    else
                        at = detail::to_vtk(values[c]);
                }
                to.insert(to.end(), row.begin(), row.end());
            }
        } else
            to.insert(to.end(), width * body.size(),
                      std::same_as<G, field::id> ? number<G>(-1) : std::numeric_limits<number<G>>::quiet_NaN());
    }
};
template <class Solver, class... Body> vtk_output(const Solver&, std::tuple<Body&...>, std::filesystem::path)
    -> vtk_output<merge<stored_fields<std::remove_const_t<Body>>...>, Body...>;
template <class Solver, class... Body, class... F>
vtk_output(const Solver&, std::tuple<Body&...>, std::filesystem::path, fields<F...>)
    -> vtk_output<merge<fields<F...>>, Body...>;

}  // namespace tamis
