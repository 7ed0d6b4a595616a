// Writes frames for ParaView into a folder, and beside them, in expected.txt, what they must hold, bit for bit: a line
// for each array, "<file> <array> <type> <components> <hexadecimal words>...".
#include <tamis/tamis.hpp>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace tamis;
using namespace tamis::symbols;

namespace {

struct temperature : scalar_field {
    static constexpr std::string_view name = "temperature";
    static constexpr std::string_view unit = "K";
};
constexpr field::id id;

class expected_arrays {
  public:
    expected_arrays(std::ofstream& out, std::string file) : out_(out), file_(std::move(file)) {}
    template <class Number>
    void put(const std::string& name, const std::string& type, int components, const std::vector<Number>& values) {
        out_ << file_ << ' ' << name << ' ' << type << ' ' << components << std::hex << std::setfill('0');
        for (const Number& value : values) {
            using word = std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>;
            out_ << ' ' << std::setw(2 * static_cast<int>(sizeof value)) << std::bit_cast<word>(value);
        }
        out_ << std::dec << '\n';
    }

  private:
    std::ofstream& out_;
    std::string file_;
};

template <class real, int D> void fill(std::vector<real>& to, const point<D, real>& value) {
    for (int d = 0; d < 3; ++d) to.push_back(d < D ? value[d] : real(0));
}
/// A run with particles that cross cells, and values that are no numbers; its last frame is looked at.
template <class Solver>
void scene(const std::filesystem::path& folder, std::ofstream& out, const std::string& name, const std::string& type) {
    using real = typename Solver::real;
    constexpr int D = Solver::dim;
    const uniform_grid<D, real> grid = [] {
        real low[D], high[D];
        for (int d = 0; d < D; ++d) {
            low[d] = real(-1);
            high[d] = real(1);
        }
        return uniform_grid<D, real>(low, high, real(0.125));
    }();
    Solver mpm(grid, quadratic_spline{}, flip{}, usl_minus{});
    const linear_elastic law{.young = 1e-3, .poisson = D == 1 ? 0 : 0.2, .density = 3};
    const auto ball = [](real middle) {
        return [middle](const auto& at) {
            auto off = at;
            off[0] -= middle;
            return off.norm() < real(0.3);
        };
    };
    auto left = mpm.make_body(law, ball(real(-0.4)), per_cell{2}, fields<field::id, field::deformation>{});
    auto right = mpm.make_body(law, ball(real(0.4)), per_cell{2}, fields<temperature>{});
    for (auto p : left) p[v] = point<D, real>::Constant(real(0.7));
    real k(0);
    for (auto p : right) {
        p[temperature{}] = k == 1 ? std::numeric_limits<real>::quiet_NaN() : real(300) / k;
        k += real(1);
    }
    vtk_output frames(mpm, bodies(left, right), folder / (name + ".pvd"));
    integrate(mpm, bodies(left, right), {0, 0.3}, fixed_steps{30}, every(10, frames));

    std::vector<real> points, velocities, masses, volumes, stresses, deformations, temperatures;
    std::vector<std::int64_t> ids;
    std::vector<std::int32_t> numbers;
    const real none = std::numeric_limits<real>::quiet_NaN();
    const auto add = [&](const auto& body, int number) {
        using body_type = std::remove_cvref_t<decltype(body)>;
        for (const auto p : body) {
            numbers.push_back(number);
            fill<real, D>(points, p[x]);
            fill<real, D>(velocities, p[v]);
            masses.push_back(p[m]);
            volumes.push_back(p[V]);
            const auto entry = [&](const auto& tensor, int d, int e) {
                return d < D && e < D ? tensor(d, e) : real(0);
            };
            const auto stress = p[sigma];
            for (const auto& [d, e] : {std::pair{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}})
                stresses.push_back(entry(stress, d, e));
            for (int d = 0; d < 3; ++d)
                for (int e = 0; e < 3; ++e)
                    if constexpr (body_type::has(F))
                        deformations.push_back(entry(p[F], d, e));
                    else
                        deformations.push_back(none);
            if constexpr (body_type::has(id)) {
                ids.push_back(static_cast<std::int64_t>(p[id]));
                temperatures.push_back(none);
            } else {
                ids.push_back(-1);
                temperatures.push_back(p[temperature{}]);
            }
        }
    };
    add(std::as_const(left), 0);
    add(std::as_const(right), 1);
    expected_arrays expected(out, name + "_000000003.vtp");
    expected.put("Points", type, 3, points);
    expected.put("body", "int32", 1, numbers);
    expected.put("mass", type, 1, masses);
    expected.put("velocity", type, 3, velocities);
    expected.put("volume", type, 1, volumes);
    expected.put("stress", type, 6, stresses);
    expected.put("id", "int64", 1, ids);
    expected.put("deformation", type, 9, deformations);
    expected.put("temperature", type, 1, temperatures);
}

}  // namespace

int main(int, char** argv) {
    const std::filesystem::path folder = argv[1];
    std::ofstream expected(folder / "expected.txt");
    scene<solver<uniform_grid<1, float>, quadratic_spline, flip, usl_minus>>(folder, expected, "line", "float32");
    scene<solver<uniform_grid<2, double>, quadratic_spline, flip, usl_minus>>(folder, expected, "plane", "float64");
    scene<solver<uniform_grid<3, float>, quadratic_spline, flip, usl_minus>>(folder, expected, "box", "float32");

    solver mpm{uniform_grid{{0.}, {1.}, 0.25}, linear{}, leaving_removes{}};
    auto bar = mpm.make_body_at(linear_elastic{.young = 1, .density = 1}, {point<1, double>(0.99)}, 0.1);
    for (auto p : bar) p[v][0] = 1;
    for (int k = 0; k < 3; ++k) mpm.step(bodies(bar), 0.01);
    vtk_output(mpm, bodies(bar), folder / "empty.pvd")(progress_state{3, 3, 0.03, {0, 0.03}});
    expected_arrays(expected, "empty_000000000.vtp").put("mass", "float64", 1, std::vector<double>{});
    return expected && bar.size() == 0 ? 0 : 1;
}
