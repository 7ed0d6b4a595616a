#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/tensor.hpp>

#include <cmath>

namespace tamis::detail {

// What laws have in common that keep the elastic left Cauchy-Green tensor without its change of volume, of determinant
// 1, and the ratio of volumes J.

/// The I for which det(dev + I 1) = I^3 - |dev|^2/2 I + det dev = 1, by Newton's method from the trial's I on. The
/// cubic is convex and rises from its largest root on, and the trial, whose dev has the same axes and is longer, is not
/// below that root: each round comes nearer from the same side. Four leave no more than rounding of a trial stretched
/// by up to 1.3; what they may leave else, the next step that yields takes away.
template <int Rounds, class Tensor, class T> TAMIS_INLINE T third_of_trace(const Tensor& dev, T I) {
    const T half = constant<T>(0.5) * dev.cwiseProduct(dev).sum(), rest = determinant(dev) - constant<T>(1);
    unroll<Rounds>([&](auto)
                       TAMIS_INLINE_LAMBDA { I = I - (I * (I * I - half) + rest) / (constant<T>(3) * I * I - half); });
    return I;
}

/// Throws `error` where a particle is turned inside out, or its elastic tensor is none, told by its trace.
inline void check_unimodular(double ratio, double trace) {
    if (!(ratio > 0 && std::isfinite(ratio)))
        throw error(sentence("its volume ratio is ", ratio,
                             "; give it a positive and finite one (1 where nothing is deformed), and see that steps "
                             "are short enough to keep it so"));
    if (!(trace > 0 && std::isfinite(trace)))
        throw error(sentence("its elastic Cauchy-Green tensor has the trace ", trace,
                             "; give it a tensor of determinant 1 (the identity where nothing is deformed)"));
}

}  // namespace tamis::detail
