#pragma once
#include <tamis/mass/mass.hpp>
#include <tamis/update/schemes.hpp>

#include <cmath>

namespace tamis {

/// The full mass matrix's series until its last term is small: the error of the inverse by k terms is A^k, and the
/// size of the k-th term, |dv_k| = sqrt(sum m dv_k^2 / sum m), estimates it (docs/method.md, Mass policies).
class adaptive_mass {
  public:
    static constexpr bool full = true;
    using on_nodes = fields<const field::inverse_mass, field::velocity, field::increment, field::image>;

    /// Throws `error` if the tolerance is negative or `most` below 1.
    adaptive_mass(double tolerance, int most) : tolerance_(tolerance), most_(most) {
        if (!(tolerance >= 0 && std::isfinite(tolerance)))
            throw error(detail::sentence("adaptive_fmpm: the tolerance is ", tolerance,
                                         "; give a share of the lumped velocity, 0 or more"));
        if (most < 1) throw error(detail::sentence("adaptive_fmpm: at most ", most, " terms; give 1 or more"));
    }
    /// How many terms it takes, at most.
    int terms() const { return most_; }
    template <class From, class To> void filter(bool felt, auto& pass) const {
        pass.nodes(detail::copy_field<From, field::increment>{});
        if constexpr (!std::same_as<From, To>) pass.nodes(detail::copy_field<From, To>{});
        const double first = pass.increment_size();
        double last = first;
        int terms = 1;
        for (; terms < most_ && last > tolerance_ * first; ++terms) {
            detail::add_term<To, field::increment>(felt, pass);
            last = pass.increment_size();
        }
        if (felt) pass.report({terms, last});
    }

  private:
    double tolerance_;
    int most_;
};

/// FMPM with as many terms as it takes for |dv_k| <= tolerance |dv_1|, `most` at most. `mpm.series()` tells how many
/// the last step took, and |dv_k|. With tolerance 0 it is FMPM(most), and |dv_k| the estimate of its error.
struct adaptive_fmpm : transfer<adaptive_mass, set_velocity_move_by_mean> {
    static constexpr std::string_view name = "adaptive_fmpm";
    /// Throws `error` if the tolerance is negative or `most` below 1.
    adaptive_fmpm(double tolerance, int most) : transfer{adaptive_mass(tolerance, most), {}} {}
};

}  // namespace tamis
