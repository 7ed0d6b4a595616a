#include <tamis/tamis.hpp>

#include "catch.hpp"
#include "scratch.hpp"

#include <functional>

using namespace tamis;

namespace {

struct bar_run {
    solver<uniform_grid<1>, linear, flip> mpm{uniform_grid{{0.}, {1.}, 0.25}, linear{}, flip{}};
    decltype(mpm.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{2})) bar = mpm.make_body(
        linear_elastic{.young = 1, .density = 1}, [](const auto& at) { return at[0] > 0.2 && at[0] < 0.8; },
        per_cell{2});

    bar_run() {
        set_velocity_of(bar, [](const auto& at) { return (1. / 3) * at[0]; });
        set_strain_of(bar, [](const auto& at) { return -0.001 * at[0]; });
    }
};

}  // namespace

TEST_CASE("tables hold time, place and values of every particle and node, in full precision") {
    const scratch_folder folder("csv_values");
    bar_run run;
    csv_output tables(run.mpm, bodies(run.bar), folder.path());
    integrate(run.mpm, bodies(run.bar), {0, 0.05}, fixed_steps{5}, every(2, std::ref(tables)));
    // Nothing yet but drafts.
    for (const auto& name : folder.names()) CHECK(name.substr(name.size() - 5) == ".part");
    tables.commit();
    CHECK(folder.names() == std::vector<std::string>{"nodes_000000000.csv", "nodes_000000002.csv",
                                                     "nodes_000000004.csv", "particles_000000000.csv",
                                                     "particles_000000002.csv", "particles_000000004.csv"});

    CHECK(lines_of(folder / "particles_000000000.csv")[0] == "time,position,density,velocity,stress,strain,mass");
    CHECK(lines_of(folder / "nodes_000000000.csv")[0] == "time,position,density,velocity,stress,strain");
    const table first = table_of(folder / "particles_000000000.csv");
    REQUIRE(first.rows.size() == run.bar.size());
    for (std::size_t k = 0; k < first.rows.size(); ++k) {
        const double at = first.at(k, "position");
        CHECK(first.at(k, "time") == 0);
        CHECK(first.at(k, "velocity") == (1. / 3) * at);
        CHECK(first.at(k, "strain") == -0.001 * at);
        CHECK(first.at(k, "stress") == -0.001 * at);
        CHECK(std::abs(first.at(k, "density") - 1 / (1 - 0.001 * at)) < 1e-15);
        CHECK(first.at(k, "mass") == 0.125);
    }
    CHECK(table_of(folder / "particles_000000004.csv").at(0, "time") == 0.04);
    // The bar is the two cells in the middle.
    CHECK(table_of(folder / "nodes_000000002.csv").rows.size() == 3);
}

TEST_CASE("nodes without mass are left out") {
    const scratch_folder folder("csv_empty_nodes");
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}, linear{}, flip{}};
    auto bar = mpm.make_body(
        linear_elastic{.young = 1, .density = 1}, [](const auto& at) { return at[0] < 0.3; }, per_cell{1});
    csv_output tables(mpm, bodies(bar), folder.path());
    integrate(mpm, bodies(bar), {0, 0.01}, fixed_steps{1}, std::ref(tables));
    tables.commit();
    CHECK(table_of(folder / "nodes_000000001.csv").rows.size() == 4);
}

TEST_CASE("without commit no table is left, and no folder that was made") {
    const scratch_folder folder("csv_nothing");
    {
        bar_run run;
        csv_output tables(run.mpm, bodies(run.bar), folder / "tables");
        integrate(run.mpm, bodies(run.bar), {0, 0.05}, fixed_steps{5}, std::ref(tables));
    }
    CHECK(folder.names().empty());
}

TEST_CASE("a new run's tables take the place of an old run's, and of nothing else") {
    const scratch_folder folder("csv_again");
    for (const char* name : {"particles_000000777.csv", "nodes_12.csv", "particles_old.csv", "notes.txt"})
        std::ofstream(folder / name) << "old";
    bar_run run;
    csv_output tables(run.mpm, bodies(run.bar), folder.path());
    integrate(run.mpm, bodies(run.bar), {0, 0.05}, fixed_steps{5}, every(10, std::ref(tables)));
    CHECK(text_of(folder / "particles_000000777.csv") == "old");
    tables.commit();
    CHECK(folder.names() ==
          std::vector<std::string>{"nodes_000000000.csv", "notes.txt", "particles_000000000.csv", "particles_old.csv"});
}

TEST_CASE("a folder that cannot be written to is refused before the run") {
    const scratch_folder folder("csv_refused");
    std::ofstream(folder / "file") << "";
    bar_run run;
    REQUIRE_THROWS_AS(csv_output(run.mpm, bodies(run.bar), folder / "file"), error);
}

TEST_CASE("columns carry axes in more dimensions, and bodies are told apart") {
    const scratch_folder folder("csv_2d");
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.25}, quadratic_spline{}, flip{}};
    const linear_elastic law{.young = 1, .poisson = 0.2, .density = 1};
    auto a = mpm.make_body(
        law, [](const auto& at) { return at[0] < 0.4; }, per_cell{1});
    auto b = mpm.make_body(
        law, [](const auto& at) { return at[0] > 0.6; }, per_cell{1});
    csv_output tables(mpm, bodies(a, b), folder.path());
    integrate(mpm, bodies(a, b), {0, 0.01}, fixed_steps{1}, every(10, std::ref(tables)));
    tables.commit();
    CHECK(lines_of(folder / "particles_000000000.csv")[0] ==
          "body,time,position_x,position_y,density,velocity_x,velocity_y,stress_xx,stress_yy,stress_xy,strain_xx,"
          "strain_yy,strain_xy,mass");
    const table t = table_of(folder / "particles_000000000.csv");
    REQUIRE(t.rows.size() == a.size() + b.size());
    for (std::size_t k = 0; k < t.rows.size(); ++k) CHECK((t.at(k, "body") == 1) == (t.at(k, "position_x") > 0.6));
}
