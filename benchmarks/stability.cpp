// Critical Courant numbers by composition, from the exact Jacobian of a step: the table that `integrate` uses.
//     stability --header include/tamis/run/critical_table.hpp     writes it (a minute)
//     stability [--csv FILE]     prints it for 2 particles per cell; all in FILE
//     stability --dimensions     the numbers inside endless bodies, and of free squares and cubes with their edges and
//                                corners (some minutes)
#include <tamis/observe/atomic_file.hpp>
#include <tamis/shape/gimp.hpp>
#include <tamis/stability/critical.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace tamis;
using stability::critical_pair;

struct row {
    std::string_view shape, order, update;
    int k;
    std::vector<critical_pair> per_cell;  // 1, 2, ...
};

class rows {
  public:
    std::vector<row> all;

    template <class Shape, class Order> void add_shape(const Shape& shape_of, const Order& order) {
        const auto one = [&](const auto& update, int k) {
            row r{decltype(shape_of(1))::name, Order::name, update.name, k, {}};
            for (int n = 1; n <= detail::critical_per_cell; ++n)
                r.per_cell.push_back(stability::critical_numbers(n, k, shape_of(n), update, order));
            std::fprintf(stderr, "%s %s %s %d: %.3f %.3f\n", r.shape.data(), r.order.data(), r.update.data(), k,
                         r.per_cell[1].inner, r.per_cell[1].free_end);
            all.push_back(std::move(r));
        };
        one(flip{}, 0);
        for (const int k : detail::critical_xpic) one(xpic<dynamic>{k}, k);
        for (const int k : detail::critical_fmpm) one(fmpm<dynamic>{k}, k);
    }
    template <class Shape> void add(const Shape& shape_of) {
        add_shape(shape_of, usl_minus{});
        add_shape(shape_of, usavg_minus{});
        add_shape(shape_of, usf{});
    }
};

/// Rounded down.
int thousandths(double number) { return static_cast<int>(number * 1000); }

void write_header(std::ostream& out, const rows& of) {
    out << "#pragma once\n#include <tamis/run/critical_rows.hpp>\n\n"
           "// Made by `stability --header FILE` (benchmarks/stability.cpp); do not change it by hand.\n"
           "// clang-format off\n\n"
           "namespace tamis::detail {\n\n"
           "/// Critical Courant numbers in thousandths, rounded down: inside a body and at free ends, for 1, 2, 3, 4\n"
           "/// particles per cell along an axis (docs/stability.md).\n"
           "inline constexpr critical_row critical_table[] = {\n";
    std::string_view before;
    for (const row& r : of.all) {
        const std::string heading = std::string(r.shape) + ", " + std::string(r.order);
        if (r.update == "flip") out << "    // " << heading << "\n";
        out << "    {{";
        for (std::size_t n = 0; n < r.per_cell.size(); ++n) out << (n ? ", " : "") << thousandths(r.per_cell[n].inner);
        out << "}, {";
        for (std::size_t n = 0; n < r.per_cell.size(); ++n)
            out << (n ? ", " : "") << thousandths(r.per_cell[n].free_end);
        out << "}},  // " << r.update;
        if (r.k > 0) out << "(" << r.k << ")";
        out << "\n";
    }
    out << "};\n\n}  // namespace tamis::detail\n";
}

void write_csv(std::ostream& out, const rows& of) {
    out << "shape,stress,update,k,per_cell,inner,worst_offset,free,worst_free_offset\n";
    for (const row& r : of.all)
        for (std::size_t n = 0; n < r.per_cell.size(); ++n)
            out << r.shape << ',' << r.order << ',' << r.update << ',' << r.k << ',' << n + 1 << ','
                << r.per_cell[n].inner << ',' << r.per_cell[n].worst_offset << ',' << r.per_cell[n].free_end << ','
                << r.per_cell[n].worst_free_offset << '\n';
}

/// The smallest number over waves along all axes and between, some offsets along all axes, and Poisson's ratios.
template <int Dim, class... Policies> void dimension(const char* name, int reach, const Policies&... policies) {
    constexpr int waves = Dim == 3 ? 2 : 4, all = detail::power(waves + 1, Dim);
    for (const int per_cell : {1, 2}) {
        double worst = stability::most_courant;
        std::array<double, static_cast<std::size_t>(Dim)> worst_wave{};
        for (const double poisson : Dim == 1 ? std::vector{0.} : std::vector{0., 0.3, 0.499})
            for (const double offset : {0., 0.25, 0.5}) {
                const stability::lattice_step<Dim> step(stability::lattice<Dim>{per_cell, offset / per_cell, poisson},
                                                        reach, policies...);
                for (int n = 1; n < all; ++n) {
                    std::array<double, static_cast<std::size_t>(Dim)> theta{};
                    for (std::size_t d = 0, left = static_cast<std::size_t>(n); d < Dim; ++d, left /= waves + 1)
                        theta[d] = std::numbers::pi * static_cast<double>(left % (waves + 1)) / waves;
                    // Axes are alike.
                    if (!std::is_sorted(theta.rbegin(), theta.rend())) continue;
                    const auto wave = step.of_wave(theta);
                    const double critical = stability::first_unstable(
                        worst, 0.1, [&](double c) { return stability::spectral_radius_of(wave, c) <= 1 + 1e-4; });
                    if (critical < worst) worst = critical, worst_wave = theta;
                }
            }
        std::printf("%dD %s, %d per cell and axis: %.3f, wave", Dim, name, per_cell, worst);
        for (const double theta : worst_wave) std::printf(" %.2f", theta / std::numbers::pi);
        std::puts(" pi");
    }
}
template <int Dim> void dimension() {
    dimension<Dim>("linear, FLIP, USL-", Dim == 3 ? 2 : 4, linear{}, flip{}, usl_minus{});
    dimension<Dim>("quadratic, FLIP, USL-", Dim == 3 ? 3 : 5, quadratic_spline{}, flip{}, usl_minus{});
    if constexpr (Dim < 3) {
        dimension<Dim>("linear, FMPM(4), USL-", 7, linear{}, fmpm<dynamic>{4}, usl_minus{});
        dimension<Dim>("quadratic, FMPM(4), USL-", 11, quadratic_spline{}, fmpm<dynamic>{4}, usl_minus{});
    }
}

/// The smallest number of a free block, 2 particles per cell and axis, over places of its corner in a cell.
template <int Dim, class... Policies>
double of_free_block(int cells, double poisson, const std::vector<double>& offsets, const Policies&... policies) {
    constexpr int per_cell = 2;
    const int side = cells * per_cell, count = detail::power(side, Dim), kinds = static_cast<int>(offsets.size()),
              all = detail::power(kinds, Dim);
    double critical = stability::most_courant;
    for (int n = 0; n < all; ++n) {
        std::array<int, static_cast<std::size_t>(Dim)> kind{};
        for (std::size_t d = 0, left = static_cast<std::size_t>(n); d < Dim; ++d, left /= offsets.size())
            kind[d] = static_cast<int>(left % offsets.size());
        // Axes are alike.
        if (!std::is_sorted(kind.begin(), kind.end())) continue;
        std::vector<point<Dim, double>> places;
        for (int p = 0; p < count; ++p) {
            point<Dim, double> at;
            for (int d = 0, left = p; d < Dim; ++d, left /= side)
                at[d] = 4 + offsets[static_cast<std::size_t>(kind[static_cast<std::size_t>(d)])] +
                        (left % side + 0.5) / per_cell;
            places.push_back(at);
        }
        using matrix = stability::step_matrix<Eigen::MatrixXd>;
        std::array<Eigen::MatrixXd, matrix::samples> at;
        for (int s = 0; s < matrix::samples; ++s)
            at[static_cast<std::size_t>(s)] = stability::responses<Dim>(places, 1. / per_cell, cells + 8, poisson, 0,
                                                                        count, matrix::sample(s), policies...);
        const matrix step(at);
        critical = stability::first_unstable(critical, critical / 8, [&](double c) {
            return stability::spectral_radius_of(step, c) <= 1 + stability::growth;
        });
    }
    return critical;
}
/// Edges and corners of free bodies beside the ends of a bar; by the speed of P waves.
template <class... Policies> void free_blocks(const char* name, const Policies&... policies) {
    const std::vector<double> offsets{0.05, 0.2, 0.45, 0.55, 0.7, 0.8};
    const double bar = of_free_block<1>(4, 0, offsets, policies...);
    std::printf("%s: free bar of 4 cells %.3f\n", name, bar);
    for (const double poisson : {0., 0.3, 0.499}) {
        std::printf("    Poisson's ratio %.3f: square of 1 cell %.3f, of 2 cells %.3f, cube of 1 cell %.3f\n", poisson,
                    of_free_block<2>(1, poisson, offsets, policies...),
                    of_free_block<2>(2, poisson, offsets, policies...),
                    of_free_block<3>(1, poisson, {0.05, 0.2, 0.7}, policies...));
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
    std::string header, csv;
    bool dimensions = false;
    for (int k = 1; k < argc; ++k) {
        const std::string_view given = argv[k];
        if (given == "--csv" && k + 1 < argc)
            csv = argv[++k];
        else if (given == "--header" && k + 1 < argc)
            header = argv[++k];
        else if (given == "--dimensions")
            dimensions = true;
        else {
            std::fputs("usage: stability [--header FILE] [--csv FILE] | --dimensions\n", stderr);
            return 2;
        }
    }
    try {
        if (dimensions) {
            dimension<1>();
            dimension<2>();
            dimension<3>();
            free_blocks("quadratic, FLIP, USL-", quadratic_spline{}, flip{}, usl_minus{});
            free_blocks("quadratic, FMPM(4), USL-", quadratic_spline{}, fmpm<dynamic>{4}, usl_minus{});
            free_blocks("uGIMP, FLIP, USL-", ugimp{2}, flip{}, usl_minus{});
            free_blocks("linear, FLIP, USF", linear{}, flip{}, usf{});
            return 0;
        }
        std::optional<atomic_file> header_file, csv_file;
        if (!header.empty()) header_file.emplace(header);
        if (!csv.empty()) csv_file.emplace(csv);
        rows all;
        all.add([](int) { return linear{}; });
        all.add([](int) { return quadratic_spline{}; });
        all.add([](int) { return cubic_spline{}; });
        all.add([](int n) { return ugimp{n}; });
        std::puts("| shape | stress | update | k | inside | worst offset | free ends | worst offset |");
        std::puts("|---|---|---|---|---|---|---|---|");
        for (const row& r : all.all)
            std::printf("| %-9s | %-7s | %-5s | %2d | %6.3f | %5.3f | %6.3f | %5.3f |\n", r.shape.data(),
                        r.order.data(), r.update.data(), r.k, r.per_cell[1].inner, r.per_cell[1].worst_offset,
                        r.per_cell[1].free_end, r.per_cell[1].worst_free_offset);
        if (header_file) {
            write_header(header_file->out(), all);
            header_file->commit();
        }
        if (csv_file) {
            write_csv(csv_file->out(), all);
            csv_file->commit();
        }
    } catch (const std::exception& e) {
        std::fprintf(stderr, "stability: %s\n", e.what());
        return 1;
    }
    return 0;
}
