#pragma once
#include <tamis/engine/tile_store.hpp>

namespace tamis {

namespace detail {

/// A symmetric tensor of one particle: reads as a full tensor, and is set from one.
template <int Dim, class Real> class symmetric_reference {
  public:
    symmetric_reference(Real* first, int stride) : first_(first), stride_(stride) {}
    using tensor = matrix<Dim, std::remove_const_t<Real>>;
    operator tensor() const { return value(); }
    tensor value() const {
        tensor full;
        for (int d = 0; d < Dim; ++d)
            for (int e = 0; e < Dim; ++e) full(d, e) = (*this)(d, e);
        return full;
    }
    Real& operator()(int d, int e) const { return first_[packed(Dim, d, e) * stride_]; }
    template <class Tensor> const symmetric_reference& operator=(const Eigen::MatrixBase<Tensor>& full) const {
        for (int d = 0; d < Dim; ++d)
            for (int e = d; e < Dim; ++e) (*this)(d, e) = (full(d, e) + full(e, d)) / Real(2);
        return *this;
    }

  private:
    Real* first_;
    int stride_;
};

}  // namespace detail

/// One particle of a body, for set-up and observation: `p[v][0] = 1`, `p[m]`, `p[x]` (by value). Storage is columns of
/// W lanes, so vectors and tensors are Eigen maps with a stride.
template <class Body, bool Const> class particle {
  public:
    /// Types and dimension, as the body has them.
    /// @{
    using S = typename Body::space_type;
    using real = typename S::real;
    using store_type = std::conditional_t<Const, const typename Body::store_type, typename Body::store_type>;
    using body_type = std::conditional_t<Const, const Body, Body>;
    static constexpr int D = S::dim, W = S::width;
    /// @}

    /// The particle in a lane of a slot.
    particle(body_type& body, std::size_t tile, std::uint32_t slot, int lane_index)
        : body_(&body), tile_(tile), slot_(slot), lane_(lane_index) {}

    /// The particle's value of a field, `p[symbols::v]`: a reference, but for the position.
    template <class F> decltype(auto) operator[](F) const {
        using row = typename Body::store_type::slot;
        if constexpr (std::same_as<F, field::position>)
            return position();
        else {
            auto* first = body_->store().lane_of(slot_, lane_) + row::template first<F>() * W;
            using number = std::remove_pointer_t<decltype(first)>;
            if constexpr (std::is_base_of_v<scalar_field, F>)
                return (*first);
            else if constexpr (std::is_base_of_v<vector_field, F>) {
                using value = std::conditional_t<Const, const point<D, real>, point<D, real>>;
                return Eigen::Map<value, 0, Eigen::InnerStride<W>>(first);
            } else if constexpr (std::is_base_of_v<tensor_field, F>) {
                using value = std::conditional_t<Const, const matrix<D, real>, matrix<D, real>>;
                return Eigen::Map<value, 0, Eigen::Stride<D * W, W>>(first);
            } else if constexpr (std::is_base_of_v<symmetric_3x3_field, F>) {
                using stored = detail::stored_symmetric<matrix<3, real>, F::template components<S>, W>;
                if constexpr (Const)
                    return stored::read(first);
                else
                    return static_cast<const stored>(stored(first));
            } else if constexpr (std::is_base_of_v<symmetric_field, F>) {
                if constexpr (Const)
                    return detail::symmetric_reference<D, const number>(first, W).value();
                else
                    return detail::symmetric_reference<D, number>(first, W);
            } else
                return first;
        }
    }
    /// Cell of the bookkeeping the particle is in.
    std::array<int, 3> cell() const {
        const auto& at = body_->store().tiles[tile_].at;
        return {at[0] * W + lane_, at[1], at[2]};
    }
    /// Where it is stored.
    /// @{
    std::size_t tile() const { return tile_; }
    std::uint32_t slot() const { return slot_; }
    int lane_index() const { return lane_; }
    /// @}

  private:
    body_type* body_;
    std::size_t tile_;
    std::uint32_t slot_;
    int lane_;

    const point<D, real> position() const { return body_->position_of(tile_, slot_, lane_); }
};

}  // namespace tamis
