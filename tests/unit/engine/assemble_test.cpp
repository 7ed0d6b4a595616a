// The full mass matrix assembled from products along the axes, and its product with a field, against the matrix made of
// every particle's pairs of nodes one by one.
#include <tamis/core/execution.hpp>
#include <tamis/material/linear_elastic.hpp>
#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/linear.hpp>
#include <tamis/run/solver.hpp>

#include <Eigen/Dense>

#include <random>

#include "catch.hpp"

using namespace tamis;

namespace {

template <int Dim> uniform_grid<Dim, double> box() {
    if constexpr (Dim == 1)
        return {{0.}, {21.}, 1.};
    else if constexpr (Dim == 2)
        return {{0., 0.}, {9., 4.}, 1.};
    else
        return {{0., 0., 0.}, {5., 2., 2.}, 1.};
}

template <int Dim, class Shape, class Lanes> void is_the_matrix() {
    using solver_type = solver<uniform_grid<Dim, double>, Shape, pic, Lanes>;
    using S = typename detail::composition<uniform_grid<Dim, double>, Shape, pic, Lanes>::S;
    constexpr int N = Shape::support;
    using matrix_field = field::mass_entries<N>;
    using entries = detail::matrix_entries<Dim, N>;
    CAPTURE(Dim, N, S::width);

    std::mt19937 random(3);
    std::vector<point<Dim, double>> places(150);
    for (auto& at : places)
        for (int d = 0; d < Dim; ++d) at[d] = std::uniform_real_distribution<double>(0, box<Dim>().upper()[d])(random);
    const Shape functions{};
    const solver_type mpm{box<Dim>(), functions, pic{}, Lanes{}};
    auto body = mpm.make_body_at(linear_elastic{.young = 1, .density = 1}, places, 1.);
    for (auto p : body) p[symbols::m] = std::uniform_real_distribution<double>(0.5, 2)(random);
    body.store().template arrange<N>();

    const serial run{};
    const detail::lattice<S, Shape> lattice{box<Dim>()};
    using node_fields = fields<field::mass, field::velocity, field::image, matrix_field>;
    detail::sweeps<S, Shape, node_fields, serial, true> sweeps{functions, lattice, run};
    const auto count = static_cast<Eigen::Index>(lattice.size());
    std::vector<std::uint32_t> blocks;
    for (std::size_t k = 0; k < lattice.size() / S::width; ++k) blocks.push_back(static_cast<std::uint32_t>(k));
    sweeps.nodes().set_active(blocks);
    auto& nodes = sweeps.nodes();

    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
    sweeps.each_weight_pair(body, [&](std::size_t i, std::size_t j, double value) {
        matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) += value;
    });
    REQUIRE(matrix.sum() > 100);
    sweeps.assemble_matrix(body);

    // Each entry, and none beside them.
    Eigen::MatrixXd found = Eigen::MatrixXd::Zero(count, count);
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(blocks.size()) * S::width; ++i)
        for (int row = 0; row < entries::rows; ++row)
            for (int dx = row == 0 ? 0 : 1 - N; dx < N; ++dx) {
                const double value = nodes.template at<matrix_field>(static_cast<std::size_t>(i), entries::of(row, dx));
                const Eigen::Index j = i + lattice.row_step(entries::steps(row)) + dx;
                if (value == 0) continue;
                REQUIRE(j < count);
                found(i, j) += value;
                if (i != j) found(j, i) += value;
            }
    CHECK((found - matrix).cwiseAbs().maxCoeff() < 1e-13);

    // While masses are summed it becomes the same one.
    std::vector<double> alone;
    const auto each_entry = [&](auto f) {
        for (std::size_t i = 0; i < blocks.size() * S::width; ++i)
            for (int entry = 0; entry < entries::count; ++entry) f(nodes.template at<matrix_field>(i, entry));
    };
    each_entry([&](double value) { alone.push_back(value); });
    sweeps.template set_zero<field::mass, matrix_field>();
    sweeps.scatter_and_assemble(body, detail::kernel_of_parts<S>(typename detail::p2g<field::mass>::part{}));
    std::size_t k = 0;
    each_entry([&](double value) { REQUIRE(value == alone[k++]); });
    REQUIRE(k == alone.size());

    Eigen::MatrixXd u(count, Dim), product(count, Dim);
    for (Eigen::Index i = 0; i < count; ++i)
        for (int d = 0; d < Dim; ++d) {
            u(i, d) = std::uniform_real_distribution<double>(-1, 1)(random);
            nodes.template at<field::velocity>(static_cast<std::size_t>(i), d) = u(i, d);
        }
    sweeps.template multiply_by_matrix<field::velocity>(detail::store_product<field::image>{});
    for (Eigen::Index i = 0; i < count; ++i)
        for (int d = 0; d < Dim; ++d) product(i, d) = nodes.template at<field::image>(static_cast<std::size_t>(i), d);
    const auto rows = static_cast<Eigen::Index>(blocks.size()) * S::width;
    CHECK((product - matrix * u).topRows(rows).cwiseAbs().maxCoeff() < 1e-13);
}

template <class Shape> void in_all_dimensions() {
    is_the_matrix<1, Shape, one_lane>();
    is_the_matrix<1, Shape, native_lanes>();
    is_the_matrix<2, Shape, one_lane>();
    is_the_matrix<2, Shape, native_lanes>();
#if TAMIS_VECTOR_BYTES > 0
    // Fewer lanes than there are nodes across a particle.
    is_the_matrix<2, Shape, lanes<2>>();
#endif
    is_the_matrix<3, Shape, native_lanes>();
}

}  // namespace

TEST_CASE("assembled matrix: entries and products are those of the particles' pairs of nodes") {
    in_all_dimensions<linear>();
    in_all_dimensions<quadratic_spline>();
    in_all_dimensions<cubic_spline>();
}
