#include "laws/sameness.hpp"

using namespace laws;

#if defined(_OPENMP)
namespace {

/// Stiffer where it was compressed more; keeps a field of its own.
struct largest_compression : scalar_field {
    static constexpr std::string_view name = "largest_compression";
};
constexpr largest_compression memory;
struct stiffening {
    double density = 3;
    using on_particles = fields<const field::stress, largest_compression>;
    double wave_speed() const { return 2; }
    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        using T = typename Tensor::Scalar;
        const T compression = -L.trace() * dt;
        p[memory] = select(compression > p[memory], compression, p[memory]);
        return p[symbols::sigma] + (T(4.) + T(30.) * p[memory]) * dt * (L + L.transpose());
    }
};

template <int D> uniform_grid<D, double> hall() { return D == 2 ? box<D>(40, 60) : box<D>(32, 12); }

/// What a run of two bodies that fly into each other leaves behind.
template <int D, class Shape, class Transfer, class Order, class Execution>
auto collision(Shape shape, Transfer transfer, Order order, const Execution& run) {
    const auto grid = hall<D>();
    const double floor = grid.lower()[D - 1];
    solver mpm{grid, shape, transfer, order, run, fixed{[=](const auto& at) { return at[D - 1] <= floor; }}};
    const double side = grid.upper()[D - 1] - floor;
    const auto layer = [=](const place<D>& at) {
        return at[D - 1] < floor + 0.7 * side && (D == 2 || (at[1] > 0 && at[1] < 2.4));
    };
    auto soft = mpm.make_body(
        rubber(), [=](const place<D>& at) { return layer(at) && at[0] > 0 && at[0] < 4; }, per_cell{2},
        fields<origin>{});
    auto hard = mpm.make_body(
        stiffening{}, [=](const place<D>& at) { return layer(at) && at[0] > 4.1 && at[0] < 7; }, per_cell{2},
        fields<origin>{});
    const auto start = [](auto& body, double speed) {
        for (auto p : body) p[x0] = p[symbols::x];
        stir(body, 0.2, 0.1);
        for (auto p : body) p[symbols::v][0] += speed;
    };
    start(soft, 2);
    start(hard, -2);
    for (int step = 0; step < 12; ++step) mpm.step(bodies(soft, hard), 0.02);
    CHECK(soft.store().slabs() > 3);
    CHECK(hard.store().slabs() > 3);
    CHECK(mpm.crossings() > soft.size());
    std::vector<double> walls;
    for (const auto& node : mpm.reactions())
        for (int d = 0; d < D; ++d) walls.push_back(node.reaction[d]);
    return std::tuple(snapshot(std::as_const(soft)), snapshot(std::as_const(hard)), walls, mpm.boundary_work(),
                      mpm.crossings());
}

template <int D, class Shape, class Transfer, class Order>
void same_for_any_number(Shape shape, Transfer transfer, Order order) {
    CAPTURE(D, Shape::name, Transfer::name, Order::name);
    const auto alone = collision<D>(shape, transfer, order, serial{});
    for (const int count : {1, 2, 3}) {
        CAPTURE(count);
        const bool same = collision<D>(shape, transfer, order, threads{count}) == alone;
        CHECK(same);
    }
}

}  // namespace

TEST_CASE("threads: two bodies in 2D end the same, bit for bit, for any number of them") {
    same_for_any_number<2>(quadratic_spline{}, flip{}, usl_minus{});
    same_for_any_number<2>(cubic_spline{}, fmpm<3>{}, usl_plus{});
    same_for_any_number<2>(linear{}, fmpm<4>{}, usavg_plus{});
}
TEST_CASE("threads: two bodies in 3D end the same, bit for bit, for any number of them") {
    same_for_any_number<3>(quadratic_spline{}, flip{}, usl_plus{});
    same_for_any_number<3>(linear{}, fmpm<3>{}, usl_minus{});
}

TEST_CASE("threads: an error of a particle comes out of the step as an error") {
    solver mpm{hall<2>(), threads{2}};
    auto block = mpm.make_body(rubber(), everywhere, per_cell{1});
    for (auto p : block) p[symbols::v][0] = 100;
    CHECK_THROWS_AS(mpm.step(bodies(block), 0.1), error);
}
#else
TEST_CASE("threads: this program was compiled without OpenMP") { CHECK_THROWS_AS(threads{2}, error); }
#endif
