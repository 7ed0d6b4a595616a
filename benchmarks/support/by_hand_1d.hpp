#pragma once
#include <cmath>
#include <cstddef>
#include <new>
#include <vector>

/// ADMPM's driven bar written by hand, as the speed to reach in 1D: linear functions, lumped mass, FLIP, forces and
/// strains of the step's start, left end fixed, right end at 0.01 sin 10t. Cells lie side by side, slot by slot; no
/// particle changes cells.
// The columns of a loop do not overlap: compilers are told, so that they use vectors.
#if defined(__clang__)
#define BY_HAND_VECTORS _Pragma("clang loop vectorize(assume_safety)")
#else
#define BY_HAND_VECTORS _Pragma("GCC ivdep")
#endif

namespace by_hand {

/// Columns begin on a cache line.
template <class T> struct on_cache_lines {
    using value_type = T;
    static constexpr std::align_val_t line{64};
    on_cache_lines() = default;
    template <class U> on_cache_lines(const on_cache_lines<U>&) {}
    T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
    void deallocate(T* p, std::size_t) { ::operator delete(p, line); }
    template <class U> bool operator==(const on_cache_lines<U>&) const { return true; }
};

class bar_1d {
  public:
    bar_1d(int nodes, int per_cell, double dt, bool moving)
        : cells_(static_cast<std::size_t>(nodes - 1)),
          slots_(static_cast<std::size_t>(per_cell)),
          stride_((cells_ + 7) / 8 * 8),
          dt_(dt),
          inverse_h_(static_cast<double>(nodes - 1)),
          moving_(moving) {
        const std::size_t n = stride_ * slots_;
        for (auto* column : {&place_, &velocity_, &mass_, &stress_, &strain_, &volume_}) column->assign(n, 0.0);
        for (auto* column : {&inverse_mass_, &v_, &next_, &left_, &right_, &left_mass_, &right_mass_})
            column->assign(cells_ + 1, 0.0);
        std::vector<double> node_mass(cells_ + 1, 0.0);
        for (std::size_t s = 0; s < slots_; ++s)
            for (std::size_t c = 0; c < cells_; ++c) {
                const std::size_t p = s * stride_ + c;
                place_[p] = (double(s) + 0.5) / double(slots_);
                mass_[p] = volume_[p] = 1 / inverse_h_ / double(slots_);
                node_mass[c] += mass_[p] * (1 - place_[p]);
                node_mass[c + 1] += mass_[p] * place_[p];
            }
        for (std::size_t i = 0; i <= cells_; ++i) inverse_mass_[i] = 1 / node_mass[i];
    }
    std::size_t particles() const { return cells_ * slots_; }
    double velocity(std::size_t p) const { return velocity_[p]; }
    std::size_t cells() const { return cells_; }
    std::size_t slots() const { return slots_; }
    /// Of particle c of slot s.
    std::size_t number(std::size_t s, std::size_t c) const { return s * stride_ + c; }
    double spacing() const { return 1 / inverse_h_; }
    double time() const { return t_; }
    double place(std::size_t p) const { return place_[p]; }
    double mass(std::size_t p) const { return mass_[p]; }
    double volume(std::size_t p) const { return volume_[p]; }
    double stress(std::size_t p) const { return stress_[p]; }
    double strain(std::size_t p) const { return strain_[p]; }

    void step() {
        const std::size_t n = cells_;
        const double dt_h = dt_ * inverse_h_, young = young_;
        double* __restrict v = v_.data(), * __restrict next = next_.data(), * __restrict l = left_.data();
        const double* __restrict inverse = inverse_mass_.data();
        for (std::size_t i = 0; i < n; ++i) l[i] = 0;
        for (std::size_t s = 0; s < slots_; ++s) {
            double* __restrict sigma = stress_.data() + s * stride_, * __restrict e = strain_.data() + s * stride_;
            const double* __restrict volume = volume_.data() + s * stride_;
            BY_HAND_VECTORS
            for (std::size_t i = 0; i < n; ++i) {
                l[i] += volume[i] * sigma[i];
                e[i] += dt_h * (v[i + 1] - v[i]);
                sigma[i] = young * e[i];
            }
        }
        BY_HAND_VECTORS
        for (std::size_t i = 1; i < n; ++i) next[i] = v[i] + dt_h * (l[i] - l[i - 1]) * inverse[i];
        next[0] = 0;
        next[n] = 0.01 * std::sin(10 * t_);
        if (moving_)
            update_moving();
        else
            update_held();
        v_[0] = 0;
        v_[n] = next_[n];
        t_ += dt_;
    }

  private:
    std::size_t cells_, slots_, stride_;
    double dt_, inverse_h_, young_ = 1, t_ = 0;
    bool moving_;
    std::vector<double, on_cache_lines<double>> place_, velocity_, mass_, stress_, strain_, volume_;
    std::vector<double, on_cache_lines<double>> inverse_mass_, v_, next_, left_, right_, left_mass_, right_mass_;

    void update_moving() {
        const std::size_t n = cells_;
        const double dt_h = dt_ * inverse_h_;
        double *__restrict l = left_.data(), *__restrict r = right_.data(), *__restrict lm = left_mass_.data(),
               *__restrict rm = right_mass_.data();
        double* __restrict v_new = v_.data(), * __restrict inverses = inverse_mass_.data();
        const double* __restrict v = v_.data(), * __restrict next = next_.data();
        for (std::size_t i = 0; i < n; ++i) l[i] = r[i] = lm[i] = rm[i] = 0;
        for (std::size_t s = 0; s < slots_; ++s) {
            double* __restrict w = place_.data() + s * stride_, * __restrict V = velocity_.data() + s * stride_;
            const double* __restrict m = mass_.data() + s * stride_;
            BY_HAND_VECTORS
            for (std::size_t i = 0; i < n; ++i) {
                const double after = next[i] + w[i] * (next[i + 1] - next[i]);
                const double before = v[i] + w[i] * (v[i + 1] - v[i]);
                V[i] += after - before;
                w[i] += dt_h * after;
                const double right = m[i] * w[i], left = m[i] - right;
                l[i] += left * V[i];
                r[i] += right * V[i];
                lm[i] += left;
                rm[i] += right;
            }
        }
        BY_HAND_VECTORS
        for (std::size_t i = 1; i < n; ++i) {
            const double inverse = 1 / (lm[i] + rm[i - 1]);
            inverses[i] = inverse;
            v_new[i] = (l[i] + r[i - 1]) * inverse;
        }
    }
    void update_held() {
        const std::size_t n = cells_;
        double* __restrict l = left_.data(), * __restrict r = right_.data();
        const double* __restrict v = v_.data(), * __restrict next = next_.data();
        for (std::size_t i = 0; i < n; ++i) l[i] = r[i] = 0;
        for (std::size_t s = 0; s < slots_; ++s) {
            double* __restrict V = velocity_.data() + s * stride_;
            const double* __restrict w = place_.data() + s * stride_, * __restrict m = mass_.data() + s * stride_;
            BY_HAND_VECTORS
            for (std::size_t i = 0; i < n; ++i) {
                const double a0 = next[i] - v[i], a1 = next[i + 1] - v[i + 1];
                V[i] += a0 + w[i] * (a1 - a0);
                const double right = m[i] * w[i];
                l[i] += (m[i] - right) * V[i];
                r[i] += right * V[i];
            }
        }
        double* __restrict v_new = v_.data();
        const double* __restrict inverse = inverse_mass_.data();
        BY_HAND_VECTORS
        for (std::size_t i = 1; i < n; ++i) v_new[i] = (l[i] + r[i - 1]) * inverse[i];
    }
};

}  // namespace by_hand
