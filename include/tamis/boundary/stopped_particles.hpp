#pragma once
#include <tamis/core/config.hpp>
#include <tamis/core/names.hpp>
#include <tamis/engine/tile.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace tamis::detail {

/// Stops the particles of tiles at walls (`held_walls`), and keeps what that takes until it is asked for.
template <class Walls> class stopped_particles {
  public:
    using real = typename Walls::real;
    using lattice_type = typename Walls::lattice_type;
    using push = typename Walls::push;
    static constexpr int D = Walls::D, W = Walls::W;

    explicit stopped_particles(const Walls& walls) : walls_(walls) {}
    /// Threads have a place for what they find, one for each slab.
    void have_slabs(std::size_t count) {
        if (slabs_.size() < count) slabs_.resize(count);
    }

    /// Marks the tiles of a body that are near walls.
    template <class Store> void mark_tiles(Store& store, const lattice_type& lattice) const {
        store.mark_fence(walls_.number(), [&](const tile& t) { return walls_.near(lattice, t); });
    }

    // What the engine asks before and after it moves the particles of such a tile.

    /// Remembers where the particles are.
    template <class Store> TAMIS_NOINLINE void keep(const Store& store, std::size_t slab, const tile& t) {
        auto& before = slabs_[slab].before;
        before.resize(t.count * static_cast<std::size_t>(D * W));
        for (std::uint32_t s = 0; s < t.count; ++s)
            for (int c = 0; c < D * W; ++c)
                before[s * static_cast<std::size_t>(D * W) + static_cast<std::size_t>(c)] =
                    place_in(store, t.first + s, 0)[c];
    }
    /// Stops those that passed a wall since.
    template <class Store>
    void stop(Store& store, const lattice_type& lattice, std::size_t slab, const tile& t, const real& inverse_dt) {
        const real* before = slabs_[slab].before.data();
        for (std::uint32_t s = t.first; s < t.first + t.count; ++s, before += D * W) {
            // Most have passed no plane of nodes: those are a cell apart, `shift` from where cells begin.
            const real shift(Walls::shift), low(Walls::shift > 0 ? Walls::shift - 1 : 0), high(1 + Walls::shift);
            const real* const now = place_in(store, s, 0);
            int passed = 0;  // numbers, so that the loop has no branch
            for (int c = 0; c < D * W; ++c) {
                passed |= int(now[c] < low) | int(!(now[c] <= high));
                if constexpr (Walls::shift > 0)
                    passed |= int((before[c] < shift) != (now[c] < shift)) | int(before[c] == shift);
            }
            if (passed != 0) [[unlikely]]
                stop_in_slot(store, lattice, slab, t, s, before, inverse_dt);
        }
    }

    /// f(push) for all that was found in the slabs, in an order that does not depend on threads; they are forgotten.
    template <class F> void take_pushes(const F& f) {
        for (auto& slab : slabs_) {
            for (const push& one : slab.pushes) f(one);
            slab.pushes.clear();
        }
    }

  private:
    using vector = typename Walls::vector;
    static constexpr std::size_t at(int k) { return static_cast<std::size_t>(k); }
    struct alignas(64) of_slab {
        std::vector<real> before;
        std::vector<push> pushes;
    };
    const Walls& walls_;
    std::vector<of_slab> slabs_;

    template <class Store> static auto* place_in(Store& store, std::uint32_t s, int l) {
        return store.lane_of(s, l) + Store::slot::template first<field::position>() * W;
    }
    template <class Store> TAMIS_NOINLINE void stop_in_slot(Store& store, const lattice_type& lattice, std::size_t slab,
                                                            const tile& t, std::uint32_t s, const real* before,
                                                            const real& inverse_dt) {
        using slot = typename Store::slot;
        constexpr int pm = slot::template first<field::mass>(), pv = slot::template first<field::velocity>();
        for (int l = 0; l < W; ++l) {
            if (!(store.occupied[s] >> l & 1u)) continue;
            real* const r = place_in(store, s, l);
            real* const p = store.lane_of(s, l);
            const std::array<int, 3> cell{t.at[0] * W + l, t.at[1], t.at[2]};
            vector from, to, velocity;
            for (int d = 0; d < D; ++d) {
                from[d] = before[d * W + l];
                to[d] = r[d * W];
                velocity[d] = p[(pv + d) * W];
            }
            if (!walls_.stop(lattice, cell, from, to, velocity, p[pm * W], inverse_dt, slabs_[slab].pushes)) continue;
            for (int d = 0; d < D; ++d) {
                r[d * W] = to[d];
                p[(pv + d) * W] = velocity[d];
            }
        }
    }
};

}  // namespace tamis::detail
