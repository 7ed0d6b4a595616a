#include <tamis/grid/lattice.hpp>
#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/linear.hpp>
#include <tamis/shape/quadratic_spline.hpp>

#include <limits>
#include <set>

#include "catch.hpp"

using namespace tamis;
using detail::ghosts;

namespace {

template <int Dim> uniform_grid<Dim, double> box() {
    if constexpr (Dim == 1)
        return {{-0.3}, {0.8}, 0.1};
    else if constexpr (Dim == 2)
        return {{-0.3, 0.5}, {0.8, 0.8}, 0.1};
    else
        return {{-0.3, 0.5, 0.}, {0.8, 0.8, 0.2}, 0.1};
}

template <int Dim, class F> void each_index(const std::array<int, 3>& count, F f) {
    for (int k = 0; k < (Dim > 2 ? count[2] : 1); ++k)
        for (int j = 0; j < (Dim > 1 ? count[1] : 1); ++j)
            for (int i = 0; i < count[0]; ++i) f(std::array<int, 3>{i, j, k});
}

template <int Dim> std::array<int, 3> count_nodes(const uniform_grid<Dim, double>& grid) {
    std::array<int, 3> n{1, 1, 1};
    for (int d = 0; d < Dim; ++d) n[static_cast<std::size_t>(d)] = grid.cells(d) + 1;
    return n;
}

/// Nodes have distinct places in storage, and a cell's lane finds its nodes in its tile's rows.
template <int Dim, class Shape, class T> void storage_is_consistent() {
    using S = space<Dim, T>;
    using lattice_type = detail::lattice<S, Shape>;
    constexpr int N = Shape::support, W = S::width;
    const lattice_type lattice(box<Dim>());
    const auto nodes = count_nodes(lattice.grid());

    std::set<std::size_t> places;
    each_index<Dim>(nodes, [&](const auto& i) { places.insert(lattice.node_place(i)); });
    CHECK(places.size() == static_cast<std::size_t>(nodes[0] * nodes[1] * nodes[2]));
    CHECK(*places.rbegin() < lattice.size());

    std::set<std::size_t> blocks;
    std::array<int, 3> bins{1, 1, 1};
    for (int d = 0; d < Dim; ++d) bins[static_cast<std::size_t>(d)] = lattice.bins(d);
    bool found = true, in_storage = true;
    each_index<Dim>(bins, [&](const std::array<int, 3>& cell) {
        const std::array<int, 3> tile{cell[0] / W, cell[1], cell[2]};
        blocks.insert(lattice.block_place(tile));
        CHECK(lattice.first_node(tile) % static_cast<std::size_t>(W) == 0);
        for (int r = 0; r < lattice_type::rows; ++r) {
            const std::size_t row = lattice.first_node(tile) + lattice.row_offset(r);
            // Two whole vectors are added to a row.
            in_storage = in_storage && row + static_cast<std::size_t>(std::max(2 * W, W + N - 1)) <= lattice.size();
            for (int a = 0; a < N; ++a) {
                const int k[3] = {a, Dim > 1 ? r % N : 0, Dim > 2 ? r / N : 0};
                std::array<int, 3> node{0, 0, 0};
                bool in_box = true;
                for (int d = 0; d < Dim; ++d) {
                    const auto at = static_cast<std::size_t>(d);
                    node[at] = cell[at] + k[d] - ghosts<Shape>;
                    in_box = in_box && node[at] >= 0 && node[at] < nodes[at];
                }
                const std::size_t place = row + static_cast<std::size_t>(cell[0] % W + a);
                found = found && (!in_box || place == lattice.node_place(node));
            }
        }
    });
    CHECK(found);
    CHECK(in_storage);
    CHECK(blocks.size() == lattice.block_count());
    CHECK(*blocks.rbegin() == lattice.block_count() - 1);
}

template <int Dim, class Shape> void storage_is_consistent_for_all_lanes() {
    CAPTURE(Dim, Shape::support);
    storage_is_consistent<Dim, Shape, double>();
    storage_is_consistent<Dim, Shape, native_lanes::type<double>>();
    storage_is_consistent<Dim, Shape, lanes<1>::type<double>>();
}

template <class Shape> struct on_line {
    detail::lattice<space<1, double>, Shape> lattice{box<1>()};
    std::array<int, 3> cell{};
    point<1, double> local;
    bool locate(double x) { return lattice.locate(point<1, double>(x), cell, local); }
    double back() const {
        return lattice.grid().lower()[0] + lattice.grid().spacing() * (cell[0] - Shape::shift + local[0]);
    }
};

template <class Shape> void points_are_found() {
    CAPTURE(Shape::support);
    on_line<Shape> line;
    for (int j = 0; j <= 110; ++j) {
        const double x = j == 110 ? 0.8 : -0.3 + 0.01 * j;
        REQUIRE(line.locate(x));
        CHECK(line.cell[0] >= 0);
        CHECK(line.cell[0] < line.lattice.bins(0));
        CHECK(line.local[0] >= 0);
        CHECK(line.local[0] <= 1);
        CHECK(line.lattice.inside(line.cell, line.local));
        CHECK(std::abs(line.back() - x) < 1e-15);
    }
    for (const double x : {-0.3 - 1e-12, 0.8 + 1e-12, 1e300, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
        CAPTURE(x);
        CHECK_FALSE(line.locate(x));
    }
}

}  // namespace

TEST_CASE("lattice: every node has its own place, and every lane finds its nodes") {
    storage_is_consistent_for_all_lanes<1, linear>();
    storage_is_consistent_for_all_lanes<1, quadratic_spline>();
    storage_is_consistent_for_all_lanes<1, cubic_spline>();
    storage_is_consistent_for_all_lanes<2, linear>();
    storage_is_consistent_for_all_lanes<2, quadratic_spline>();
    storage_is_consistent_for_all_lanes<2, cubic_spline>();
    storage_is_consistent_for_all_lanes<3, linear>();
    storage_is_consistent_for_all_lanes<3, cubic_spline>();
}

TEST_CASE("lattice: points of the box are found, walls included, and come back; others are not") {
    points_are_found<linear>();
    points_are_found<quadratic_spline>();
    points_are_found<cubic_spline>();
}

TEST_CASE("lattice: cells start at nodes, or are centred on them") {
    on_line<linear> tents;
    on_line<quadratic_spline> splines;
    CHECK(tents.lattice.bins(0) == 11);
    CHECK(splines.lattice.bins(0) == 12);
    REQUIRE(tents.locate(-0.3));
    CHECK(tents.cell[0] == 0);
    CHECK(tents.local[0] == 0);
    REQUIRE(tents.locate(0.8));
    CHECK(tents.cell[0] == 10);
    CHECK(std::abs(tents.local[0] - 1) < 1e-14);
    REQUIRE(splines.locate(-0.3));
    CHECK(splines.cell[0] == 0);
    CHECK(splines.local[0] == 0.5);
    REQUIRE(splines.locate(-0.3 + 0.06));
    CHECK(splines.cell[0] == 1);
}

TEST_CASE("lattice: a cell centred on a wall's node is inside by half") {
    const on_line<quadratic_spline> line;
    const auto inside = [&](int cell, double r) { return line.lattice.inside({cell, 0, 0}, point<1, double>(r)); };
    CHECK_FALSE(inside(0, 0.49));
    CHECK(inside(0, 0.51));
    CHECK(inside(5, 0.01));
    CHECK(inside(11, 0.49));
    CHECK_FALSE(inside(11, 0.51));
    CHECK_FALSE(inside(-1, 0.5));
    CHECK_FALSE(inside(12, 0.5));
}

TEST_CASE("lattice: a frame gives places, and only tiles at walls are folded") {
    const detail::lattice<space<2, double>, cubic_spline> lattice(box<2>());
    const auto frame = lattice.frame_of({4, 1, 0});
    CHECK(std::abs(frame.corner[0] - 0.1) < 1e-15);
    CHECK(std::abs(frame.corner[1] - 0.6) < 1e-15);
    CHECK_FALSE(lattice.at_wall({4, 1, 0}));
    CHECK(lattice.at_wall({4, 0, 0}));
    CHECK(lattice.at_wall({4, 2, 0}));
    CHECK(lattice.at_wall({0, 1, 0}));
    CHECK(lattice.at_wall({10, 1, 0}));
    const auto corner = lattice.walls_of({10, 0, 0});
    CHECK(corner.low[0] == 0);
    CHECK(corner.high[0] == 1);
    CHECK(corner.low[1] == 1);
    CHECK(corner.high[1] == 0);
    CHECK_FALSE(detail::lattice<space<2, double>, linear>(box<2>()).at_wall({0, 0, 0}));
}

#if TAMIS_VECTOR_BYTES > 0
TEST_CASE("lattice: in a tile only the lane of the wall's cell is folded") {
    using T = native_lanes::type<double>;
    constexpr int W = lane<T>::width;
    const detail::lattice<space<1, T>, cubic_spline> lattice(box<1>());
    double low[W], high[W];
    const int last = 10 / W;
    lane<T>::store(low, lattice.walls_of({0, 0, 0}).low[0]);
    lane<T>::store(high, lattice.walls_of({last, 0, 0}).high[0]);
    for (int l = 0; l < W; ++l) {
        CHECK(low[l] == (l == 0 ? 1 : 0));
        CHECK(high[l] == (last * W + l == 10 ? 1 : 0));
    }
}
#endif
