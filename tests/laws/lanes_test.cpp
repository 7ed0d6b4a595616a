#include <utility>

#include "laws/sameness.hpp"

using namespace laws;

namespace {

/// A law whose answer branches, so that lanes take different ways.
struct slack {
    double density = 2;
    using on_particles = fields<const field::stress>;
    double wave_speed() const { return 2; }
    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        using T = typename Tensor::Scalar;
        const T stiffness = select(p[symbols::sigma].trace() > T(0.), T(2.), T(8.));
        return p[symbols::sigma] + stiffness * dt * (L + L.transpose());
    }
};

/// A run of a body under a load of place and velocity, with its cells crossed, in lanes of a kind.
template <int D, class Lanes, class Shape, class Transfer, class Order>
auto run_in(Lanes lanes_of, Shape shape, Transfer transfer, Order order) {
    const auto grid = box<D>(21, 6);
    const double wall = grid.lower()[0];
    const auto swirl = [](const auto& at, const auto& speed, auto) { return (at * -0.3 + speed * 0.1).eval(); };
    solver mpm{grid,
               shape,
               transfer,
               order,
               lanes_of,
               body_acceleration{swirl},
               fixed{[=](const auto& at) { return at[0] <= wall; }}};
    auto body = mpm.make_body(
        slack{},
        [](const place<D>& at) {
            bool inside = at[0] < 3.2;
            for (int d = 1; d < D; ++d) inside = inside && at[d] > 0.1 && at[d] < 0.9;
            return inside;
        },
        per_cell{2}, fields<origin>{});
    for (auto p : body) {
        p[x0] = p[symbols::x];
        for (int d = 0; d < D; ++d) p[symbols::v][d] = (d == 0 ? 0.5 : 0) + 0.3 * std::sin(9 * p[x0].sum() + d);
    }
    for (int step = 0; step < 15; ++step) mpm.step(bodies(body), 0.02);
    CHECK(mpm.crossings() > body.size() / 5);
    return snapshot(std::as_const(body));
}

/// Largest difference of any field of any particle.
template <class Snapshot> double difference(const Snapshot& a, const Snapshot& b) {
    REQUIRE(a.size() == b.size());
    double most = 0;
    for (const auto& [key, values] : a) {
        const auto& others = b.at(key);
        for (std::size_t c = 0; c < values.size(); ++c) most = std::max(most, std::abs(values[c] - others[c]));
    }
    return most;
}

/// Whether the target has vectors of W doubles.
template <int W> constexpr bool available() { return W * int{sizeof(double)} <= TAMIS_VECTOR_BYTES; }

template <int D, int... W, class... Policy> void same_in_any_lanes(std::integer_sequence<int, W...>, Policy... policy) {
    const auto one_by_one = run_in<D>(one_lane{}, policy...);
    const auto compare = [&](auto lanes_of) { CHECK(difference(one_by_one, run_in<D>(lanes_of, policy...)) < 1e-11); };
    compare(native_lanes{});
    [[maybe_unused]] const auto of_width = [&](auto width) {
        if constexpr (available<decltype(width)::value>()) {
            CAPTURE(decltype(width)::value);
            compare(lanes<decltype(width)::value>{});
        }
    };
    (of_width(std::integral_constant<int, W>{}), ...);
}

}  // namespace

TEST_CASE("lanes: a run is the same in lanes of any width, but for the last digits") {
    SECTION("1D") { same_in_any_lanes<1>(std::integer_sequence<int, 2>{}, cubic_spline{}, fmpm<2>{}, usavg_plus{}); }
    SECTION("2D") { same_in_any_lanes<2>(std::integer_sequence<int, 2, 4>{}, quadratic_spline{}, flip{}, usl_minus{}); }
    SECTION("3D") { same_in_any_lanes<3>(std::integer_sequence<int>{}, linear{}, xpic<2>{}, usl_plus{}); }
}
