#pragma once
#include <tamis/core/stamp.hpp>
#include <tamis/mass/assembling.hpp>

#include <cstdint>

namespace tamis::detail {

/// When a composition multiplies by its assembled full mass matrix, and whether the entries at the nodes are of the
/// weights that particles have now.
template <class C> class assembled_matrix {
    using mass_type = typename C::mass;
    static constexpr int pays_from = matrix_pays_from<C::dim, typename C::shape, C::moves>;
    static constexpr bool may_rest = requires(mass_type & mass) { mass.due; };

  public:
    /// Is it multiplied by for whatever number of terms there can be?
    static constexpr bool always = C::assembles && (pays_from <= 2 || terms_of<mass_type> != dynamic);
    /// ... and in every step?
    static constexpr bool every_step = always && !may_rest;

    /// Is it multiplied by for the number of terms there is?
    static bool pays(const mass_type& mass) {
        if constexpr (C::assembles && !always)
            return mass.terms() >= pays_from;
        else
            return C::assembles;
    }
    /// ... in this step?
    static bool is_due(const mass_type& mass) {
        if constexpr (may_rest)
            if (!mass.due) return false;
        return pays(mass);
    }

    /// A number that changes when weights may have changed.
    std::uint64_t weights() const { return weights_.number(); }
    void weights_change() { weights_.renew(); }
    bool is_made() const { return made_for_ == weights(); }
    /// Entries are about to be summed; what throws meanwhile leaves no matrix.
    void begin() { made_for_ = 0; }
    void made() { made_for_ = weights(); }

  private:
    stamp weights_;
    std::uint64_t made_for_ = 0;
};

}  // namespace tamis::detail
