#include "unit/engine/storage_world.hpp"

using namespace tamis;
using namespace storage;

TEST_CASE("tile_slots: room that tiles left is taken again, so that slots do not become more for ever") {
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
