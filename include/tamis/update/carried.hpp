#pragma once
#include <tamis/core/names.hpp>
#include <tamis/engine/terms.hpp>

#include <string_view>

namespace tamis::detail {

/// What particles carry to nodes: their velocity, and no slope of it.
struct carries_velocity {
    using on_particles = fields<const field::mass, const field::velocity>;
    static constexpr std::string_view text = "S^T M V";
    static constexpr bool by_offsets = false;
    template <class F, class S> TAMIS_INLINE static auto momentum(const auto& slot) {
        // In its place: a copy would go through memory in pieces.
        return plain_term<F, typename S::vector>{slot.template get<field::mass>() *
                                                 slot.template get<field::velocity>()};
    }
};

}  // namespace tamis::detail
