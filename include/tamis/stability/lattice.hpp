#pragma once
#include <tamis/stability/responses.hpp>
#include <tamis/stability/step_matrix.hpp>

namespace tamis::stability {

/// Particles in every cell of an endless grid of spacing 1, in all cells at the same places; density 1, P waves of
/// speed 1.
template <int Dim> struct lattice {
    /// Per axis.
    int per_cell = 2;
    /// From where they are in a whole cell's middle, along every axis, in cells.
    double offset = 0;
    /// Poisson's ratio.
    double poisson = 0;
};

/// A step of a lattice, wave by wave: disturbances exp(i theta x) are multiplied by a small matrix, the sum over
/// cells of the Jacobian's blocks times their phase (Bloch waves). Exact, because a step carries a disturbance no
/// farther than its sweeps reach.
template <int Dim> class lattice_step {
  public:
    /// Phase of a wave from cell to cell, along each axis.
    using wave_numbers = std::array<double, static_cast<std::size_t>(Dim)>;

    /// `reach`: how many cells a disturbance goes in a step, at most.
    template <class... Policies> lattice_step(const lattice<Dim>& set, int reach, const Policies&... policies)
        : side_(2 * reach + 1) {
        for (int k = 0; k < matrix::samples; ++k)
            at_[static_cast<std::size_t>(k)] = blocks_at(set, matrix::sample(k), policies...);
    }
    /// What a wave of the given numbers (radians per cell) is multiplied by, for every time step.
    auto of_wave(const wave_numbers& theta) const {
        std::array<Eigen::MatrixXcd, matrix::samples> sum;
        for (std::size_t k = 0; k < matrix::samples; ++k) {
            for (int c = 0; c < cells(); ++c) {
                double phase = 0;
                for (int d = 0, left = c; d < Dim; ++d, left /= side_)
                    phase -= theta[static_cast<std::size_t>(d)] * (left % side_ - side_ / 2);
                const Eigen::MatrixXcd part =
                    at_[k].middleRows(c * at_[k].cols(), at_[k].cols()) * std::polar(1., phase);
                if (c == 0)
                    sum[k] = part;
                else
                    sum[k] += part;
            }
        }
        return step_matrix<Eigen::MatrixXcd>(sum);
    }

  private:
    using matrix = step_matrix<Eigen::MatrixXd>;
    int side_;
    /// What disturbances of the middle cell do to all cells, a block of rows each.
    std::array<Eigen::MatrixXd, matrix::samples> at_;

    static constexpr int margin = 3;

    int cells() const { return tamis::detail::power(side_, Dim); }

    template <class... Policies>
    Eigen::MatrixXd blocks_at(const lattice<Dim>& set, double dt, const Policies&... policies) const {
        const int per_cell = tamis::detail::power(set.per_cell, Dim);
        std::vector<point<Dim, double>> places;
        for (int c = 0; c < cells(); ++c)
            for (int p = 0; p < per_cell; ++p) {
                point<Dim, double> at;
                for (int d = 0, cell = c, local = p; d < Dim; ++d, cell /= side_, local /= set.per_cell)
                    at[d] = margin + cell % side_ + (local % set.per_cell + 0.5) / set.per_cell + set.offset;
                places.push_back(at);
            }
        return responses<Dim>(places, 1. / per_cell, side_ + 2 * margin, set.poisson, cells() / 2 * per_cell, per_cell,
                              dt, policies...);
    }
};

}  // namespace tamis::stability
