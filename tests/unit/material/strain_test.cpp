#include <tamis/tamis.hpp>

#include <cmath>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

/// Remembers nothing: stress is what it is told.
struct passive {
    double density = 1;
    template <class Tensor> Tensor stress(auto, const Tensor& L, auto) const { return L * typename Tensor::Scalar(0); }
    double wave_speed() const { return 1; }
};

/// Stiffer in compression, with a memory of the largest expansion; one text for lanes, one for plain numbers.
struct largest : scalar_field {
    static constexpr std::string_view name = "largest";
};
constexpr largest memory;

struct in_lanes {
    double density = 1;
    using on_particles = fields<const field::stress, largest>;
    double wave_speed() const { return 1; }
    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        using T = typename Tensor::Scalar;
        const T expansion = L.trace() * dt;
        p[memory] = select(expansion > p[memory], expansion, p[memory]);
        const T stiffness = select(expansion < T(0.), T(4.), T(1.)) + p[memory];
        return p[sigma] + stiffness * L * dt;
    }
};
struct in_plain_numbers {
    double density = 1;
    using on_particles = fields<const field::stress, largest>;
    double wave_speed() const { return 1; }
    matrix<2, double> stress(auto p, const matrix<2, double>& L, double dt) const {
        const double expansion = L.trace() * dt;
        if (expansion > p[memory]) p[memory] = expansion;
        const double stiffness = (expansion < 0 ? 4. : 1.) + p[memory];
        return p[sigma] + stiffness * L * dt;
    }
};
struct marked : in_lanes {
    static constexpr bool lane_by_lane = true;
};

/// Writes down where it finds its particles.
struct marks_places {
    double density = 1;
    using on_particles = fields<const field::position>;
    double wave_speed() const { return 1; }
    matrix<2, double> stress(auto p, const matrix<2, double>&, double) const {
        return (matrix<2, double>() << p[x][0], 0, 0, p[x][1]).finished();
    }
};

using T = native_lanes::type<double>;
using S = space<2, T>;
constexpr int W = S::width;
constexpr std::uint32_t all_lanes = (1u << W) - 1u;
const detail::frame<S> origin{1., 1., {0., 0.}};

double in(const T& a, int l) {
    double out[W];
    lane<T>::store(out, a);
    return out[l];
}
/// A different number in every lane.
T some(double first) {
    double a[W];
    for (int l = 0; l < W; ++l) a[l] = first + 0.37 * l - 0.05 * l * l;
    return lane<T>::load(a);
}
S::tensor some_gradient() {
    S::tensor g;
    g << some(0.5), some(-1), some(2), some(-0.7);
    return g;
}

template <class Law> auto strained(const Law& law, std::uint32_t occupied = all_lanes) {
    using slot_type = values<S, merge<fields<field::stress, field::mass>, on_particles_t<Law>>>;
    slot_type slot;
    slot.set_zero();
    if constexpr (contains<typename slot_type::list, largest>) slot.template get<largest>() = some(0.1);
    for (int c = 0; c < 3; ++c) slot.template get<field::stress>()[c] = some(c);
    for (const double dt : {0.1, 0.2}) detail::strain_slot<S>(law, slot, occupied, origin, some_gradient(), T(dt));
    return slot;
}

template <class Slot> double largest_difference(const Slot& a, const Slot& b) {
    const auto *p = reinterpret_cast<const double*>(&a), *q = reinterpret_cast<const double*>(&b);
    double most = 0;
    for (int k = 0; k < Slot::components * W; ++k) most = std::max(most, std::abs(p[k] - q[k]));
    return most;
}

}  // namespace

TEST_CASE("strain: density, strain and deformation follow the velocity gradient where they are asked for") {
    using list = fields<field::stress, field::density, field::strain, field::deformation>;
    values<S, list> slot;
    slot.set_zero();
    slot.get<field::density>() = some(2);
    slot.get<field::deformation>() << T(1.), T(0.), T(0.), T(1.);
    const S::tensor L = some_gradient();
    const double dt = 0.125;
    for (int k = 0; k < 2; ++k) detail::strain_slot<S>(passive{}, slot, all_lanes, origin, L, T(dt));
    for (int l = 0; l < W; ++l) {
        Eigen::Matrix2d g;
        for (int c = 0; c < 4; ++c) g.data()[c] = in(L.data()[c], l);
        const Eigen::Matrix2d grown = Eigen::Matrix2d::Identity() + dt * g, deformation = grown * grown;
        const Eigen::Matrix2d strain = dt * (g + g.transpose());
        const double once = 1 + dt * g.trace();
        CHECK(std::abs(in(slot.get<field::density>(), l) - in(some(2), l) / (once * once)) < 1e-14);
        const S::tensor total = detail::unpack<S>(slot.get<field::strain>());
        for (int c = 0; c < 4; ++c) {
            CHECK(std::abs(in(total.data()[c], l) - strain.data()[c]) < 1e-14);
            CHECK(std::abs(in(slot.get<field::deformation>().data()[c], l) - deformation.data()[c]) < 1e-14);
        }
    }
}

TEST_CASE("strain: what nobody asks for is not there") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.5}};
    auto plain = mpm.make_body(passive{}, everywhere, per_cell{1});
    auto asked = mpm.make_body(passive{}, everywhere, per_cell{1}, fields<field::density, field::strain>{});
    STATIC_REQUIRE_FALSE(plain.has(rho));
    STATIC_REQUIRE_FALSE(plain.has(epsilon));
    STATIC_REQUIRE_FALSE(plain.has(F));
    STATIC_REQUIRE(asked.has(rho));
    STATIC_REQUIRE(asked.has(epsilon));
    STATIC_REQUIRE(asked.bytes_per_particle() == plain.bytes_per_particle() + 16);
}

TEST_CASE("strain: a law of plain numbers and branches, run lane by lane, gives what the law of lanes gives") {
    const auto lanes_at_once = strained(in_lanes{});
    CHECK(largest_difference(lanes_at_once, strained(in_plain_numbers{})) < 4e-15);
    CHECK(largest_difference(lanes_at_once, strained(marked{})) < 4e-15);
    bool both_branches[2] = {false, false};
    for (int l = 0; l < W; ++l) both_branches[in(some_gradient().trace(), l) < 0 ? 1 : 0] = true;
    CHECK((W < 8 || (both_branches[0] && both_branches[1])));
}

TEST_CASE("strain: lane by lane, empty lanes are passed over") {
    const auto all = strained(in_plain_numbers{}), first_only = strained(in_plain_numbers{}, 1u);
    for (int c = 0; c < 3; ++c) {
        CHECK(in(first_only.get<field::stress>()[c], 0) == in(all.get<field::stress>()[c], 0));
        for (int l = 1; l < W; ++l) CHECK(in(first_only.get<field::stress>()[c], l) == in(some(c), l));
    }
}

TEST_CASE("strain: lane by lane, a law finds its particles in their places") {
    solver mpm{uniform_grid{{-1., 2.}, {2., 4.}, 0.25}};
    auto block = mpm.make_body(marks_places{}, everywhere, per_cell{2});
    mpm.step(bodies(block), 0.1);
    for (const auto p : std::as_const(block)) {
        CHECK(std::abs(p[sigma](0, 0) - p[x][0]) < 1e-14);
        CHECK(std::abs(p[sigma](1, 1) - p[x][1]) < 1e-14);
    }
}
