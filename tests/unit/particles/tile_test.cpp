#include <tamis/core/names.hpp>
#include <tamis/particles/tile.hpp>
#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/linear.hpp>
#include <tamis/shape/quadratic_spline.hpp>

#include <cstring>
#include <map>
#include <new>
#include <random>
#include <set>
#include <utility>

#include "catch.hpp"

using namespace tamis;

namespace {

using cell_index = std::array<int, 3>;

/// A store beside its model: what each particle, known by its mass, should be and where.
template <int Dim, class T> struct world {
    using S = space<Dim, T>;
    using real = typename S::real;
    using lattice_type = detail::lattice<S, linear>;
    using store_type = detail::tile_store<S, fields<field::mass, field::velocity>>;
    using slot = typename store_type::slot;
    static constexpr int W = S::width, outside = store_type::outside;
    struct entry {
        cell_index cell;
        real speed;
        bool operator==(const entry&) const = default;
    };

    lattice_type lattice;
    store_type store{lattice.block_count()};
    std::map<real, entry> model;
    std::mt19937 random{12345};
    real next_mass = 1;
    std::size_t removed_outside = 0;

    explicit world(const uniform_grid<Dim, real>& grid) : lattice(grid) {}

    int any(int below) { return static_cast<int>(random() % static_cast<unsigned>(below)); }
    cell_index any_cell() {
        cell_index cell{0, 0, 0};
        for (int d = 0; d < Dim; ++d) cell[static_cast<std::size_t>(d)] = any(lattice.bins(d));
        return cell;
    }
    real& mass(std::uint32_t s, int l) { return store.lane_of(s, l)[slot::template first<field::mass>() * W]; }
    real& speed(std::uint32_t s, int l) { return store.lane_of(s, l)[slot::template first<field::velocity>() * W]; }

    void add(const cell_index& cell) {
        const std::uint32_t s = store.add(lattice, cell);
        const int l = cell[0] % W;
        CHECK(mass(s, l) == 0);
        const real speed_of_it = static_cast<real>(any(1000));
        mass(s, l) = next_mass;
        speed(s, l) = speed_of_it;
        model[next_mass] = {cell, speed_of_it};
        next_mass += 1;
    }
    /// From the last slot on: where one is posted or removed, the last of its lane takes its place.
    template <class F> void each_particle_of(const detail::tile& t, F f) {
        for (std::uint32_t s = t.first + t.count; s-- > t.first;)
            for (int l = 0; l < W; ++l)
                if (store.occupied[s] >> l & 1u) f(s, l, cell_index{t.at[0] * W + l, t.at[1], t.at[2]});
    }
    template <class F> void each_particle(F f) {
        for (const detail::tile& t : store.tiles) each_particle_of(t, f);
    }
    /// One in `odds` particles goes anywhere; some of them outside, of which every other is brought back to cell 0.
    void move_some(int odds) {
        store.template arrange<2>();
        for (std::size_t slab = 0; slab < store.slabs(); ++slab)
            for (const std::uint32_t k : store.row(slab)) {
                each_particle_of(store.tiles[k], [&](std::uint32_t s, int l, const cell_index& from) {
                    if (any(odds) != 0) return;
                    cell_index to = any_cell();
                    if (any(8) == 0) to[0] = outside;
                    const real m = mass(s, l);
                    if (to[0] != outside)
                        model[m].cell = to;
                    else if (static_cast<int>(m) % 2 == 0)
                        model[m].cell = {0, 0, 0};
                    else
                        model.erase(m);
                    store.post(lattice, slab, store.tiles[k], s, l, from, to);
                });
                store.shrink(slab, store.tiles[k]);
            }
        store.sort_mail(lattice, [](auto& letter) {
            if (static_cast<int>(letter.value[slot::template first<field::mass>()]) % 2 != 0) return false;
            letter.cell = {0, 0, 0};
            return true;
        });
    }
    void remove_some() {
        for (const detail::tile& t : store.tiles)
            each_particle_of(t, [&](std::uint32_t s, int l, const cell_index&) {
                if (any(40) != 0) return;
                model.erase(mass(s, l));
                store.remove(t, s, l);
            });
    }
    /// A lane has no gaps, and every tile as many slots as its fullest lane.
    void check_tight() {
        for (const detail::tile& t : store.tiles) {
            for (std::uint32_t s = t.first; s + 1 < t.first + t.count; ++s)
                CHECK((store.occupied[s + 1] & ~store.occupied[s]) == 0);
            if (t.count > 0) CHECK(store.occupied[t.first + t.count - 1] != 0);
        }
    }
    void check_same_as_model() {
        CHECK(store.size() == model.size());
        std::map<real, entry> found;
        std::size_t seen = 0;
        each_particle([&](std::uint32_t s, int l, const cell_index& cell) {
            found[mass(s, l)] = {cell, speed(s, l)};
            ++seen;
        });
        CHECK(seen == model.size());
        CHECK(found == model);
        bool empty_lanes_are_zero = true;
        std::size_t in_use = 0;
        std::set<std::uint32_t> slots;
        for (const detail::tile& t : store.tiles) {
            CHECK(t.count <= t.room);
            CHECK(t.first + t.room <= store.slots.size());
            for (std::uint32_t s = t.first; s < t.first + t.room; ++s) {
                CHECK(slots.insert(s).second);
                if (s < t.first + t.count) in_use += static_cast<std::size_t>(W);
                for (int l = 0; l < W; ++l)
                    if (!(store.occupied[s] >> l & 1u))
                        for (int c = 0; c < slot::components; ++c)
                            empty_lanes_are_zero = empty_lanes_are_zero && store.lane_of(s, l)[c * W] == 0;
            }
        }
        CHECK(empty_lanes_are_zero);
        if (in_use > 0) CHECK(store.occupancy() == double(model.size()) / double(in_use));
    }
};

template <int Dim> uniform_grid<Dim, double> box() {
    if constexpr (Dim == 1)
        return {{0.}, {21.}, 1.};
    else if constexpr (Dim == 2)
        return {{0., 0.}, {19., 7.}, 1.};
    else
        return {{0., 0., 0.}, {11., 4., 3.}, 1.};
}

template <int Dim, class T> void random_life() {
    world<Dim, T> w(box<Dim>());
    for (int k = 0; k < 150; ++k) w.add(w.any_cell());
    w.store.sort(w.lattice, 0);
    w.check_same_as_model();
    for (int round = 0; round < 60; ++round) {
        w.move_some(round % 3 == 0 ? 2 : 15);
        if (round % 2 == 0)
            w.store.deliver_all();
        else {
            for (auto& t : w.store.tiles) w.store.deliver(t);
            w.store.mail_delivered();
        }
        CHECK_FALSE(w.store.has_mail());
        w.check_tight();
        w.check_same_as_model();
        if (round % 5 == 0) w.remove_some();
        if (round % 4 == 0)
            for (int k = 0; k < 5; ++k) w.add(w.any_cell());
        for (auto& t : w.store.tiles) w.store.shrink(0, t);
        w.store.tidy(w.lattice);
        if (round % 17 == 0) w.store.sort(w.lattice, 1);
        w.check_same_as_model();
    }
}

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

TEST_CASE("tile_store: through random moves, losses and sorting every particle is where the model says") {
    random_life<1, double>();
    random_life<2, double>();
    random_life<1, native_lanes::type<double>>();
    random_life<2, native_lanes::type<double>>();
    random_life<3, native_lanes::type<double>>();
}

TEST_CASE("tile_store: sorting puts tiles in the order of their nodes and slots without gaps") {
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

TEST_CASE("tile_store: tiles that all particles left are given back") {
    world<2, native_lanes::type<double>> w(box<2>());
    for (int k = 0; k < 300; ++k) w.add(w.any_cell());
    w.store.sort(w.lattice, 0);
    w.store.arrange<2>();
    for (std::size_t k = 0; k < w.store.tiles.size(); ++k) {
        detail::tile& t = w.store.tiles[k];
        w.each_particle_of(t, [&](std::uint32_t s, int l, const cell_index& from) {
            w.store.post(w.lattice, 0, t, s, l, from, {4, 3, 0});
        });
        w.store.shrink(0, t);
    }
    const auto layout = w.store.layout.number();
    CHECK(w.store.sort_mail(w.lattice, [](auto&) { return true; }) == 300);
    w.store.tidy(w.lattice);
    CHECK(w.store.tiles.size() == 1);
    CHECK(w.store.size() == 300);
    CHECK(w.store.layout.number() != layout);
}

TEST_CASE("tile_store: room that tiles left is taken again, so that slots do not become more for ever") {
    world<2, native_lanes::type<double>> w(box<2>());
    for (int k = 0; k < 400; ++k) w.add(w.any_cell());
    w.store.sort(w.lattice, 0);
    std::size_t most = 0;
    for (int round = 0; round < 400; ++round) {
        w.move_some(3);
        w.store.deliver_all();
        if (round < 100) most = std::max(most, w.store.slots.size());
    }
    w.check_same_as_model();
    CHECK(w.store.slots.size() < most + most / 4);
    // A tile that needs a little more takes what another left, not new slots.
    world<1, double> small(box<1>());
    for (int k = 0; k < 4; ++k) small.add({3, 0, 0});
    small.add({5, 0, 0});
    const auto first = small.store.tiles[0].first;
    small.add({3, 0, 0});
    CHECK(small.store.tiles[0].first != first);
    const std::size_t slots = small.store.slots.size();
    small.add({7, 0, 0});
    CHECK(small.store.tiles[2].first == first);
    CHECK(small.store.slots.size() == slots);
    CHECK(small.mass(first, 0) == 7);
    for (std::uint32_t s = first + 1; s < first + small.store.tiles[2].room; ++s) CHECK(small.mass(s, 0) == 0);
    small.check_same_as_model();
}

TEST_CASE("tile_store: letters of particles that are removed are not kept") {
    world<1, double> w(box<1>());
    for (int k = 0; k < 100; ++k) w.add({k % 20, 0, 0});
    w.store.arrange<2>();
    const auto leave = [&](std::size_t index) {
        const detail::tile& t = w.store.tiles[index];
        w.store.post(w.lattice, 0, t, t.first, 0, {t.at[0], 0, 0}, {w.outside, 0, 0});
        std::size_t shown = 0;
        CHECK(w.store.sort_mail(w.lattice, [&](auto&) { return shown++ > 0; }) == 0);
        CHECK(shown == 1);
        CHECK_FALSE(w.store.has_mail());
    };
    for (std::size_t k = 0; k < 20; ++k) leave(k);
    CHECK(w.store.size() == 80);
}

TEST_CASE("tile_store: letters that were not handed out, for memory ran out, are handed out later") {
    for (const int fails_at : {0, 1, 2}) {
        CAPTURE(fails_at);
        world<2, native_lanes::type<double>> w({{0., 0.}, {60., 40.}, 1.});
        for (int k = 0; k < 400; ++k) w.add(w.any_cell());
        w.store.arrange<2>();
        // Every other one leaves the grid.
        int posted = 0;
        const auto post_first_of = [&](std::size_t index) {
            const detail::tile& t = w.store.tiles[index];
            bool done = false;
            w.each_particle_of(t, [&](std::uint32_t s, int l, const cell_index& from) {
                if (std::exchange(done, true)) return;
                const bool leaves = posted++ % 2 == 1;
                const cell_index to = leaves ? cell_index{w.outside, 0, 0} : w.any_cell();
                if (leaves)
                    w.model.erase(w.mass(s, l));
                else
                    w.model[w.mass(s, l)].cell = to;
                w.store.post(w.lattice, 0, t, s, l, from, to);
            });
            REQUIRE(done);
        };
        for (std::size_t k = 0; k < 8; ++k) post_first_of(k);
        int seen = 0;
        const auto fail = [&](auto&) {
            if (seen++ == fails_at) throw std::bad_alloc();
            return false;
        };
        CHECK_THROWS_AS(w.store.sort_mail(w.lattice, fail), std::bad_alloc);
        w.store.deliver_all();
        for (std::size_t k = 10; k < 16; ++k) post_first_of(k);
        w.store.sort_mail(w.lattice, [](auto&) { return false; });
        w.store.deliver_all();
        w.check_same_as_model();
    }
}

TEST_CASE("tile_store: letters wait while tiles and slabs come and go") {
    world<2, native_lanes::type<double>> w({{0., 0.}, {40., 200.}, 1.});
    for (int k = 0; k < 300; ++k) w.add({w.any(40), w.any(4), 0});
    w.store.sort(w.lattice, 0);
    for (int round = 0; round < 4; ++round) {
        w.move_some(4);
        w.store.arrange<2>();
    }
    CHECK(w.store.has_mail());
    w.store.deliver_all();
    w.check_tight();
    w.check_same_as_model();
}

TEST_CASE("tile_store: letters find room made for them, also where all tiles were sorted for it") {
    world<2, native_lanes::type<double>> w({{0., 0.}, {60., 40.}, 1.});
    for (int k = 0; k < 20000; ++k) w.add(w.any_cell());
    w.store.sort(w.lattice, 0);
    int sorted = 0;
    for (int round = 0; round < 12; ++round) {
        const auto ground = w.store.ground.number();
        w.move_some(round % 2 == 0 ? 2 : 8);
        sorted += w.store.ground.number() != ground ? 1 : 0;
        CHECK(w.store.has_mail());
        const auto rooms = [&] {
            std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
            for (const detail::tile& t : w.store.tiles) all.emplace_back(t.first, t.room);
            return all;
        };
        const auto before = rooms();
        const std::size_t slots = w.store.slots.size();
        // In any order, by several threads: so none of them may ask for more.
        for (auto& t : w.store.tiles) w.store.deliver(t);
        w.store.mail_delivered();
        CHECK(rooms() == before);
        CHECK(w.store.slots.size() == slots);
        w.check_tight();
        w.check_same_as_model();
    }
    CHECK(sorted > 0);
}

TEST_CASE("tile_store: a letter tells where its particle was, and where in storage") {
    world<1, double> w(box<1>());
    w.add({3, 0, 0});
    w.add({5, 0, 0});
    w.store.arrange<2>();
    for (const detail::tile& t : w.store.tiles)
        w.each_particle_of(t, [&](std::uint32_t s, int l, const cell_index& from) {
            if (from[0] == 5) w.store.post(w.lattice, 0, t, s, l, from, {w.outside, 0, 0});
        });
    cell_index was{};
    const std::size_t moved = w.store.sort_mail(w.lattice, [&](auto& letter) {
        was = letter.from;
        CHECK(letter.value[0] == 2);
        CHECK(letter.origin < w.store.slots.size());
        return false;
    });
    CHECK(was == cell_index{5, 0, 0});
    CHECK(moved == 0);
    CHECK(w.store.size() == 1);
}

TEST_CASE("tile_store: slabs hold every tile once, and every other slab reaches nodes of its own") {
    slabs_are_apart<1, double, linear>({{0.}, {200.}, 1.});
    slabs_are_apart<1, double, cubic_spline>({{0.}, {200.}, 1.});
    slabs_are_apart<2, double, quadratic_spline>({{0., 0.}, {9., 40.}, 1.});
    slabs_are_apart<3, double, cubic_spline>({{0., 0., 0.}, {4., 4., 20.}, 1.});
#if TAMIS_XSIMD
    slabs_are_apart<1, native_lanes::type<double>, cubic_spline>({{0.}, {2000.}, 1.});
    slabs_are_apart<1, lanes<2>::type<double>, cubic_spline>({{0.}, {500.}, 1.});
    slabs_are_apart<2, native_lanes::type<double>, cubic_spline>({{0., 0.}, {30., 40.}, 1.});
    slabs_are_apart<3, native_lanes::type<double>, linear>({{0., 0., 0.}, {14., 14., 14.}, 1.});
#endif
}

TEST_CASE("tile_store: a sort that fails leaves all as it was") {
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
TEST_CASE("tile_store: threads sort as one does") {
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
