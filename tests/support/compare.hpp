#pragma once

/// Runs a composition of the library beside the dense reference (reference/dense.hpp) and measures how far they differ.
/// The reference is compiled once for a program: one of its source files includes compare_definitions.hpp.

#include <tamis/tamis.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

#include "../reference/scene.hpp"

namespace compare {

/// Which particle of the reference a particle is: the order of the library's storage changes as particles move.
struct number : tamis::scalar_field {
    static constexpr std::string_view name = "number";
};

inline reference::shape_kind same(tamis::linear) { return reference::shape_kind::linear; }
inline reference::shape_kind same(tamis::quadratic_spline) { return reference::shape_kind::quadratic_spline; }
inline reference::shape_kind same(tamis::cubic_spline) { return reference::shape_kind::cubic_spline; }

inline reference::update same(const tamis::pic&) { return reference::pic(); }
inline reference::update same(const tamis::flip&) { return reference::flip(); }
inline reference::update same(const tamis::apic&) { return reference::apic(); }
inline reference::update same(const tamis::tpic&) { return reference::tpic(); }
inline reference::update same(const tamis::affine_flip&) { return reference::affine_flip(); }
inline reference::update same(const tamis::modified_flip& by) { return reference::flip(by.particle.psi); }
inline reference::update same(const tamis::blend& by) { return reference::blend(by.particle.alpha); }
inline reference::update same(const tamis::graphics_blend& by) { return reference::graphics_blend(by.particle.alpha); }
template <int K> reference::update same(const tamis::xpic<K>& by) { return reference::xpic(by.mass.terms()); }
template <int K> reference::update same(const tamis::fmpm<K>& by) { return reference::fmpm(by.mass.terms()); }

inline reference::stress_order same(tamis::usf) { return reference::stress_order::usf; }
inline reference::stress_order same(tamis::usl_minus) { return reference::stress_order::usl_minus; }
inline reference::stress_order same(tamis::usl_plus) { return reference::stress_order::usl_plus; }
inline reference::stress_order same(tamis::usavg_minus) { return reference::stress_order::usavg_minus; }
inline reference::stress_order same(tamis::usavg_plus) { return reference::stress_order::usavg_plus; }
inline reference::stress_order same(tamis::euler) { return reference::stress_order::euler; }

inline reference::motion same(tamis::moving) { return reference::motion::moving; }
inline reference::motion same(tamis::held) { return reference::motion::held; }

inline reference::boundary_method same(tamis::boundary_method::incremental) {
    return reference::boundary_method::incremental;
}
inline reference::boundary_method same(tamis::boundary_method::lumped) { return reference::boundary_method::lumped; }
inline reference::boundary_method same(tamis::boundary_method::velocity) {
    return reference::boundary_method::velocity;
}
inline reference::boundary_method same(tamis::boundary_method::combined) {
    return reference::boundary_method::combined;
}
inline reference::boundary_method same(tamis::boundary_method::unlumped1) {
    return reference::boundary_method::unlumped1;
}
inline reference::boundary_method same(tamis::boundary_method::unlumped2) {
    return reference::boundary_method::unlumped2;
}
inline reference::boundary_method same(tamis::boundary_method::partial) { return reference::boundary_method::partial; }
inline reference::boundary_method same(tamis::boundary_method::collected) {
    return reference::boundary_method::collected;
}

/// An update with the numbers that the comparisons give it: share 0.7, psi = 0.6, k = 3.
template <class Update> Update make() {
    if constexpr (std::is_same_v<Update, tamis::blend> || std::is_same_v<Update, tamis::graphics_blend>)
        return Update{0.7};
    else if constexpr (std::is_same_v<Update, tamis::modified_flip>)
        return Update{0.6};
    else if constexpr (std::is_constructible_v<Update, int>)
        return Update{3};
    else
        return Update{};
}

/// How far two runs differ: for each quantity the largest difference up to a step by the largest value up to that step,
/// at the step where that was worst. Infinite if one of the numbers was none.
struct deviations {
    double position = 0;
    double velocity = 0;
    double stress = 0;
    double reaction = 0;

    double worst() const { return std::max({position, velocity, stress, reaction}); }
};

/// How much larger a disturbance of the start gets in the reference's velocities and stresses, relative to these, in a
/// run.
double growth(const reference::scene& set, const reference::state& start, double dt, int steps);

using three = std::array<double, 3>;
using nine = std::array<double, 9>;

/// One particle, in plain numbers: the first D of `x` and `v`, D x D of `stress` row by row.
struct particle_values {
    three x{}, v{};
    nine stress{};
};

/// The run of the reference, and the comparison with it.
class reference_run {
  public:
    /// The run starts at t = 0.
    reference_run(const reference::scene& set, const reference::state& start);
    ~reference_run();

    std::size_t size() const;
    /// The number of the particle at a place and what it starts with. Throws std::logic_error if there is none, to
    /// `precision`, or if it has another mass or volume, or was asked for before.
    std::pair<std::size_t, particle_values> claim(const three& at, double mass, double volume, double precision);
    void step(double dt);
    /// sqrt(sum m |dv_k|^2 / sum m) of the last step's series (m/s).
    double last_increment() const;

    /// Particle by particle what the library found, then the comparison.
    void found(std::size_t number, const particle_values& values);
    void compare_particles();
    /// Held node by held node, in the library's order, then the comparison. Throws std::logic_error if the library
    /// holds other nodes than the reference.
    void found_reaction(const three& at, const three& reaction);
    void compare_reactions();

    const deviations& result() const;

  private:
    struct data;
    std::unique_ptr<data> data_;
};

/// Gives a body the state that the reference starts with. Throws std::logic_error unless their particles are the same,
/// one for one, to the precision of the body's numbers.
template <class Body> void start(Body& body, reference_run& run) {
    using namespace tamis::symbols;
    using real = typename Body::real;
    constexpr int D = Body::dim;
    std::size_t count = 0;
    for (auto p : body) {
        three at{};
        for (int d = 0; d < D; ++d) at[static_cast<std::size_t>(d)] = static_cast<double>(p[x][d]);
        const auto [k, values] = run.claim(at, static_cast<double>(p[m]), static_cast<double>(p[V]),
                                           8 * static_cast<double>(std::numeric_limits<real>::epsilon()));
        p[number{}] = static_cast<real>(k);
        for (int d = 0; d < D; ++d) {
            p[v][d] = static_cast<real>(values.v[static_cast<std::size_t>(d)]);
            for (int e = d; e < D; ++e)
                p[sigma](d, e) = static_cast<real>(values.stress[static_cast<std::size_t>(d * D + e)]);
        }
        ++count;
    }
    if (count != run.size()) throw std::logic_error("compare: the body has fewer particles than the reference.");
}

template <class Body> void compare_particles(const Body& body, reference_run& run) {
    using namespace tamis::symbols;
    constexpr int D = Body::dim;
    for (const auto p : body) {
        particle_values values;
        const auto stress = p[sigma];
        for (int d = 0; d < D; ++d) {
            values.x[static_cast<std::size_t>(d)] = static_cast<double>(p[x][d]);
            values.v[static_cast<std::size_t>(d)] = static_cast<double>(p[v][d]);
            for (int e = 0; e < D; ++e)
                values.stress[static_cast<std::size_t>(d * D + e)] = static_cast<double>(stress(d, e));
        }
        run.found(static_cast<std::size_t>(p[number{}]), values);
    }
    run.compare_particles();
}

template <class Mpm> void compare_reactions(const Mpm& mpm, reference_run& run) {
    for (const auto& node : mpm.reactions()) {
        three at{}, reaction{};
        for (int d = 0; d < Mpm::dim; ++d) {
            at[static_cast<std::size_t>(d)] = static_cast<double>(node.at[d]);
            reaction[static_cast<std::size_t>(d)] = static_cast<double>(node.reaction[d]);
        }
        run.found_reaction(at, reaction);
    }
    run.compare_reactions();
}

/// Steps both. Reactions are compared after every step, particles after steps 1, 10, 50, 100, ... and the last: a look
/// at them delivers the letters of those that change their tile, which is otherwise the next step's work.
template <class Mpm, class Body> void side_by_side(Mpm& mpm, Body& body, reference_run& run, double dt, int steps) {
    start(body, run);
    for (int n = 1; n <= steps; ++n) {
        run.step(dt);
        mpm.step(tamis::bodies(body), static_cast<typename Body::real>(dt), n * dt);
        compare_reactions(mpm, run);
        if (n == 1 || n == 10 || n % 50 == 0 || n == steps) compare_particles(std::as_const(body), run);
    }
}

}  // namespace compare
