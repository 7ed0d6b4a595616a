#pragma once
#include <tamis/core/each_of.hpp>
#include <tamis/core/error.hpp>
#include <tamis/core/names.hpp>
#include <tamis/load/body_load.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

namespace tamis::detail {

/// Places of particles of some bodies, to be looked at for those of two bodies that overlap.
template <int D> class overlapping {
  public:
    using place = point<D, double>;
    template <class... Body> explicit overlapping(const std::tuple<Body&...>& all) {
        int k = 0;
        each_of(all, [&](const auto& body) {
            for (const auto p : body) {
                one_particle one{
                    {}, k, to_double(side_of<D>(typename std::remove_cvref_t<decltype(body)>::real(p[symbols::V])))};
                const auto at = p[symbols::x];
                for (int d = 0; d < D; ++d) one.at[d] = to_double(at[d]);
                particles_.push_back(one);
            }
            ++k;
        });
    }
    /// A sentence about two particles of different bodies nearer than half their spacing; empty if there are none.
    TAMIS_SELDOM std::string told() {
        drop_far();
        if (particles_.empty()) return {};
        double reach = 0;
        for (const auto& p : particles_) reach = std::max(reach, p.side / 2);
        std::vector<filed> order;
        for (std::size_t k = 0; k < particles_.size(); ++k) order.push_back({cube_of(particles_[k].at, reach), k});
        std::sort(order.begin(), order.end());
        for (const filed& own : order)
            for (int c = 0; c < power(3, D); ++c) {
                cube in = own.in;
                in[0] += c % 3 - 1;
                in[1] += D > 1 ? c / 3 % 3 - 1 : 0;
                in[2] += D > 2 ? c / 9 - 1 : 0;
                for (auto k = std::lower_bound(order.begin(), order.end(), filed{in, 0});
                     k != order.end() && k->in == in; ++k) {
                    const auto &a = particles_[own.particle], &b = particles_[k->particle];
                    const double distance = (a.at - b.at).norm();
                    if (a.of < b.of && distance < (a.side + b.side) / 4)
                        return sentence("bodies ", a.of, " and ", b.of, " overlap: particles of them are ", distance,
                                        " apart at (", list_of(a.at),
                                        "), less than half their spacing; keep their "
                                        "regions apart");
                }
            }
        return {};
    }

  private:
    using cube = std::array<long, 3>;
    struct one_particle {
        place at;
        int of;
        double side;
    };
    struct filed {
        cube in;
        std::size_t particle;
        bool operator<(const filed& o) const { return in != o.in ? in < o.in : particle < o.particle; }
    };
    std::vector<one_particle> particles_;

    static cube cube_of(const place& at, double side) {
        cube in{0, 0, 0};
        for (int d = 0; d < D; ++d) in[static_cast<std::size_t>(d)] = static_cast<long>(std::floor(at[d] / side));
        return in;
    }
    /// Particles that are in no other body's box need not be looked at.
    void drop_far() {
        struct box {
            place low = place::Constant(1e300), high = place::Constant(-1e300);
        };
        std::vector<box> boxes;
        double most = 0;
        for (const auto& p : particles_) {
            boxes.resize(std::max(boxes.size(), static_cast<std::size_t>(p.of) + 1));
            box& of = boxes[static_cast<std::size_t>(p.of)];
            for (int d = 0; d < D; ++d) {
                of.low[d] = std::min(of.low[d], p.at[d]);
                of.high[d] = std::max(of.high[d], p.at[d]);
            }
            most = std::max(most, p.side);
        }
        const auto in = [&](const box& of, const place& at) {
            bool yes = true;
            for (int d = 0; d < D; ++d) yes = yes && at[d] > of.low[d] - most && at[d] < of.high[d] + most;
            return yes;
        };
        const auto far = [&](const one_particle& p) {
            for (std::size_t k = 0; k < boxes.size(); ++k)
                if (static_cast<int>(k) != p.of && in(boxes[k], p.at)) return false;
            return true;
        };
        particles_.erase(std::remove_if(particles_.begin(), particles_.end(), far), particles_.end());
    }
};

}  // namespace tamis::detail
