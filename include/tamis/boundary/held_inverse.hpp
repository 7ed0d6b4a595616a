#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/space.hpp>

#include <Eigen/Cholesky>

#include <cstddef>
#include <vector>

namespace tamis::detail {

/// The rows and columns of a full mass matrix's inverse that belong to held nodes (1/kg), and the impulses on all held
/// directions together that give them what their velocities lack.
template <int D, class real> class held_inverse {
  public:
    using vector = point<D, real>;
    /// A held direction at the node of a row, and the velocity that is wanting along it (m/s).
    struct direction {
        int row;
        vector normal;
        real wanted;
    };

    void start(int rows) { inverse_.setZero(rows, rows); }
    int rows() const { return static_cast<int>(inverse_.rows()); }
    void add(int row, int column, const real& value) { inverse_(row, column) += value; }
    const real& diagonal(int row) const { return inverse_(row, row); }

    /// Impulses j (N s), one along each direction, with [M~_k^-1] j = wanted. Throws `error` where that part of the
    /// inverse is singular.
    std::vector<real> impulses(const std::vector<direction>& all) const {
        const auto n = static_cast<Eigen::Index>(all.size());
        matrix system(n, n);
        Eigen::Matrix<real, Eigen::Dynamic, 1> right(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            const direction& a = all[static_cast<std::size_t>(i)];
            right[i] = a.wanted;
            for (Eigen::Index j = 0; j < n; ++j) {
                const direction& b = all[static_cast<std::size_t>(j)];
                system(i, j) = a.normal.dot(b.normal) * inverse_(a.row, b.row);
            }
        }
        if (n == 0) return {};
        const Eigen::LLT<matrix> factors(system);
        if (factors.info() != Eigen::Success)
            throw error(
                "boundary_method::collected: the held nodes' part of the mass matrix's inverse is singular; take "
                "boundary_method::incremental, or more particles per cell");
        const Eigen::Matrix<real, Eigen::Dynamic, 1> found = factors.solve(right);
        return {found.begin(), found.end()};
    }

  private:
    using matrix = Eigen::Matrix<real, Eigen::Dynamic, Eigen::Dynamic>;
    matrix inverse_;
};

}  // namespace tamis::detail
