// What a field costs is what the policies ask for: bytes per particle and per node are pinned, composition by
// composition.
#include <iostream>

#include "laws/composition.hpp"

using namespace laws;

namespace {

template <int D, class Law = linear_elastic, class... Policy>
void pin(std::string_view name, std::size_t particle, std::size_t node) {
    using solver_type = solver<uniform_grid<D, double>, Policy...>;
    const std::size_t particle_bytes = solver_type::template body_for<Law>::bytes_per_particle();
    const std::size_t node_bytes = solver_type::bytes_per_node();
    std::cout << name << ": " << particle_bytes << " bytes per particle, " << node_bytes << " per node\n";
    CAPTURE(name);
    CHECK(particle_bytes == particle);
    CHECK(node_bytes == node);
}

/// One lane wide, there is no pass that makes the next step's sums.

constexpr std::size_t lumped_1d = lane<native_lanes::type<double>>::width == 1 ? 24 : 40;

}  // namespace

TEST_CASE("bytes: a particle and a node take what the composition asks for, and no more") {
    // Particle: V, M, V0 and stress besides its place or weights. Node: m, p and f, whose columns v and a take; in 1D
    // with a lumped mass v and a have their own, as the next step's sums are made while they are read; so has the new
    // momentum of USL+. Besides, the terms of a series.
    pin<1, linear_elastic, linear, flip, usl_minus, held>("held FLIP, 1D, linear", 48, lumped_1d);
    pin<1, linear_elastic, quadratic_spline, flip, usl_minus, held>("held FLIP, 1D, quadratic", 80, lumped_1d);
    pin<1, linear_elastic, linear, flip, usl_minus>("moving FLIP, 1D, linear", 40, lumped_1d);
    pin<1, linear_elastic, linear, fmpm<2>, usl_minus, held>("held FMPM(2), 1D, linear", 48, 56);
    pin<2, linear_elastic, quadratic_spline, pic, usl_minus>("moving PIC, 2D, quadratic", 72, 40);
    pin<2, linear_elastic, quadratic_spline, flip, usl_plus>("moving FLIP, USL+, 2D, quadratic", 88, 56);
    pin<2, linear_elastic, quadratic_spline, fmpm<1>, usl_minus>("moving FMPM(1), 2D, quadratic", 72, 40);
    pin<2, varying_elastic, cubic_spline, xpic<2>, usf>("moving XPIC(2), USF, 2D, cubic, its own modulus", 80, 72);
    pin<3, linear_elastic, quadratic_spline, flip, usl_minus>("moving FLIP, 3D, quadratic", 112, 56);
    pin<3, linear_elastic, quadratic_spline, fmpm<dynamic>, usavg_minus>("moving FMPM(k), USAVG-, 3D, quadratic", 112,
                                                                         128);
}

TEST_CASE("bytes: gravity and walls cost particles and nodes nothing") {
    using plain = solver<uniform_grid<2, double>>;
    using loaded = solver<uniform_grid<2, double>, gravity<place<2>>, walls<2>>;
    STATIC_REQUIRE(plain::body_for<linear_elastic>::bytes_per_particle() ==
                   loaded::body_for<linear_elastic>::bytes_per_particle());
    STATIC_REQUIRE(plain::bytes_per_node() == loaded::bytes_per_node());
}
