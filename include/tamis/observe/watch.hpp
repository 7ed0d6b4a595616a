#pragma once
#include <tamis/core/each_of.hpp>
#include <tamis/observe/record.hpp>
#include <tamis/run/integrate.hpp>
#include <tamis/run/walk.hpp>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>

namespace tamis {

/// A particle with a field that is not a finite number.
struct bad_particle {
    /// 0, 1, ...: which one of bodies(...).
    int body;
    /// Place in the body's order.
    long particle;
    /// The field's name; the particle's place, as text.
    std::string field, at;
};
/// What a watch tells: bad particles now, and the particles that went to another cell since it told the last time.
struct watch_report {
    /// Steps done.
    long step;
    /// Time (s).
    double time;
    /// Particles that are not numbers.
    std::vector<bad_particle> bad;
    /// Particles that went to another cell since the last report.
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
template <class Body, class Particle> std::string bad_field(const Body& body, const Particle& p) {
    std::string found;
    each_stored_field(body, [&](auto field) {
        if (!found.empty()) return;
        for (const auto& value : field.values(p))
            if (value - value != typename Body::real(0)) found = std::string(field.name);
    });
    return found;
}

template <class... Body> std::vector<bad_particle> bad_particles(const std::tuple<Body&...>& all) {
    std::vector<bad_particle> bad;
    int k = 0;
    const auto look = [&](const auto& body) {
        long n = 0;
        for (const auto p : body) {
            const std::string field = bad_field(body, p);
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
    /// With a report of your own.
    template <class Solver>
    watch(const Solver& mpm, std::tuple<Body&...> all, std::function<void(const watch_report&)> report)
        : all_(all),
          report_(std::move(report)),
          crossings_([&mpm] { return mpm.crossings(); }),
          told_(mpm.crossings()) {}
    /// Writes to a stream.
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
