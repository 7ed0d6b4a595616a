#include <tamis/mass/adaptive.hpp>
#include <tamis/mass/periodic.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;

namespace {

struct report_of_series {
    int terms = 0;
    double last = 0;
};
/// What a mass policy asks a step for, written down: s a sum over particles, n a pass over nodes, h holds.
struct written_pass {
    static constexpr bool clears_image = false, reads_last_increment = true;
    std::string asked{};
    std::vector<double> sizes{};  // of the increments to come
    report_of_series told{};

    template <class From> void spread() { asked += 's'; }
    void nodes(const auto&) { asked += 'n'; }
    template <class Sum, class Increment = field::increment> void hold_increment(bool) { asked += 'h'; }
    double increment_size() {
        const double size = sizes.front();
        sizes.erase(sizes.begin());
        return size;
    }
    void report(const report_of_series& series) { told = series; }
    long sums() const { return std::count(asked.begin(), asked.end(), 's'); }
};
using from = field::start_velocity;
using to = field::velocity;

template <class Mass> std::string filter(const Mass& mass) {
    written_pass pass;
    mass.template filter<from, to>(true, pass);
    return pass.asked;
}

}  // namespace

TEST_CASE("mass: k terms take k - 1 sums over particles, after each of which conditions hold") {
    CHECK(filter(full_mass<2>{}) == "nsnh");
    CHECK(filter(full_mass<3>{}) == "nsnhsnh");
    for (int k = 1; k < 9; ++k) {
        CAPTURE(k);
        std::string expected = "n";
        for (int l = 1; l < k; ++l) expected += "snh";
        CHECK(filter(full_mass<dynamic>{k}) == expected);
        int looked = 0;
        written_pass pass;
        full_mass<dynamic>{k}.each_term(pass, [&] { ++looked; });
        CHECK(looked == k);
        CHECK(pass.sums() == k - 1);
    }
}

TEST_CASE("mass: an adaptive series ends where a term is small beside the first, or at its most") {
    const auto run = [](double tolerance, int most, std::vector<double> sizes) {
        written_pass pass;
        pass.sizes = std::move(sizes);
        adaptive_mass(tolerance, most).filter<from, to>(true, pass);
        CHECK(pass.sums() == pass.told.terms - 1);
        return std::pair{pass.told.terms, pass.told.last};
    };
    CHECK(run(0.1, 9, {50, 20, 6, 4, 1}) == std::pair{4, 4.});
    CHECK(run(0.1, 3, {50, 20, 6, 4, 1}) == std::pair{3, 6.});
    CHECK(run(0.1, 9, {0}) == std::pair{1, 0.});
    CHECK(run(0, 4, {1, 1e-3, 1e-6, 1e-9}) == std::pair{4, 1e-9});
    CHECK(names(complaint([] { adaptive_mass(-1, 3); }), "adaptive_fmpm", "tolerance is -1"));
    CHECK(names(complaint([] { adaptive_mass(0.1, 0); }), "at most 0 terms"));
}

TEST_CASE("mass: every period-th step is FMPM's, the last of its period") {
    periodic_fmpm<3> third{3};
    std::string due;
    for (long done = 0; done < 7; ++done) {
        third.begin_step(done);
        CHECK(third.mass.due == third.particle.due);
        CHECK(third.particle.start_share() == (third.mass.due ? 1 : 0));
        due += third.mass.due ? 'x' : '.';
        CHECK(filter(third.mass) == (third.mass.due ? "nsnhsnh" : "n"));
    }
    CHECK(due == "..x..x.");
    CHECK(names(complaint([] { periodic_fmpm<3>{0}; }), "periodic_fmpm", "period is 0"));
}
