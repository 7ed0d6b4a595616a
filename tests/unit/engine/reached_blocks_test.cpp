#include <tamis/shape/quadratic_spline.hpp>
#include <tamis/engine/reached_blocks.hpp>
#include <tamis/engine/tile_store.hpp>

#include <new>
#include <random>
#include <set>
#include <vector>

#include "catch.hpp"

using namespace tamis;

namespace {

using S = space<2, native_lanes::type<double>>;
using lattice_type = detail::lattice<S, quadratic_spline>;
using store_type = detail::tile_store<S, fields<field::mass>>;

/// Runs out of memory when it is looked at once too often.
struct failing_lattice : lattice_type {
    using lattice_type::lattice_type;
    mutable int left = 1 << 30;
    std::size_t row_offset(int r) const {
        if (--left < 0) throw std::bad_alloc();
        return lattice_type::row_offset(r);
    }
};

struct scene {
    failing_lattice lattice{uniform_grid<2, double>{{0., 0.}, {1., 1.}, 1. / 64}};
    store_type one{lattice.block_count()}, two{lattice.block_count()};
    std::mt19937 random{4};

    void add(store_type& to, int count) {
        for (int k = 0; k < count; ++k)
            to.add(lattice, {static_cast<int>(random() % 60), static_cast<int>(random() % 60), 0});
    }
    /// Written from the meaning: what each tile's rows of nodes reach.
    std::set<std::uint32_t> expected(const std::vector<const store_type*>& stores) const {
        std::set<std::uint32_t> blocks;
        for (const auto* store : stores)
            for (const auto& t : store->tiles)
                for (int r = 0; r < lattice_type::rows; ++r)
                    for (std::size_t k = 0; k < static_cast<std::size_t>(S::width) + 2; ++k)
                        blocks.insert(static_cast<std::uint32_t>((t.node + lattice.lattice_type::row_offset(r) + k) /
                                                                 static_cast<std::size_t>(S::width)));
        return blocks;
    }
    void mark(detail::reached_blocks& reached, const std::vector<const store_type*>& stores) const {
        std::vector<detail::placed_tiles> tiles;
        for (const auto* store : stores) tiles.push_back(detail::tiles_of(*store));
        reached.mark(tiles, lattice);
    }
    void check(const detail::reached_blocks& reached, const std::vector<const store_type*>& stores) const {
        const auto right = expected(stores);
        CHECK(reached.blocks() == std::vector<std::uint32_t>(right.begin(), right.end()));
        std::set<std::uint32_t> marked;
        for (std::uint32_t k = 0; k < reached.marks().size(); ++k)
            if (reached.marks()[k] != 0) marked.insert(k);
        CHECK(marked == right);
    }
};

}  // namespace

TEST_CASE("reached_blocks: marks what tiles reach, those that came later too, and no more") {
    scene a;
    detail::reached_blocks reached;
    a.add(a.one, 5);
    a.add(a.two, 3);
    a.mark(reached, {&a.one, &a.two});
    a.check(reached, {&a.one, &a.two});
    for (int round = 0; round < 5; ++round) {
        a.add(a.one, round);
        a.add(a.two, 2);
        a.mark(reached, {&a.one, &a.two});
        a.check(reached, {&a.one, &a.two});
    }
    a.mark(reached, {&a.two});
    a.check(reached, {&a.two});
    a.mark(reached, {});
    CHECK(reached.blocks().empty());
}

TEST_CASE("reached_blocks: what threw half way leaves nothing behind") {
    for (int looks = 0; looks < 30; ++looks) {
        CAPTURE(looks);
        scene a;
        detail::reached_blocks reached;
        a.add(a.one, 4);
        a.mark(reached, {&a.one});
        a.add(a.one, 10);
        a.lattice.left = looks;
        CHECK_THROWS_AS(a.mark(reached, {&a.one}), std::bad_alloc);
        a.lattice.left = 1 << 30;
        const std::vector<const store_type*> bodies =
            looks % 2 == 0 ? std::vector<const store_type*>{&a.one} : std::vector<const store_type*>{};
        a.mark(reached, bodies);
        a.check(reached, bodies);
    }
}
