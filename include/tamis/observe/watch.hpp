#pragma once
#include <tamis/core/each_of.hpp>
#include <tamis/observe/record.hpp>
#include <tamis/solver/integrate.hpp>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>

namespace tamis {

/// A particle with a field that is not a finite number.
struct bad_particle {
    int body;               // 0, 1, ...: which one of bodies(...)
    long particle;          // place in the body's order
    std::string field, at;  // the field's name; the particle's place, as text
};
/// What a watch tells: bad particles now, and the particles that went to another cell since it told the last time.
struct watch_report {
    long step;
    double time;
    std::vector<bad_particle> bad;
    std::size_t crossings;
};

/// One line for each bad particle, and one for cell crossings.
inline std::ostream& operator<<(std::ostream& out, const watch_report& report) {
    for (const bad_particle& p : report.bad)
        out << "step " << report.step << ", t = " << report.time << ": particle " << p.particle << " of body " << p.body
            << " at (" << p.at << "): its " << p.field << " is not a finite number\n";
    if (report.crossings > 0)
        out << "step " << report.step << ", t = " << report.time << ": " << report.crossings
            << " particles have gone to another cell since the last report\n";
    return out;
}

namespace detail {

/// The first of a particle's fields that is not finite; empty if there is none.
template <class S, class Store, class... F>
std::string bad_field(const Store& store, std::uint32_t slot, int l, fields<F...>) {
    std::string found;
    const auto look = [&](auto tag) {
        using field_type = typename decltype(tag)::type;
        const auto* first = store.lane_of(slot, l) + Store::slot::template first<field_type>() * S::width;
        for (int c = 0; c < field_type::template components<S> && found.empty(); ++c) {
            const auto value = first[c * S::width];
            if (value - value != typename S::real(0)) found = std::string(field_type::name);
        }
    };
    (look(std::type_identity<F>{}), ...);
    return found;
}

template <class... Body> std::vector<bad_particle> bad_particles(const std::tuple<Body&...>& all) {
    std::vector<bad_particle> bad;
    int k = 0;
    const auto look = [&](const auto& body) {
        using body_type = std::remove_cvref_t<decltype(body)>;
        long n = 0;
        for (const auto p : body) {
            const std::string field = bad_field<typename body_type::space_type>(body.store(), p.slot(), p.lane_index(),
                                                                                typename body_type::field_list{});
            if (!field.empty()) bad.push_back({k, n, field, list_of(p[symbols::x])});
            ++n;
        }
        ++k;
    };
    each_of(all, look);
    return bad;
}

}  // namespace detail

/// An observer that looks for particles that are not numbers, and counts particles that change cells. It calls
/// report(watch_report) when there is something to tell; without a report of your own it writes to the stream given.
///
///     integrate(mpm, bodies(bar), {0, 2}, courant{0.1}, every(100, watch(mpm, bodies(bar), std::cerr)));
///
/// Solver and bodies must outlive it.
template <class... Body> class watch {
  public:
    template <class Solver>
    watch(const Solver& mpm, std::tuple<Body&...> all, std::function<void(const watch_report&)> report)
        : all_(all),
          report_(std::move(report)),
          crossings_([&mpm] { return mpm.crossings(); }),
          told_(mpm.crossings()) {}
    template <class Solver> watch(const Solver& mpm, std::tuple<Body&...> all, std::ostream& out)
        : watch(mpm, all, [&out](const watch_report& report) { out << report; }) {}

    void operator()(const progress_state& now) {
        const std::size_t crossings = crossings_();
        const watch_report report{now.step, now.time, detail::bad_particles(all_), crossings - told_};
        told_ = crossings;
        if (!report.bad.empty() || report.crossings > 0) report_(report);
    }

  private:
    std::tuple<Body&...> all_;
    std::function<void(const watch_report&)> report_;
    std::function<std::size_t()> crossings_;
    std::size_t told_;
};
template <class Solver, class... Body, class Report> watch(const Solver&, std::tuple<Body&...>, Report&&)
    -> watch<Body...>;

}  // namespace tamis
