#include "elastic_taylor_galerkin.hpp"
#include "exact.hpp"
#include "front.hpp"
#include "galerkin_run.hpp"

namespace {

template <class Scheme> std::vector<bar_particle> particles_of(const Scheme& scheme) {
    std::vector<bar_particle> all;
    scheme.each_particle([&](const auto& at, const auto& u) { all.push_back({at[0], u[1], u[0]}); });
    std::sort(all.begin(), all.end(), [](const bar_particle& a, const bar_particle& b) { return a.x < b.x; });
    return all;
}
template <class Scheme> double energy_of(const Scheme& scheme) {
    double sum = 0;
    for (int i = 0; i <= scheme.grid().cells(0); ++i)
        sum += scheme.mass_of_node({i, 0, 0}) * scheme.on_node({i, 0, 0}).squaredNorm() / 2;
    return sum;
}

}  // namespace

elastic_taylor_galerkin_result run_elastic_taylor_galerkin(const elastic_taylor_galerkin_options& o) {
    using namespace tamis;
    using state = conservation::state<2, double>;
    const bool shock = o.profile == "shock";
    const auto exact = [&](double x, double t) {
        const auto part = [&](const exact::state& s) { return state(s.strain, s.velocity); };
        if (!shock) return part(exact::standing_wave{o.amplitude}(x, t));
        // A node on the jump takes the mean of its sides.
        const exact::shock jump{-o.amplitude};
        return state((part(jump(x - 1e-12, t)) + part(jump(x + 1e-12, t))) / 2);
    };
    return galerkin::with_scheme(o, [&](const auto& shape, const auto& mass) {
        const auto rest = [](double) { return 0; };
        const conservation::ends both{conservation::give<1>(rest), conservation::give<1>(rest)};
        taylor_galerkin scheme{uniform_grid<1>{{0.}, {1.}, 1. / o.cells},
                               conservation::elastic_bar{},
                               per_cell{o.per_cell},
                               shape,
                               mass,
                               both};
        elastic_taylor_galerkin_result result;
        std::vector<front_places> fronts;
        const auto look = [&](double t) {
            if (t == 0)
                result.energy_initial = energy_of(scheme);
            else if (shock)
                fronts.push_back(find_fronts(t, particles_of(scheme), o.amplitude));
        };
        galerkin::drive(scheme, o, exact, {"stress", "velocity"}, shock ? o.amplitude / 2 : o.amplitude, look, result);
        result.energy_final = energy_of(scheme);
        if (shock) {
            result.front_speed = front_speed(fronts);
            result.overshoot = ::overshoot(o.time, particles_of(scheme), o.amplitude);
        }
        return result;
    });
}
