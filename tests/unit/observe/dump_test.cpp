#include <tamis/tamis.hpp>

#include "catch.hpp"
#include "scratch.hpp"

#include <limits>

using namespace tamis;
using namespace tamis::symbols;

namespace {

struct temperature : scalar_field {
    static constexpr std::string_view name = "temperature";
};

auto make_bar(const auto& mpm) {
    auto bar = mpm.make_body(
        linear_elastic{.young = 1, .density = 1}, [](const auto& at) { return at[0] < 0.5; }, per_cell{1},
        fields<temperature>{});
    for (auto p : bar) {
        p[v][0] = 4 * p[x][0];
        p[temperature{}] = 300;
    }
    return bar;
}
long count_of(const std::string& text, const std::string& part) {
    long n = 0;
    for (std::size_t k = text.find(part); k != std::string::npos; k = text.find(part, k + 1)) ++n;
    return n;
}

}  // namespace

TEST_CASE("a dump lists every node with the particles in its reach, and every field") {
    const scratch_folder folder("dump_all");
    solver mpm{uniform_grid{{0.}, {1.}, 0.25}, linear{}, flip{}};
    auto bar = make_bar(mpm);
    dump_output all(mpm, bodies(bar), folder / "bar.txt");
    all(progress_state{0, 1, 0, {0, 1}});
    CHECK_FALSE(std::filesystem::exists(folder / "bar.txt"));
    all.commit();
    CHECK(
        lines_of(folder / "bar.txt") ==
        std::vector<std::string>{
            "step 0 time 0",
            "  node 0 position 0 mass 0.125 momentum 0.0625 velocity 0.5 internal_force 0 density 1 stress 0 strain 0",
            "    weight 0.5 slope -4 body 0 particle 0 position 0.125 mass 0.25 velocity 0.5 volume 0.25 stress 0 "
            "temperature 300 "
            "density 1 strain 0",
            "  node 1 position 0.25 mass 0.25 momentum 0.25 velocity 1 internal_force 0 density 1 stress 0 strain 0",
            "    weight 0.5 slope 4 body 0 particle 0 position 0.125 mass 0.25 velocity 0.5 volume 0.25 stress 0 "
            "temperature 300 "
            "density 1 strain 0",
            "    weight 0.5 slope -4 body 0 particle 1 position 0.375 mass 0.25 velocity 1.5 volume 0.25 stress 0 "
            "temperature 300 "
            "density 1 strain 0",
            "  node 2 position 0.5 mass 0.125 momentum 0.1875 velocity 1.5 internal_force 0 density 1 stress 0 strain "
            "0",
            "    weight 0.5 slope 4 body 0 particle 1 position 0.375 mass 0.25 velocity 1.5 volume 0.25 stress 0 "
            "temperature 300 "
            "density 1 strain 0",
            "  in no node's reach: 0", "  not a number: 0, cell crossings since the last record: 0", "end of the run"});
}

TEST_CASE("a dump counts crossings, sets lost particles apart, and keeps a failed run's records") {
    const scratch_folder folder("dump_failure");
    solver mpm{uniform_grid{{0.}, {1.}, 0.25}, linear{}, flip{}};
    auto bar = make_bar(mpm);
    dump_output all(mpm, bodies(bar), folder / "bar.txt");
    for (int k = 0; k < 10; ++k) mpm.step(bodies(bar), 0.01);
    all(progress_state{10, 20, 0.1, {0, 1}});
    // A place that is not a number is in no node's reach.
    for (auto p : bar)
        if (p[x][0] > 0.45) bar.store().lane_of(p.slot(), p.lane_index())[0] = std::numeric_limits<double>::quiet_NaN();
    all(progress_state{11, 20, 0.11, {0, 1}});
    all.commit("the run failed");
    const std::string text = text_of(folder / "bar.txt");
    CHECK(count_of(text, "\nstep 11 time 0.11") == 1);
    CHECK(count_of(text, "cell crossings since the last record: 1\n") == 1);
    CHECK(count_of(text, "cell crossings since the last record: 0\n") == 1);
    CHECK(count_of(text, "in no node's reach: 1\n    body 0 particle 1 position nan") == 1);
    CHECK(count_of(text, "not a number: 1, ") == 1);
    CHECK(count_of(text, "its position is not a finite number") == 1);
    CHECK(lines_of(folder / "bar.txt").back() == "the run failed");
}

TEST_CASE("a dump shows tensors row by row") {
    const scratch_folder folder("dump_tensor");
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.5}, linear{}, flip{}};
    auto block = mpm.make_body_at(linear_elastic{.young = 1, .density = 1}, {point<2, double>(0.2, 0.2)}, 0.1,
                                  fields<field::deformation>{});
    for (auto p : block) p[F] << 1, 2, 3, 4;
    dump_output all(mpm, bodies(block), folder / "block.txt");
    all(progress_state{0, 1, 0, {0, 1}});
    all.commit();
    CHECK(count_of(text_of(folder / "block.txt"), " deformation 1 2 3 4 ") == 4);
}
