#include <new>
#include <utility>

#include "unit/engine/storage_world.hpp"

using namespace tamis;
using namespace storage;

TEST_CASE("tile_store: through random moves, losses and sorting every particle is where the model says") {
    random_life<1, double>();
    random_life<2, double>();
    random_life<1, native_lanes::type<double>>();
    random_life<2, native_lanes::type<double>>();
    random_life<3, native_lanes::type<double>>();
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

TEST_CASE("tile_store: letters find their tiles where those were sorted meanwhile, for letters that had waited") {
    world<2, native_lanes::type<double>> w({{0., 0.}, {60., 40.}, 1.});
    // At the far end, so that tiles of all other cells come before these.
    const auto far_cell = [&] { return cell_index{w.any(60), 36 + w.any(4), 0}; };
    for (int k = 0; k < 4000; ++k) w.add(far_cell());
    w.store.sort(w.lattice, 0);
    w.store.arrange<2>();
    const auto post_some = [&](int odds, auto to_where, bool first_leaves) {
        bool leaves = first_leaves;
        for (std::size_t slab = 0; slab < w.store.slabs(); ++slab)
            for (const std::uint32_t k : w.store.row(slab))
                w.each_particle_of(w.store.tiles[k], [&](std::uint32_t s, int l, const cell_index& from) {
                    if (w.any(odds) != 0) return;
                    cell_index to = to_where();
                    const auto m = w.mass(s, l);
                    if (std::exchange(leaves, false)) {
                        to[0] = w.outside;
                        w.model.erase(m);
                    } else
                        w.model[m].cell = to;
                    w.store.post(w.lattice, slab, w.store.tiles[k], s, l, from, to);
                });
    };
    post_some(
        2, [&] { return w.any_cell(); }, true);
    CHECK_THROWS_AS(w.store.sort_mail(w.lattice, [](auto&) -> bool { throw std::bad_alloc(); }), std::bad_alloc);
    w.store.deliver_all();
    // Those that had waited make new tiles, for which all are sorted; these know where their tiles were before.
    post_some(2, far_cell, false);
    const auto ground = w.store.ground.number();
    w.store.sort_mail(w.lattice, [](auto&) { return false; });
    CHECK(w.store.ground.number() != ground);
    w.store.deliver_all();
    w.check_same_as_model();
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
