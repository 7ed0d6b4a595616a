// Examples that are read for their source: they print the numbers they should.
#include "program.hpp"

#include "catch.hpp"

#include <cmath>

namespace {

/// All numbers of a text, in order.
std::vector<double> numbers_in(const std::string& text) {
    std::vector<double> all;
    std::istringstream in(text);
    for (std::string word; in >> word;) {
        char* end = nullptr;
        const double value = std::strtod(word.c_str(), &end);
        if (end != word.c_str() && *end == '\0') all.push_back(value);
    }
    return all;
}
void compare(const std::string& program, const std::vector<double>& expected, double relative, double absolute) {
    const scratch_folder folder("programs_" + program);
    const auto run = run_program(folder, program);
    CAPTURE(program, run.out, run.err);
    REQUIRE(run.code == 0);
    const auto found = numbers_in(run.out);
    REQUIRE(found.size() == expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
        CAPTURE(k, found[k], expected[k]);
        CHECK(std::abs(found[k] - expected[k]) <= absolute + relative * std::abs(expected[k]));
    }
}

}  // namespace

TEST_CASE("two disks meet and part") {
    compare("collision", {0.000,    0.300000, 0.700000, 2.537500, 0.000000, 0.500,    0.349932, 0.650068, 2.428795,
                          0.089175, 1.000,    0.373380, 0.626620, 0.300869, 1.855538, 1.500,    0.346920, 0.653080,
                          1.812654, 0.118881, 2.000,    0.314703, 0.685297, 1.454897, 0.287174, 2.500,    0.282656,
                          0.717344, 1.462086, 0.182089, 3.000,    0.250609, 0.749391, 1.115015, 0.455273},
            1e-5, 2e-6);
}

TEST_CASE("a user's own field, law, shape and condition") {
    compare(
        "your_own",
        {
            0.000, 0.000000e+00, 0.000000e+00, 0.199, 5.053338e-05,  1.280783e-03, 0.398, 4.201742e-04, 1.216979e-03,
            0.596, 1.023027e-04, 3.059029e-05, 0.796, 3.050238e-04,  5.553808e-04, 0.994, 1.786269e-03, 3.144410e-04,
            1.193, 1.000583e-03, 4.665859e-05, 1.392, -4.707489e-05, 2.385503e-04, 1.590, 1.425604e-03, 4.593881e-05,
            1.788, 1.320758e-03, 7.475370e-04, 1.987, -1.951564e-05, 2.734840e-04,
        },
        1e-5, 1e-12);
}
