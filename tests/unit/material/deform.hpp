#pragma once
#include <tamis/tamis.hpp>

/// One particle in the middle of one cell of side 1, whose nodes move at v = gradient x: that is its velocity gradient.
template <class Motion, class Law, int D>
auto deform(const Law& law, const tamis::matrix<D, double>& gradient, int steps, double dt) {
    using namespace tamis;
    double lower[D], upper[D];
    for (int k = 0; k < D; ++k) {
        lower[k] = 0;
        upper[k] = 1;
    }
    const auto drive = prescribed{everywhere, [gradient](const auto& at, auto) { return (gradient * at).eval(); }};
    solver mpm{uniform_grid{lower, upper, 1.}, linear{}, flip{}, usl_minus{}, Motion{}, drive};
    auto body = mpm.make_body_at(law, {point<D, double>::Constant(0.5)}, 1., fields<field::density>{});
    for (int n = 0; n < steps; ++n) mpm.step(bodies(body), dt);
    return body;
}
/// The same rate along all axes.
template <class Motion, int D, class Law> auto swell(const Law& law, double rate, int steps, double dt) {
    return deform<Motion, Law, D>(law, tamis::matrix<D, double>::Identity() * rate, steps, dt);
}
