// The scenes as programs: every option, what is refused, and what is written.
#include "bar.hpp"
#include "program.hpp"
#include "scenes/standing_wave.hpp"

#include "catch.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace {

nlohmann::json summary(const scratch_folder& folder, const std::string& scene, const std::string& arguments) {
    CAPTURE(scene, arguments);
    const auto file = folder / "summary.json";
    const auto run = run_program(folder, scene, arguments + " --summary " + file.string());
    CAPTURE(run.out, run.err);
    REQUIRE(run.code == 0);
    REQUIRE(run.err.empty());
    return nlohmann::json::parse(text_of(file));
}
long lines_in(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

const std::vector<std::string> scenes{"standing_wave", "reflection", "shock"};

}  // namespace

TEST_CASE("the summary has all its keys") {
    const scratch_folder folder("options_keys");
    for (const auto& scene : scenes) {
        const auto all = summary(folder, scene, "--cells 40 --time 0.3 --update fmpm --order 3 --particles held");
        for (const char* key : {"scene",
                                "cells",
                                "per_cell",
                                "shape",
                                "update",
                                "order",
                                "stress",
                                "boundary",
                                "particles",
                                "steps",
                                "dt",
                                "time",
                                "wall_seconds",
                                "ns_per_particle_step",
                                "bytes_per_particle",
                                "bytes_per_node",
                                "velocity_l2",
                                "velocity_max",
                                "strain_l2",
                                "strain_max",
                                "energy_initial",
                                "energy_final",
                                "boundary_work",
                                "mass",
                                "momentum"}) {
            CAPTURE(scene, key);
            REQUIRE(all.contains(key));
            CHECK_FALSE(all[key].is_null());
        }
        CHECK(all["scene"] == scene);
        CHECK(all["order"] == 3);
        CHECK(all["particles"] == "held");
        CHECK(all["boundary"] == "incremental");
        CHECK(all.contains("front_speed_over_c") == (scene == "shock"));
        CHECK(all.contains("overshoot") == (scene == "shock"));
        CHECK(std::abs(all["mass"].get<double>() - 1) < 1e-12);
        CHECK(all["wall_seconds"].get<double>() > 0);
    }
}

TEST_CASE("defaults are those of ADMPM's scenes") {
    const scratch_folder folder("options_defaults");
    const auto wave = summary(folder, "standing_wave", ""), echo = summary(folder, "reflection", ""),
               front = summary(folder, "shock", "");
    CHECK(wave["cells"] == 50);
    CHECK(wave["steps"] == 1000);
    CHECK(wave["amplitude"] == 0.01);
    CHECK(echo["cells"] == 100);
    CHECK(echo["steps"] == 2000);
    CHECK(front["cells"] == 400);
    CHECK(front["steps"] == 800);
    CHECK(front["amplitude"] == 0.001);
    for (const auto& all : {wave, echo, front}) {
        CHECK(all["per_cell"] == 2);
        CHECK(all["shape"] == "linear");
        CHECK(all["update"] == "flip");
        CHECK(all["order"].is_null());
        CHECK(all["stress"] == "usl-");
        CHECK(all["particles"] == "moving");
        CHECK(all["precision"] == "double");
    }
}

TEST_CASE("every option is taken") {
    const scratch_folder folder("options_each");
    const auto with = [&](const std::string& arguments) {
        return summary(folder, "standing_wave", "--time 0.2 " + arguments);
    };
    CHECK(with("--cells 30")["cells"] == 30);
    CHECK(with("--per-cell 3")["particle_count"] == 150);
    for (const std::string shape : {"linear", "quadratic", "cubic"}) {
        bar_options o(standing_wave());
        o.shape = shape;
        if (is_built(o)) CHECK(with("--shape " + shape)["shape"] == shape);
    }
    for (const std::string update : {"pic", "flip", "blend", "xpic", "fmpm"})
        CHECK(with("--update " + update)["update"] == update);
    CHECK(with("--update xpic --order 5")["order"] == 5);
    CHECK(with("--update blend --alpha 0.9")["alpha"] == 0.9);
    for (const std::string stress : {"usf", "usl-", "usl+", "usavg-", "usavg+", "euler"})
        CHECK(with("--stress " + stress)["stress"] == stress);
    for (const std::string particles : {"moving", "held"})
        CHECK(with("--particles " + particles)["particles"] == particles);
    CHECK(with("--boundary incremental")["boundary"] == "incremental");
    CHECK(with("--update fmpm --boundary collected")["boundary"] == "collected");
    for (const std::string precision : {"float", "double"})
        CHECK(with("--particles held --precision " + precision)["precision"] == precision);
    CHECK(with("--amplitude 0.002")["amplitude"] == 0.002);
    CHECK(with("--threads 1")["threads"] == 1);
}

TEST_CASE("steps and Courant numbers give the time step") {
    const scratch_folder folder("options_steps");
    const auto fixed = summary(folder, "standing_wave", "--steps 700 --time 0.3");
    CHECK(fixed["steps"] == 700);
    CHECK(fixed["dt"].get<double>() == 0.3 / 700);
    CHECK(fixed["time"] == 0.3);
    // 0.3/(0.07/50) = 214.3, rounded to 215 steps.
    const auto paced = summary(folder, "standing_wave", "--courant 0.07 --time 0.3");
    CHECK(paced["steps"] == 215);
    CHECK(paced["courant"].get<double>() <= 0.07);
}

TEST_CASE("float and double agree to float's precision") {
    const scratch_folder folder("options_float");
    const auto a = summary(folder, "standing_wave", "--particles held --time 0.5 --precision double");
    const auto b = summary(folder, "standing_wave", "--particles held --time 0.5 --precision float");
    CHECK(std::abs(a["strain_l2"].get<double>() - b["strain_l2"].get<double>()) < 1e-4);
    CHECK(b["bytes_per_particle"].get<int>() * 2 == a["bytes_per_particle"].get<int>());
    CHECK(b["bytes_per_node"].get<int>() * 2 == a["bytes_per_node"].get<int>());
}

#if defined(_OPENMP)
TEST_CASE("threads change no bit of the result") {
    const scratch_folder folder("options_threads");
    auto one = summary(folder, "reflection", "--cells 4000 --time 0.02 --update fmpm --shape quadratic");
    auto two = summary(folder, "reflection", "--cells 4000 --time 0.02 --update fmpm --shape quadratic --threads 2");
    CHECK(two["threads"] == 2);
    for (const char* key : {"threads", "wall_seconds", "ns_per_particle_step"}) {
        one.erase(key);
        two.erase(key);
    }
    CHECK(one == two);
}
#endif

TEST_CASE("bad options get one line and exit code 2, and leave nothing") {
    const scratch_folder folder("options_bad");
    std::ofstream(folder / "file") << "";
    const std::string below = (folder / "file/below").string(), kept = (folder / "kept").string();
    for (const auto& scene : scenes)
        for (const std::string& arguments : std::vector<std::string>{"--cells 0",
                                                                     "--cells -3",
                                                                     "--cells 2.5",
                                                                     "--cells abc",
                                                                     "--cells 99999999",
                                                                     "--cells 1e99",
                                                                     "--cells",
                                                                     "--per-cell 0",
                                                                     "--shape cubicc",
                                                                     "--shape",
                                                                     "--update apic",
                                                                     "--update fmpm --order 0",
                                                                     "--update xpic --order -1",
                                                                     "--alpha 1.5",
                                                                     "--stress usl",
                                                                     "--boundary lumped",
                                                                     "--update fmpm --boundary nitsche",
                                                                     "--particles fixed",
                                                                     "--steps 0",
                                                                     "--steps -5",
                                                                     "--steps 1.5",
                                                                     "--courant 0",
                                                                     "--courant -0.1",
                                                                     "--courant 1.5",
                                                                     "--courant nan",
                                                                     "--time 0",
                                                                     "--time -1",
                                                                     "--time inf",
                                                                     "--time x",
                                                                     "--amplitude 0",
                                                                     "--amplitude -0.01",
                                                                     "--amplitude nan",
                                                                     "--every 0",
                                                                     "--every -2",
                                                                     "--threads -1",
                                                                     "--threads 0",
                                                                     "--cells 010",
                                                                     "--cells 0x10",
                                                                     "--alpha nan",
                                                                     "--amplitude 1e-300",
                                                                     "--amplitude 1e-30 --precision float",
                                                                     "--precision half",
                                                                     "--steps 100 --courant 0.1",
                                                                     "--courant 1e-12",
                                                                     "--unknown",
                                                                     "--cells 20 stray",
                                                                     "--cells 20 --cells 30 --nothing",
                                                                     "--csv " + below,
                                                                     "--summary " + below,
                                                                     "--dump " + below,
                                                                     "--csv " + (folder / "file").string(),
                                                                     "--summary " + folder.path().string(),
                                                                     "--dump " + folder.path().string(),
                                                                     "--summary /dev/null",
                                                                     "--dump /dev/null",
                                                                     "--csv ''",
                                                                     "--summary ''",
                                                                     "--csv " + kept + " --dump " + kept,
                                                                     "--summary ./x --dump x",
                                                                     "--csv " + kept + " --dump " + below,
                                                                     "--summary " + kept + " --csv " + below}) {
            const auto run = run_program(folder, scene, arguments);
            CAPTURE(scene, arguments, run.err, run.out);
            CHECK(run.code == 2);
            CHECK(run.out.empty());
            CHECK(lines_in(run.err) == 1);
            CHECK(run.err.rfind(scene + ": ", 0) == 0);
            CHECK(folder.names() == std::vector<std::string>{"file"});
        }
}

TEST_CASE("a run that fails gets one line and exit code 1, and leaves nothing but its dump") {
    const scratch_folder folder("options_failure");
    const std::string outputs =
        " --csv " + (folder / "tables").string() + " --summary " + (folder / "all.json").string();
    const auto run = run_program(folder, "standing_wave", "--steps 10" + outputs);
    CAPTURE(run.err);
    CHECK(run.code == 1);
    CHECK(lines_in(run.err) == 1);
    CHECK(run.err.find("Courant number") != std::string::npos);
    CHECK(folder.names().empty());

    // Explicit Euler at a large step: the energy grows until the particles are faster than the step allows.
    const auto late = run_program(
        folder, "standing_wave",
        "--stress euler --courant 0.9 --time 100 --every 1000 --dump " + (folder / "bar.txt").string() + outputs);
    CAPTURE(late.err);
    CHECK(late.code == 1);
    CHECK(lines_in(late.err) == 1);
    CHECK(folder.names() == std::vector<std::string>{"bar.txt"});
    CHECK(lines_of(folder / "bar.txt").back().rfind("the run failed: ", 0) == 0);
}

TEST_CASE("help lists every option and runs nothing") {
    const scratch_folder folder("options_help");
    const auto run = run_program(folder, "shock", "--help");
    CHECK(run.code == 0);
    CHECK(run.err.empty());
    for (const char* option : {"--cells", "--per-cell", "--shape", "--update", "--order", "--alpha", "--stress",
                               "--boundary", "--particles", "--steps", "--courant", "--time", "--amplitude", "--csv",
                               "--dump", "--every", "--summary", "--threads", "--precision"}) {
        CAPTURE(option);
        CHECK(run.out.find(option) != std::string::npos);
    }
    CHECK(run.out.find("moving") != std::string::npos);
}

TEST_CASE("tables are written every so many steps, complete") {
    const scratch_folder folder("options_csv");
    const auto all = summary(folder, "reflection",
                             "--cells 20 --steps 100 --every 25 --time 1 --csv " + (folder / "tables").string());
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "tables"))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    std::vector<std::string> expected{"energy.csv"};
    for (const char* what : {"nodes", "particles"})
        for (const char* step : {"000", "025", "050", "075", "100"})
            expected.push_back(std::string(what) + "_000000" + step + ".csv");
    CHECK(names == expected);

    const table particles = table_of(folder / "tables/particles_000000050.csv"),
                nodes = table_of(folder / "tables/nodes_000000050.csv");
    CHECK(particles.names ==
          std::vector<std::string>{"time", "position", "density", "velocity", "stress", "strain", "mass"});
    CHECK(nodes.names == std::vector<std::string>{"time", "position", "density", "velocity", "stress", "strain"});
    CHECK(particles.rows.size() == 40);
    CHECK(nodes.rows.size() == 21);
    for (const auto& row : particles.rows) {
        REQUIRE(row.size() == 7);
        CHECK(row[0] == 0.5);
    }
    // The last record and the summary tell the same energy, to the last digit.
    const table energy = table_of(folder / "tables/energy.csv");
    CHECK(energy.rows.size() == 5);
    CHECK(energy.at(4, "total") == all["energy_final"].get<double>());
    CHECK(energy.at(4, "boundary_work") == all["boundary_work"].get<double>());
}

TEST_CASE("a dump has every recorded step") {
    const scratch_folder folder("options_dump");
    const auto run = run_program(folder, "standing_wave",
                                 "--cells 10 --steps 100 --every 50 --dump " + (folder / "bar.txt").string());
    REQUIRE(run.code == 0);
    long steps = 0, nodes = 0, particles = 0;
    for (const auto& line : lines_of(folder / "bar.txt")) {
        steps += line.rfind("step ", 0) == 0;
        nodes += line.rfind("  node ", 0) == 0;
        particles += line.rfind("    weight ", 0) == 0;
    }
    CHECK(steps == 3);
    CHECK(nodes == 3 * 11);
    CHECK(particles == 3 * 20 * 2);
}

TEST_CASE("what cannot be measured is said, and no number is made up") {
    const scratch_folder folder("options_short");
    const auto run =
        run_program(folder, "shock", "--cells 5 --per-cell 2 --time 0.01 --summary " + (folder / "all.json").string());
    CAPTURE(run.out, run.err);
    CHECK(run.code == 1);
    CHECK(run.out.find("nan") == std::string::npos);
    CHECK(lines_in(run.err) == 1);
    CHECK(run.err.find("the speed of the fronts cannot be measured") != std::string::npos);
    CHECK(folder.names().empty());
}
