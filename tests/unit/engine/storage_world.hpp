#pragma once
#include <tamis/core/names.hpp>
#include <tamis/engine/tile_store.hpp>
#include <tamis/shape/linear.hpp>

#include <map>
#include <random>
#include <set>
#include <vector>

#include "catch.hpp"

/// A store of particles beside a plain model of it, for tests of storage, order and mail.
namespace storage {

using namespace tamis;

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

}  // namespace storage
