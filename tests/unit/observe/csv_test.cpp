#include <tamis/tamis.hpp>

#include "catch.hpp"
#include "scratch.hpp"

#include <algorithm>
#include <functional>
#include <iostream>

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

TEST_CASE("every component of a tensor is in the column of its name") {
    const scratch_folder folder("csv_tensors");
    const auto check = [&](auto grid, const auto& names, const std::string& where) {
        constexpr int D = decltype(grid)::dim;
        solver mpm{grid, linear{}, flip{}};
        auto body = mpm.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{1});
        // For Poisson's ratio 0 and Young's modulus 1 it is the strain too.
        matrix<D, double> stress;
        for (int d = 0; d < D; ++d)
            for (int e = 0; e < D; ++e) stress(d, e) = 1e-3 * (1 + 10 * std::min(d, e) + std::max(d, e));
        for (auto p : body) p[symbols::sigma] = stress;
        for (auto p : body) p[symbols::v] = point<D, double>(stress.col(D - 1));
        csv_output tables(mpm, bodies(body), folder / where);
        tables(progress_state{0, 1, 0, {0, 1}});
        tables.commit();
        for (const std::string table_name : {"particles", "nodes"}) {
            const table t = table_of(folder / where / (table_name + "_000000000.csv"));
            REQUIRE(t.rows.size() > 0);
            for (std::size_t k = 0; k < t.rows.size(); ++k)
                for (int d = 0; d < D; ++d) {
                    const std::string row(1, names[static_cast<std::size_t>(d)]);
                    CHECK(std::abs(t.at(k, "velocity_" + row) - stress(d, D - 1)) < 1e-15);
                    for (int e = d; e < D; ++e) {
                        const std::string place = row + names[static_cast<std::size_t>(e)];
                        CHECK(std::abs(t.at(k, "stress_" + place) - stress(d, e)) < 1e-15);
                        CHECK(std::abs(t.at(k, "strain_" + place) - stress(d, e)) < 1e-15);
                    }
                }
        }
    };
    check(uniform_grid{{0., 0.}, {1., 1.}, 0.5}, "xy", "2d");
    check(uniform_grid{{0., 0., 0.}, {1., 1., 1.}, 0.5}, "xyz", "3d");
}

namespace {

struct temperature : scalar_field {
    static constexpr std::string_view name = "temperature";
};

}  // namespace

TEST_CASE("further fields that all bodies store come last, by their names") {
    const scratch_folder folder("csv_further");
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.25}, linear{}, flip{}};
    const linear_elastic law{.young = 1, .poisson = 0.2, .density = 1};
    auto low = mpm.make_body(
        law, [](const auto& at) { return at[0] < 0.4; }, per_cell{1},
        fields<field::id, temperature, field::deformation>{});
    auto high = mpm.make_body(
        law, [](const auto& at) { return at[0] > 0.6; }, per_cell{1}, fields<field::deformation, field::id>{});
    for (auto p : low) p[field::deformation{}](0, 1) = 0.5;
    csv_output tables(mpm, bodies(low, high), folder.path());
    tables(progress_state{0, 1, 0, {0, 1}});
    csv_output alone(mpm, bodies(low), folder / "alone");
    alone(progress_state{0, 1, 0, {0, 1}});
    tables.commit();
    alone.commit();
    const auto ending = [](const std::filesystem::path& path) {
        const std::string line = lines_of(path)[0];
        return line.substr(line.find("mass"));
    };
    CHECK(ending(folder / "particles_000000000.csv") ==
          "mass,id,deformation_xx,deformation_xy,deformation_yx,deformation_yy");
    CHECK(ending(folder / "alone/particles_000000000.csv") ==
          "mass,id,temperature,deformation_xx,deformation_xy,deformation_yx,deformation_yy");
    const table t = table_of(folder / "particles_000000000.csv");
    REQUIRE(t.rows.size() == low.size() + high.size());
    std::vector<int> met(low.size());
    for (std::size_t k = 0; k < t.rows.size(); ++k) {
        CHECK(t.at(k, "deformation_xy") == (t.at(k, "body") == 0 ? 0.5 : 0));
        CHECK(t.at(k, "deformation_yx") == 0);
        if (t.at(k, "body") == 0) ++met.at(static_cast<std::size_t>(t.at(k, "id")));
    }
    CHECK(met == std::vector<int>(low.size(), 1));
}

TEST_CASE("tables given by value are in place after the run; those given by reference wait for their commit") {
    const scratch_folder folder("csv_by_value");
    bar_run run;
    csv_output tables(run.mpm, bodies(run.bar), folder / "kept");
    const std::string own = (folder / "own").string(), at_once = (folder / "at_once").string();
    int calls = 0;
    const auto run_to = [&](double begin, auto pace) {
        integrate(
            run.mpm, bodies(run.bar), {begin, begin + 0.05}, pace, [&](double) { ++calls; },
            every(5, csv_output{run.mpm, bodies(run.bar), own.c_str()}), every(5, std::ref(tables)),
            csv_output{run.mpm, bodies(run.bar), at_once}, every(5, watch(run.mpm, bodies(run.bar), std::cerr)),
            every(5, vtk_output{run.mpm, bodies(run.bar), folder / "frames.pvd"}));
    };
    run_to(0, fixed_steps{5});
    CHECK(calls == 6);
    CHECK(folder.names() == std::vector<std::string>{"at_once", "frames.pvd", "frames_000000000.vtp",
                                                     "frames_000000001.vtp", "kept", "own"});
    const auto count = [&](const char* name) {
        int n = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder / name))
            n += entry.path().extension() == ".csv" ? 1 : 0;
        return n;
    };
    CHECK(count("own") == 4);
    CHECK(count("at_once") == 12);
    CHECK(count("kept") == 0);
    CHECK(table_of(folder / "own/particles_000000005.csv").rows.size() == run.bar.size());
    // Another run takes their place, here of one step.
    run_to(0.05, courant{0.4});
    CHECK(count("own") == 2);
    CHECK(count("at_once") == 4);
    // What was kept has both: their steps count on.
    tables.commit();
    CHECK(count("kept") == 6);
    CHECK(table_of(folder / "kept/particles_000000000.csv").at(0, "time") == 0);
    CHECK(table_of(folder / "kept/particles_000000005.csv").at(0, "time") == 0.05);
    CHECK(table_of(folder / "kept/particles_000000006.csv").at(0, "time") == 0.05);

    // A copy writes to the same tables.
    integrate(run.mpm, bodies(run.bar), {0.1, 0.15}, fixed_steps{5}, every(1, tables));
    CHECK(count("kept") == 6 + 12);
    CHECK(table_of(folder / "kept/particles_000000012.csv").at(0, "time") == 0.15);
}

TEST_CASE("tables of a run that fails do not appear, given by value or not") {
    const scratch_folder folder("csv_failed");
    bar_run run;
    const auto stop = [](double t) {
        if (t > 0.02) throw error("enough");
    };
    CHECK_THROWS_AS(integrate(run.mpm, bodies(run.bar), {0, 0.05}, fixed_steps{5}, stop,
                              every(1, csv_output{run.mpm, bodies(run.bar), folder / "own"})),
                    error);
    CHECK(folder.names().empty());
}

TEST_CASE("a dump given by value, which cannot be copied, is in place after the run") {
    const scratch_folder folder("csv_dump");
    bar_run run;
    integrate(run.mpm, bodies(run.bar), {0, 0.05}, fixed_steps{5},
              every(5, dump_output{run.mpm, bodies(run.bar), folder / "bar.txt"}));
    CHECK(folder.names() == std::vector<std::string>{"bar.txt"});
    CHECK(lines_of(folder / "bar.txt").back() == "end of the run");
}

TEST_CASE("tables that cannot all take their places take none") {
    const scratch_folder folder("csv_together");
    std::ofstream(folder / "nodes_000000000.csv") << "old";
    bar_run run;
    csv_output tables(run.mpm, bodies(run.bar), folder.path());
    integrate(run.mpm, bodies(run.bar), {0, 0.05}, fixed_steps{5}, std::ref(tables));
    std::filesystem::create_directories(folder / "particles_000000003.csv/in_the_way");
    REQUIRE_THROWS_AS(tables.commit(), error);
    CHECK(text_of(folder / "nodes_000000000.csv") == "old");
    for (const auto& name : folder.names())
        CHECK((name == "nodes_000000000.csv" || name == "particles_000000003.csv" ||
               name.substr(name.size() - 5) == ".part"));
    // Once there is room they can still be committed.
    std::filesystem::remove_all(folder / "particles_000000003.csv");
    tables.commit();
    CHECK(folder.names().size() == 12);
    CHECK(table_of(folder / "particles_000000003.csv").rows.size() == run.bar.size());
    CHECK(text_of(folder / "nodes_000000000.csv") != "old");
}

TEST_CASE("drafts that a killed run left go with the next") {
    const scratch_folder folder("csv_killed");
    for (const char* name : {"particles_000000777.csv.part", "nodes_000000777.csv.part", "nodes_000000001.csv.before",
                             "particles_mine.csv.part", "notes.part"})
        std::ofstream(folder / name) << "killed";
    bar_run run;
    csv_output tables(run.mpm, bodies(run.bar), folder.path());
    CHECK(folder.names() == std::vector<std::string>{"notes.part", "particles_mine.csv.part"});
}
