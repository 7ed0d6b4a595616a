#pragma once
#include <tamis/core/values.hpp>

namespace tamis::detail {

// What a particle gives to the nodes around it is linear in the weight w of a node, in the weight's slope dw, and in
// the offset w (x_i - X). So it is said by factors, once a particle; the loop over nodes is the engine's.

/// Value times w.
template <class F, class Value> struct plain_term {
    Value value;
    TAMIS_INLINE void add(auto& to, const auto& node) const { to.template get<F>() += node.w * value; }
};
/// A tensor times dw.
template <class F, class Tensor> struct slope_term {
    Tensor value;
    TAMIS_INLINE void add(auto& to, const auto& node) const { to.template get<F>() += value * node.dw; }
};
/// A symmetric tensor, kept as its upper half, times -dw: what a stress does.
template <class S, class F> struct stress_term {
    symmetric_field::value<S> value;
    TAMIS_INLINE void add(auto& to, const auto& node) const { to.template get<F>() -= unpack<S>(value) * node.dw; }
};
/// A tensor times w (x_i - X).
template <class F, class Tensor> struct offset_term {
    Tensor value;
    TAMIS_INLINE void add(auto& to, const auto& node) const { to.template get<F>() += value * node.wx; }
};

template <class F, class Value> TAMIS_INLINE plain_term<F, Value> plain(const Value& value) { return {value}; }
template <class F, class Tensor> TAMIS_INLINE slope_term<F, Tensor> by_slope(const Tensor& value) { return {value}; }
template <class F, class Tensor> TAMIS_INLINE offset_term<F, Tensor> by_offset(const Tensor& value) { return {value}; }

template <int K, class Term> struct numbered_term { Term term; };
template <class Numbers, class... Term> struct numbered_terms;
template <int... K, class... Term> struct numbered_terms<std::integer_sequence<int, K...>, Term...>
    : numbered_term<K, Term>... {
    TAMIS_INLINE void add(auto& to, const auto& node) const { (numbered_term<K, Term>::term.add(to, node), ...); }
};
/// Several terms, added in their order.
template <class... Term> using terms =
    numbered_terms<std::make_integer_sequence<int, static_cast<int>(sizeof...(Term))>, Term...>;

}  // namespace tamis::detail
