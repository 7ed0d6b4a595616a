#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/quadratic_spline.hpp>

#include <cstring>
#include <new>

#include "unit/engine/storage_world.hpp"

using namespace tamis;
using namespace storage;

namespace {

/// Node places that a tile's particles reach.
template <class S, class Shape>
std::set<std::size_t> reached(const detail::lattice<S, Shape>& lattice, const detail::tile& t) {
    std::set<std::size_t> places;
    for (int r = 0; r < detail::lattice<S, Shape>::rows; ++r)
        for (int k = 0; k < S::width + Shape::support - 1; ++k)
            places.insert(t.node + lattice.row_offset(r) + static_cast<std::size_t>(k));
    return places;
}

/// Slabs hold every tile once, and slabs that may run at the same time reach no common node.
template <int Dim, class T, class Shape> void slabs_are_apart(const uniform_grid<Dim, double>& grid) {
    using S = space<Dim, T>;
    CAPTURE(Dim, S::width, Shape::support);
    const detail::lattice<S, Shape> lattice(grid);
    detail::tile_store<S, fields<field::mass>> store(lattice.block_count());
    std::mt19937 random(3);
    for (int k = 0; k < 3000; ++k) {
        cell_index cell{0, 0, 0};
        for (int d = 0; d < Dim; ++d) cell[static_cast<std::size_t>(d)] = static_cast<int>(random()) & 0x7fffffff;
        for (int d = 0; d < Dim; ++d) cell[static_cast<std::size_t>(d)] %= lattice.bins(d);
        store.add(lattice, cell);
    }
    store.template arrange<Shape::support>();
    CHECK(store.slabs() > 4);
    CHECK(store.slabs() * 16 <= store.tiles.size());
    std::set<std::size_t> seen;
    std::vector<std::set<std::size_t>> places(store.slabs());
    for (std::size_t k = 0; k < store.slabs(); ++k)
        for (const std::uint32_t j : store.row(k)) {
            CHECK(seen.insert(j).second);
            for (const std::size_t place : reached(lattice, store.tiles[j])) places[k].insert(place);
        }
    CHECK(seen.size() == store.tiles.size());
    for (std::size_t a = 0; a < places.size(); ++a)
        for (std::size_t b = a + 2; b < places.size(); b += 2) {
            bool apart = true;
            for (const std::size_t place : places[a]) apart = apart && places[b].count(place) == 0;
            CHECK(apart);
        }
}

/// An execution policy that has no memory left.
struct failing {
    void for_each(std::size_t, const auto&) const { throw std::bad_alloc(); }
};

}  // namespace

TEST_CASE("tile_order: sorting puts tiles in the order of their nodes and slots without gaps") {
    world<2, native_lanes::type<double>> w(box<2>());
    for (int k = 0; k < 300; ++k) w.add(w.any_cell());
    w.store.sort(w.lattice, 0);
    std::uint32_t next = 0;
    std::size_t node = 0;
    for (const auto& t : w.store.tiles) {
        CHECK(t.first == next);
        CHECK(t.room == t.count);
        CHECK((next == 0 || t.node > node));
        node = t.node;
        next += t.count;
    }
    CHECK(next == w.store.slots.size());
}

TEST_CASE("tile_order: slabs hold every tile once, and every other slab reaches nodes of its own") {
    slabs_are_apart<1, double, linear>({{0.}, {200.}, 1.});
    slabs_are_apart<1, double, cubic_spline>({{0.}, {200.}, 1.});
    slabs_are_apart<2, double, quadratic_spline>({{0., 0.}, {9., 40.}, 1.});
    slabs_are_apart<3, double, cubic_spline>({{0., 0., 0.}, {4., 4., 20.}, 1.});
#if TAMIS_VECTOR_BYTES > 0
    slabs_are_apart<1, native_lanes::type<double>, cubic_spline>({{0.}, {2000.}, 1.});
    slabs_are_apart<1, lanes<2>::type<double>, cubic_spline>({{0.}, {500.}, 1.});
    slabs_are_apart<2, native_lanes::type<double>, cubic_spline>({{0., 0.}, {30., 40.}, 1.});
    slabs_are_apart<3, native_lanes::type<double>, linear>({{0., 0., 0.}, {14., 14., 14.}, 1.});
#endif
}

TEST_CASE("tile_order: a sort that fails leaves all as it was") {
    world<2, native_lanes::type<double>> w({{0., 0.}, {60., 40.}, 1.});
    for (int k = 0; k < 400; ++k) w.add(w.any_cell());
    CHECK_THROWS_AS(w.store.sort(w.lattice, 2, failing{}), std::bad_alloc);
    w.check_same_as_model();
    // Cells still know their tiles.
    for (int k = 0; k < 400; ++k) w.add(w.any_cell());
    w.move_some(2);
    w.store.deliver_all();
    w.check_same_as_model();
}

#if defined(_OPENMP)
TEST_CASE("tile_order: threads sort as one does") {
    world<2, native_lanes::type<double>> w({{0., 0.}, {60., 40.}, 1.});
    for (int k = 0; k < 20000; ++k) w.add(w.any_cell());
    w.store.sort(w.lattice, 0);
    w.move_some(2);
    w.store.deliver_all();
    auto one = w.store, three = w.store;
    one.sort(w.lattice, 2);
    three.sort(w.lattice, 2, threads{3});
    CHECK(three.occupied == one.occupied);
    REQUIRE(three.slots.size() == one.slots.size());
    CHECK(std::memcmp(three.slots.data(), one.slots.data(), one.slots.size() * sizeof(one.slots[0])) == 0);
    REQUIRE(three.tiles.size() == one.tiles.size());
    for (std::size_t k = 0; k < one.tiles.size(); ++k) {
        CHECK(three.tiles[k].at == one.tiles[k].at);
        CHECK(three.tiles[k].first == one.tiles[k].first);
        CHECK(three.tiles[k].room == one.tiles[k].room);
    }
    w.store = std::move(three);
    w.check_same_as_model();
}
#endif
