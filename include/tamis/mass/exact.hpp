#pragma once
// Not part of tamis.hpp: Eigen's sparse matrices take a second to compile.
#include <tamis/mass/mass.hpp>
#include <tamis/update/schemes.hpp>

#include <Eigen/SparseCholesky>

#include <cstdint>
#include <vector>

namespace tamis {

namespace detail {

/// The full mass matrix M~ = S^T M S of the nodes in use, factored. In 1D it is banded, and the factors are too.
template <class real> class factored_mass {
  public:
    using matrix_type = Eigen::SparseMatrix<real>;
    using vector_type = Eigen::Matrix<real, Eigen::Dynamic, 1>;

    /// The weights whose matrix this is.
    std::uint64_t made_for = 0;

    factored_mass() = default;
    // A copy of a solver's policies makes its own factors.
    factored_mass(const factored_mass&) {}
    factored_mass& operator=(const factored_mass&) = delete;

    /// `entries` by storage place of the nodes. Throws `error` if the matrix is singular.
    void factor(std::vector<Eigen::Triplet<real, std::int64_t>>& entries, std::size_t places) {
        row_of_.assign(places, -1);
        int rows = 0;
        for (const auto& e : entries)
            if (e.row() == e.col() && e.value() > real(0) && row_of_[place(e.row())] < 0) row_of_[place(e.row())] = 0;
        for (int& row : row_of_)
            if (row == 0) row = rows++;
        std::vector<Eigen::Triplet<real>> compact;
        compact.reserve(entries.size());
        for (const auto& e : entries) {
            const int i = row_of_[place(e.row())], j = row_of_[place(e.col())];
            if (i >= 0 && j >= 0) compact.emplace_back(i, j, e.value());
        }
        matrix_type mass(rows, rows);
        mass.setFromTriplets(compact.begin(), compact.end());
        factors_.compute(mass);
        bool regular = factors_.info() == Eigen::Success;
        if (regular && rows > 0) {
            const vector_type pivots = factors_.vectorD();
            const vector_type diagonal = mass.diagonal();
            // Rows of nodes with little mass are small, not singular: each pivot is compared with its own row.
            for (int i = 0; i < rows; ++i) {
                const int k = static_cast<int>(factors_.permutationP().indices()[i]);
                regular = regular && pivots[k] > real(64) * std::numeric_limits<real>::epsilon() * diagonal[i];
            }
        }
        if (!regular)
            throw error(
                "exact_fmpm: the full mass matrix is singular, for the particles are too few for their nodes; take "
                "more particles per cell, another shape, or fmpm<k>");
    }
    /// Replaces m dv of a column of nodes by M~^-1 m dv.
    void solve(real* column) const {
        vector_type right(factors_.rows());
        each_row([&](int row, std::size_t at) { right[row] = column[at]; });
        const vector_type solution = factors_.solve(right);
        each_row([&](int row, std::size_t at) { column[at] = solution[row]; });
    }

  private:
    std::vector<int> row_of_;
    Eigen::SimplicialLDLT<matrix_type> factors_;
    static std::size_t place(std::int64_t k) { return static_cast<std::size_t>(k); }
    template <class F> void each_row(F f) const {
        for (std::size_t at = 0; at < row_of_.size(); ++at)
            if (row_of_[at] >= 0) f(row_of_[at], at);
    }
};

/// dv becomes m dv.
struct increment_momentum {
    using list = fields<const field::inverse_mass, field::increment>;
    TAMIS_INLINE void operator()(auto i) const {
        using namespace symbols;
        i[dv] *= inverse_or_zero(i[im]);
    }
};

}  // namespace detail

/// The full mass matrix solved exactly, by sparse factors made anew whenever weights change: FMPM(k) for k to infinity.
/// `real`: the grid's number.
template <class real> struct exact_mass {
    static constexpr bool full = true;
    /// Conditions are solved with the matrix.
    static constexpr bool exact = true;
    using on_nodes = fields<const field::inverse_mass, field::velocity, field::increment>;

    template <class From, class To> void filter(bool felt, auto& pass) const {
        pass.nodes(detail::copy_field<From, field::increment>{});
        solve(pass);
        pass.nodes(detail::copy_field<field::increment, To>{});
        (void)felt;
    }
    /// Adds M~^-1 m dv to `To`, dv the increment at hand.
    template <class To> void series(bool, auto& pass) const {
        solve(pass);
        pass.nodes(detail::add_increment<To>{});
    }
    template <class Look> void each_term(auto& pass, Look look) const {
        solve(pass);
        look();
    }

  private:
    mutable detail::factored_mass<real> factors_;
    void solve(auto& pass) const {
        if (factors_.made_for != pass.weights_stamp()) {
            std::vector<Eigen::Triplet<real, std::int64_t>> entries;
            pass.each_weight_pair([&](std::size_t i, std::size_t j, const real& mass) {
                entries.emplace_back(static_cast<std::int64_t>(i), static_cast<std::int64_t>(j), mass);
            });
            factors_.factor(entries, pass.places());
            factors_.made_for = pass.weights_stamp();
        }
        pass.nodes(detail::increment_momentum{});
        pass.each_column(field::increment{}, [&](real* column) { factors_.solve(column); });
    }
};

/// FMPM(k) for k to infinity, by an exact solve; conditions hold exactly. Throws `error` if the matrix is singular.
template <class real = double> struct exact_fmpm : transfer<exact_mass<real>, set_velocity_move_by_mean> {
    static constexpr std::string_view name = "exact_fmpm";
};

}  // namespace tamis
