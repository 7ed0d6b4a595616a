#pragma once
#include <tamis/tamis.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

/// Motions in steps: each f is the gradient from the last place to the next.
namespace motion_of {

using tensor = Eigen::Matrix3d;
using steps = std::vector<tensor>;

inline tensor along(int d, int e, double size) {
    tensor f = tensor::Identity();
    f(d, e) += size;
    return f;
}
inline steps uniaxial(double size, int count) { return steps(static_cast<std::size_t>(count), along(0, 0, size)); }
inline steps shear(double size, int count) { return steps(static_cast<std::size_t>(count), along(0, 1, size)); }
/// Equal steps of a stretch along each axis.
inline steps stretched(double x, double y, double z, int count) {
    const tensor f = (Eigen::Vector3d(x, y, z).array() + 1).matrix().asDiagonal();
    return steps(static_cast<std::size_t>(count), f);
}
inline steps joined(steps first, const steps& then) {
    first.insert(first.end(), then.begin(), then.end());
    return first;
}
/// Stretched, back beyond the start, and stretched again, sheared a little all the while.
inline steps there_and_back(double size, int count) {
    steps all;
    for (const double sign : {1., -2., 1.5})
        for (int n = 0; n < std::abs(sign) * count; ++n) {
            tensor f = along(0, 0, sign < 0 ? -size : size);
            f(1, 0) = size / 3;
            f(1, 1) -= size / 4;
            all.push_back(f);
        }
    return all;
}
/// All components at once, in 3D.
inline steps twisted(double size, int count) {
    steps all;
    for (int n = 0; n < count; ++n) {
        tensor f = tensor::Identity();
        for (int c = 0; c < 9; ++c) f.data()[c] += size * std::sin(1 + 2.3 * c + 0.2 * n);
        all.push_back(f);
    }
    return all;
}
/// A turn about an axis that is none of the grid's.
inline tensor turn(double angle) {
    return Eigen::AngleAxisd(angle, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
}
/// The same motion watched by someone who turns by `angle` in a step.
inline steps turned(steps all, double angle) {
    double now = 0;
    for (auto& f : all) {
        f = turn(now + angle) * f * turn(now).transpose();
        now += angle;
    }
    return all;
}

}  // namespace motion_of

/// The number in lane l.
template <class T> double in_lane(const T& a, int l) {
    typename tamis::lane<T>::real out[tamis::lane<T>::width];
    tamis::lane<T>::store(out, a);
    return static_cast<double>(out[l]);
}
template <class T, int R>
Eigen::Matrix<double, R, R> in_lane(const Eigen::Matrix<T, R, R, Eigen::DontAlign>& a, int l) {
    Eigen::Matrix<double, R, R> out;
    for (int c = 0; c < R * R; ++c) out.data()[c] = in_lane(a.data()[c], l);
    return out;
}

/// What a particle has after a step: its elastic left Cauchy-Green tensor, its stress, whole and of the first D axes,
/// and what its law keeps besides.
struct moved_state {
    Eigen::Matrix3d b, full;
    Eigen::MatrixXd tau;
    double alpha, energy, J = 1, opening = 0, temperature = 0, damage = 0;
};

template <class S, class Law> using slot_of =
    tamis::values<S, tamis::merge<tamis::fields<tamis::field::stress>, tamis::on_particles_t<Law>>>;
template <class S> tamis::detail::frame<S> unit_frame() {
    using real = typename S::real;
    return {real(1), real(1), {}};
}
/// W particles as a law starts them.
template <class S, class Law> slot_of<S, Law> fresh(const Law& law) {
    slot_of<S, Law> slot;
    slot.set_zero();
    const auto at = unit_frame<S>();
    law.start(tamis::detail::slot_row<S, slot_of<S, Law>, tamis::on_particles_t<Law>>{slot, at});
    return slot;
}

/// W particles in dimension D, lane l moved by the steps that motion(l) gives, as strain_slot does it: state l of step
/// n is at n W + l.
template <int D, class T, class Law, class Motion>
std::vector<moved_state> moved(const Law& law, double dt, const Motion& motion) {
    using namespace tamis;
    using S = space<D, T>;
    using real = typename S::real;
    constexpr int W = S::width;
    auto slot = fresh<S>(law);
    using row = detail::slot_row<S, slot_of<S, Law>,
                                 typename detail::concatenate<fields<const field::stress>, on_particles_t<Law>>::type>;
    const auto at = unit_frame<S>();
    std::vector<motion_of::steps> each;
    for (int l = 0; l < W; ++l) each.push_back(motion(l));
    std::vector<moved_state> states;
    for (std::size_t n = 0; n < each[0].size(); ++n) {
        typename S::tensor L;
        for (int c = 0; c < D * D; ++c) {
            real lanes_of[W];
            for (int l = 0; l < W; ++l) {
                const auto& f = each[static_cast<std::size_t>(l)][n];
                lanes_of[l] = static_cast<real>((f(c % D, c / D) - (c % D == c / D ? 1 : 0)) / dt);
            }
            L.data()[c] = lane<T>::load(lanes_of);
        }
        detail::strain_slot<S>(law, slot, (1u << W) - 1u, at, L, T(real(dt)));
        const row p{slot, at};
        const Eigen::Matrix<T, 3, 3, Eigen::DontAlign> b = p[field::elastic_cauchy_green{}], full = law.full_stress(p);
        const Eigen::Matrix<T, D, D, Eigen::DontAlign> tau = p[symbols::sigma];
        const T energy = law.energy(p, 0);
        for (int l = 0; l < W; ++l) {
            moved_state is{in_lane(b, l), in_lane(full, l), in_lane(tau, l), in_lane(p[field::plastic_strain{}], l),
                           in_lane(energy, l)};
            const auto kept = [&](auto field, double& to) {
                if constexpr (stores<typename slot_of<S, Law>::list, decltype(field)>) to = in_lane(p[field], l);
            };
            kept(field::volume_ratio{}, is.J);
            kept(field::opening{}, is.opening);
            kept(field::temperature{}, is.temperature);
            kept(field::damage{}, is.damage);
            states.push_back(is);
        }
    }
    return states;
}
template <int D = 3, class Law>
std::vector<moved_state> moved(const Law& law, double dt, const motion_of::steps& motion) {
    return moved<D, double>(law, dt, [&](int) { return motion; });
}

/// Steps a reference beside every lane of what `moved` gave, the axes beyond D held: compare(state, reference) after
/// each step, with(l, reference) at the end.
template <int D, class T, class Reference> void beside(const std::vector<moved_state>& ours, const auto& motion,
                                                       const Reference& start, const auto& compare, const auto& with) {
    constexpr int W = tamis::lane<T>::width;
    for (int l = 0; l < W; ++l) {
        Reference plain = start;
        const motion_of::steps all = motion(l);
        for (std::size_t n = 0; n < all.size(); ++n) {
            Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
            f.topLeftCorner(D, D) = all[n].topLeftCorner(D, D);
            plain.step(f);
            compare(ours[n * W + static_cast<std::size_t>(l)], plain);
        }
        with(l, plain);
    }
}

/// How far the stresses that an observer sees who turns by `angle` in a step are from the turned ones, at most.
inline double seen_otherwise(const std::vector<moved_state>& still, const std::vector<moved_state>& turning,
                             double angle) {
    double worst = 0;
    for (std::size_t n = 0; n < still.size(); ++n) {
        const Eigen::Matrix3d R = motion_of::turn(angle * static_cast<double>(n + 1));
        worst = std::max(worst, (turning[n].full - R * still[n].full * R.transpose()).norm());
    }
    return worst;
}
