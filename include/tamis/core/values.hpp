#pragma once
#include <tamis/core/names.hpp>
#include <tamis/core/unroll.hpp>

#include <utility>

namespace tamis {

namespace detail {

/// Place of component (d, e) of a symmetric tensor in its upper half: diagonal first. For constants: clang would keep
/// the recursion as a loop.
constexpr int packed(int dim, int d, int e) {
    return d == e ? d : d > e ? packed(dim, e, d) : dim == 2 ? 2 : dim + d + e - 1;
}

template <class S> TAMIS_INLINE typename S::tensor unpack(const symmetric_field::value<S>& half) {
    typename S::tensor full;
    unroll<S::dim * S::dim>([&](auto k) TAMIS_INLINE_LAMBDA {
        constexpr int d = k / S::dim, e = k % S::dim, place = packed(S::dim, d, e);
        full(d, e) = half[place];
    });
    return full;
}

template <class S, class Tensor> TAMIS_INLINE void pack(symmetric_field::value<S>& half, const Tensor& full) {
    unroll<S::dim * S::dim>([&](auto k) TAMIS_INLINE_LAMBDA {
        constexpr int d = k / S::dim, e = k % S::dim, place = packed(S::dim, d, e);
        if constexpr (d <= e) half[place] = full(d, e);
    });
}

/// A symmetric tensor in storage, whose components are `Stride` numbers apart: reads as a full one, and is written as a
/// whole. Of a tensor that is not symmetric the upper half counts. Only `p[f]` itself is written to, not a copy of it,
/// which would still read as before.
template <class Full, int Stored, int Stride = 1> class stored_symmetric : public Full {
  public:
    using number = typename Full::Scalar;
    static constexpr int rows = Full::RowsAtCompileTime;

    TAMIS_INLINE explicit stored_symmetric(number* first) : Full(read(first)), first_(first) {}
    stored_symmetric(const stored_symmetric&) = default;
    void operator=(const stored_symmetric&) = delete;

    TAMIS_INLINE static Full read(const number* first) {
        Full full;
        unroll<rows * rows>([&](auto k) TAMIS_INLINE_LAMBDA {
            constexpr int d = k / rows, e = k % rows, place = packed(rows, d, e);
            if constexpr (place < Stored)
                full(d, e) = first[place * Stride];
            else
                full(d, e) = constant<number>(0);
        });
        return full;
    }
    template <class E> TAMIS_INLINE void operator=(const Eigen::MatrixBase<E>& full) const&& { write(full); }
    template <class E> TAMIS_INLINE void operator+=(const Eigen::MatrixBase<E>& more) const&& { write(*this + more); }
    template <class E> TAMIS_INLINE void operator-=(const Eigen::MatrixBase<E>& less) const&& { write(*this - less); }

  private:
    number* first_;
    TAMIS_INLINE void write(const Full& full) const {
        unroll<rows * rows>([&](auto k) TAMIS_INLINE_LAMBDA {
            constexpr int d = k / rows, e = k % rows, place = packed(rows, d, e);
            if constexpr (d <= e && place < Stored) first_[place * Stride] = full(d, e);
        });
    }
};

/// Component c of a scalar or a small matrix.
template <class S, class Value> TAMIS_INLINE auto& component(Value& value, int c) {
    if constexpr (std::same_as<std::remove_const_t<Value>, typename S::scalar>)
        return value;
    else
        return value.data()[c];
}

template <class S, class F> struct held_value { typename F::template value<S> value; };

}  // namespace detail

/// One row of fields: one value each, in W lanes.
template <class S, class List> struct values;
/// One row of the fields F.
template <class S, class... F> struct values<S, fields<F...>> : detail::held_value<S, std::remove_const_t<F>>... {
    /// The fields.
    using list = fields<F...>;
    /// How many numbers a lane of the row has.
    static constexpr int components = (0 + ... + F::template components<S>);

    /// The value of field G.
    template <class G> TAMIS_INLINE auto& get() { return detail::held_value<S, std::remove_const_t<G>>::value; }
    /// The value of field G, to read.
    template <class G> TAMIS_INLINE const auto& get() const {
        return detail::held_value<S, std::remove_const_t<G>>::value;
    }
    /// Number of components before those of G.
    template <class G> static constexpr int first() {
        static_assert(stores<list, G>,
                      "tamis: no policy of this scene asked for that field; name it in make_body's "
                      "last argument, fields<...>{}");
        int c = 0;
        bool found = false;
        ((found = found || std::same_as<std::remove_const_t<F>, std::remove_const_t<G>>,
          c += found ? 0 : F::template components<S>),
         ...);
        return c;
    }
    /// Makes all values 0.
    TAMIS_INLINE void set_zero() { (zero(get<F>()), ...); }

  private:
    template <class Value> TAMIS_INLINE static void zero(Value& value) {
        if constexpr (std::same_as<Value, typename S::scalar>)
            value = Value(typename S::real(0));
        else  // each kind of expression of Eigen takes long to compile
            detail::unroll<static_cast<int>(Value::SizeAtCompileTime)>(
                [&](auto k) TAMIS_INLINE_LAMBDA { value.data()[k] = typename S::scalar(typename S::real(0)); });
    }
};

/// Values shown to a policy: exactly the fields it declared, const where it only reads.
template <class Values, class Shown> struct view {
    /// The row.
    Values& all;
    /// The value of field F, which must be among the fields shown.
    template <class F> TAMIS_INLINE decltype(auto) operator[](F) const {
        static_assert(contains<Shown, F>,
                      "tamis: a policy touches a field it did not declare; add it to the policy's "
                      "on_particles or on_nodes list");
        if constexpr (writes<Shown, F>)
            return (all.template get<F>());
        else
            return std::as_const(all.template get<F>());
    }
};

}  // namespace tamis
