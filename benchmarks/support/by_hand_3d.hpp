#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <new>
#include <vector>

/// A 3D step written by hand, without the library, as the speed to reach: quadratic B-splines, lumped mass, FLIP,
/// stress last, linear elastic, no condition; a cube of n^3 cells (centred on nodes) with 2^3 particles each, none of
/// which changes cells. Storage is the library's: W neighbouring cells along x side by side, slot by slot.
namespace by_hand {

template <class Real, int W> class block_3d {
  public:
    explicit block_3d(int n) : n_(n), blocks_((n + W - 1) / W), row_(blocks_ * W + W), side_(n + 2) {
        const std::size_t nodes = static_cast<std::size_t>(row_) * static_cast<std::size_t>(side_ * side_);
        for (auto& column : node_) column.assign(nodes, Real(0));
        const std::size_t tiles = static_cast<std::size_t>(blocks_ * n * n);
        particle_.assign(tiles * slots * fields * W, Real(0));
        h_ = Real(1) / Real(n);
        for (std::size_t t = 0; t < tiles; ++t) seed(t);
    }
    std::size_t particles() const { return static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_ * n_) * slots; }
    Real momentum() const {
        Real sum(0);
        for (std::size_t k = 0; k < particle_.size() / (fields * W); ++k)
            for (int l = 0; l < W; ++l)
                sum += particle_[(k * fields + mass) * W + static_cast<std::size_t>(l)] *
                       particle_[(k * fields + velocity) * W + static_cast<std::size_t>(l)];
        return sum;
    }

    void step() {
        for (auto& column : node_) std::fill(column.begin(), column.end(), Real(0));
        each_tile([this](Real* p, std::size_t node) { to_grid(p, node); });
        Real *m = node_[0].data(), *p[3], *f[3];
        for (std::size_t d = 0; d < 3; ++d) {
            p[d] = node_[1 + d].data();
            f[d] = node_[4 + d].data();
        }
        for (std::size_t i = 0; i < node_[0].size(); ++i) {
            const Real inverse = m[i] > Real(1e-14) ? Real(1) / m[i] : Real(0);
            for (int d = 0; d < 3; ++d) {
                f[d][i] *= inverse * dt_;
                p[d][i] = p[d][i] * inverse + f[d][i];
            }
        }
        each_tile([this](Real* p_tile, std::size_t node) { to_particles(p_tile, node); });
    }

  private:
    typedef Real lanes __attribute__((vector_size(sizeof(Real) * W)));
    typedef Real loose __attribute__((vector_size(sizeof(Real) * W), aligned(sizeof(Real)), may_alias));
    static constexpr std::size_t slots = 8, fields = 14;
    static constexpr std::size_t place = 0, velocity = 3, stress = 6, mass = 12, volume = 13;
    static lanes load(const Real* p) { return *reinterpret_cast<const loose*>(p); }
    static void store(Real* p, lanes a) { *reinterpret_cast<loose*>(p) = a; }
    static lanes all(Real a) { return lanes{} + a; }

    int n_, blocks_, row_, side_;
    std::array<std::vector<Real>, 7> node_;
    std::vector<Real> particle_;
    Real h_, young_ = Real(1e6), poisson_ = Real(0.3), density_ = Real(1000);
    Real lambda_ = young_ * poisson_ / (1 + poisson_) / (1 - 2 * poisson_), mu_ = young_ / 2 / (1 + poisson_);
    Real dt_ = Real(0.2) / Real(n_) / std::sqrt(young_ / density_);

    void seed(std::size_t t) {
        const std::size_t n = static_cast<std::size_t>(n_), block = t % static_cast<std::size_t>(blocks_);
        const std::size_t y = t / static_cast<std::size_t>(blocks_) % n, z = t / static_cast<std::size_t>(blocks_) / n;
        for (std::size_t s = 0; s < slots; ++s)
            for (std::size_t l = 0; l < W; ++l) {
                Real* p = particle_.data() + (t * slots + s) * fields * W + l;
                const std::size_t x = block * W + l;
                if (x >= n) continue;
                for (std::size_t d = 0; d < 3; ++d) p[(place + d) * W] = Real(s >> d & 1u ? 0.25 : -0.25);
                p[mass * W] = density_ * h_ * h_ * h_ / Real(slots);
                p[volume * W] = h_ * h_ * h_ / Real(slots);
                p[velocity * W] = Real(0.01 * std::sin(3 * (double(x) + 0.5) * double(h_)));
                p[(velocity + 1) * W] = Real(0.01 * std::sin(2 * (double(y) + 0.5) * double(h_)));
                p[(velocity + 2) * W] = Real(0.01 * std::cos(3 * (double(z) + 0.5) * double(h_)));
            }
    }
    template <class F> void each_tile(F f) {
        std::size_t t = 0;
        for (int z = 0; z < n_; ++z)
            for (int y = 0; y < n_; ++y)
                for (int b = 0; b < blocks_; ++b, ++t)
                    f(particle_.data() + t * slots * fields * W,
                      static_cast<std::size_t>((z * side_ + y) * row_ + b * W));
    }
    struct weights {
        lanes w[3], d[3];
    };
    weights spline(const Real* r) const {
        const lanes f = load(r), a = Real(0.5) - f, b = Real(0.5) + f;
        const Real inverse = Real(1) / h_;
        return {{Real(0.5) * a * a, Real(0.75) - f * f, Real(0.5) * b * b},
                {-a * inverse, -(f + f) * inverse, b * inverse}};
    }
    std::size_t row_of(int dy, int dz) const { return static_cast<std::size_t>((dz * side_ + dy) * row_); }

    void to_grid(Real* tile, std::size_t node) {
        weights w[3][slots];
        for (std::size_t s = 0; s < slots; ++s)
            for (std::size_t d = 0; d < 3; ++d) w[d][s] = spline(tile + (s * fields + place + d) * W);
        for (int dz = 0; dz < 3; ++dz)
            for (int dy = 0; dy < 3; ++dy) {
                lanes sum[3][7];
                for (auto& a : sum)
                    for (auto& b : a) b = all(Real(0));
                for (std::size_t s = 0; s < slots; ++s) {
                    const Real* p = tile + s * fields * W;
                    const lanes wyz = w[1][s].w[dy] * w[2][s].w[dz], dyz = w[1][s].d[dy] * w[2][s].w[dz],
                                wdz = w[1][s].w[dy] * w[2][s].d[dz];
                    const lanes V = load(p + volume * W), mw = load(p + mass * W) * wyz;
                    const lanes vx = load(p + velocity * W), vy = load(p + (velocity + 1) * W),
                                vz = load(p + (velocity + 2) * W);
                    const lanes xx = load(p + stress * W), yy = load(p + (stress + 1) * W),
                                zz = load(p + (stress + 2) * W);
                    const lanes xy = load(p + (stress + 3) * W), yz = load(p + (stress + 4) * W),
                                xz = load(p + (stress + 5) * W);
                    const lanes Vw = V * wyz, Vy = V * dyz, Vz = V * wdz;
                    const lanes ax = xx * Vw, ay = xy * Vw, az = xz * Vw;
                    const lanes bx = xy * Vy + xz * Vz, by = yy * Vy + yz * Vz, bz = yz * Vy + zz * Vz;
                    for (int dx = 0; dx < 3; ++dx) {
                        const lanes wx = w[0][s].w[dx], d = w[0][s].d[dx], q = wx * mw;
                        sum[dx][0] += q;
                        sum[dx][1] += q * vx;
                        sum[dx][2] += q * vy;
                        sum[dx][3] += q * vz;
                        sum[dx][4] -= d * ax + wx * bx;
                        sum[dx][5] -= d * ay + wx * by;
                        sum[dx][6] -= d * az + wx * bz;
                    }
                }
                const std::size_t o = node + row_of(dy, dz);
                for (std::size_t dx = 0; dx < 3; ++dx)
                    for (std::size_t c = 0; c < 7; ++c) {
                        Real* to = node_[c].data() + o + dx;
                        store(to, load(to) + sum[dx][c]);
                    }
            }
    }
    void to_particles(Real* tile, std::size_t node) {
        for (std::size_t s = 0; s < slots; ++s) {
            Real* p = tile + s * fields * W;
            const weights x = spline(p + place * W), y = spline(p + (place + 1) * W), z = spline(p + (place + 2) * W);
            lanes v[3], a[3], g[3][3];
            for (std::size_t c = 0; c < 3; ++c) v[c] = a[c] = g[c][0] = g[c][1] = g[c][2] = all(Real(0));
            for (int dz = 0; dz < 3; ++dz)
                for (int dy = 0; dy < 3; ++dy) {
                    const std::size_t o = node + row_of(dy, dz);
                    const lanes wyz = y.w[dy] * z.w[dz], dyz = y.d[dy] * z.w[dz], wdz = y.w[dy] * z.d[dz];
                    for (std::size_t c = 0; c < 3; ++c) {
                        const Real *u = node_[1 + c].data() + o, *b = node_[4 + c].data() + o;
                        const lanes u0 = load(u), u1 = load(u + 1), u2 = load(u + 2);
                        const lanes su = x.w[0] * u0 + x.w[1] * u1 + x.w[2] * u2;
                        const lanes du = x.d[0] * u0 + x.d[1] * u1 + x.d[2] * u2;
                        const lanes sb = x.w[0] * load(b) + x.w[1] * load(b + 1) + x.w[2] * load(b + 2);
                        v[c] += su * wyz;
                        a[c] += sb * wyz;
                        g[c][0] += du * wyz;
                        g[c][1] += su * dyz;
                        g[c][2] += su * wdz;
                    }
                }
            const lanes trace = (g[0][0] + g[1][1] + g[2][2]) * (dt_ * lambda_);
            const Real two_mu = 2 * mu_ * dt_, one_mu = mu_ * dt_;
            const auto add = [p](std::size_t field, lanes change) {
                store(p + field * W, load(p + field * W) + change);
            };
            for (std::size_t c = 0; c < 3; ++c) {
                add(stress + c, trace + two_mu * g[c][c]);
                add(velocity + c, a[c]);
                add(place + c, (dt_ / h_) * v[c]);
            }
            add(stress + 3, one_mu * (g[0][1] + g[1][0]));
            add(stress + 4, one_mu * (g[1][2] + g[2][1]));
            add(stress + 5, one_mu * (g[0][2] + g[2][0]));
        }
    }
};

}  // namespace by_hand
