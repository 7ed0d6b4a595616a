#pragma once
#include "galerkin.hpp"

#include <tamis/conservation/integrate.hpp>
#include <tamis/observe/progress.hpp>
#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/linear.hpp>
#include <tamis/shape/quadratic_spline.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace galerkin {

/// f(shape, mass) for those that the options name.
template <class F> auto with_scheme(const galerkin_options& o, const F& f) {
    const auto with_mass = [&](const auto& shape) {
        if (o.mass == "lumped") return f(shape, tamis::lumped_mass{});
        return f(shape, tamis::full_mass<tamis::dynamic>{o.order});
    };
    if (o.shape == "quadratic") return with_mass(tamis::quadratic_spline{});
    if (o.shape == "cubic") return with_mass(tamis::cubic_spline{});
    return with_mass(tamis::linear{});
}

/// Runs a scheme from exact(x, 0), a vector of its unknowns, and measures it against exact(x, time), relative to
/// `scale`. `look(t)` sees the run, at about 100 times.
template <class Scheme, class Exact, class Look> void drive(Scheme& scheme, const galerkin_options& o,
                                                            const Exact& exact, const std::vector<std::string>& names,
                                                            double scale, const Look& look, galerkin_result& result) {
    using tamis::fixed_steps;
    using tamis::interval;
    constexpr int count = Scheme::count;
    const long steps = o.step_count();
    scheme.set([&](const auto& at) { return exact(at[0], 0); });
    const auto total = scheme.total();
    const auto clock = std::chrono::steady_clock::now();
    result.steps = tamis::integrate(scheme, interval{0, o.time}, fixed_steps{steps},
                                    tamis::every(std::max(1L, steps / 100), look), tamis::progress_bar{});
    result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    result.dt = o.time / static_cast<double>(steps);
    result.bytes_per_particle = Scheme::bytes_per_particle();
    result.bytes_per_node = Scheme::bytes_per_node();

    scheme.each_particle([&](const auto& at, const auto& u) {
        const auto right = exact(at[0], o.time);
        galerkin_point p{at[0], {}, {}};
        for (int c = 0; c < count; ++c) {
            p.value.push_back(u[c]);
            p.exact.push_back(right[c]);
        }
        result.particles.push_back(p);
    });
    std::sort(result.particles.begin(), result.particles.end(),
              [](const galerkin_point& a, const galerkin_point& b) { return a.x < b.x; });
    const double particles = static_cast<double>(result.particles.size()), nodes = o.cells + 1;
    for (std::size_t c = 0; c < names.size(); ++c) {
        const auto k = static_cast<Eigen::Index>(c);
        galerkin_unknown unknown{.name = names[c]};
        double low = std::numeric_limits<double>::max(), high = -low;
        for (const galerkin_point& p : result.particles) {
            const double off = std::abs(p.value[c] - p.exact[c]) / scale;
            unknown.l1 += off / particles;
            unknown.l2 += off * off / particles;
            // Written so that a NaN is kept.
            if (!(off <= unknown.max)) unknown.max = off;
            low = std::min(low, p.exact[c]);
            high = std::max(high, p.exact[c]);
        }
        for (int i = 0; i <= o.cells; ++i) {
            const double u = scheme.on_node({i, 0, 0})[k];
            const double off = (u - exact(static_cast<double>(i) / o.cells, o.time)[k]) / scale;
            unknown.node_l2 += off * off / nodes;
            unknown.overshoot = std::max({unknown.overshoot, (u - high) / scale, (low - u) / scale});
        }
        unknown.l2 = std::sqrt(unknown.l2);
        unknown.node_l2 = std::sqrt(unknown.node_l2);
        unknown.total_initial = total[k];
        unknown.total_final = scheme.total()[k];
        unknown.gain = scheme.gain()[k];
        result.unknowns.push_back(unknown);
    }
}

}  // namespace galerkin
