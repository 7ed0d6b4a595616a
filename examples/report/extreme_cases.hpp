#pragma once
#include <functional>
#include <string>
#include <vector>

/// A stiff or extreme case: what must happen, and what did.
struct extreme_outcome {
    std::string name, expected, observed;
    bool passed = false;
    /// Why it is so, for readers; of a failure, its reason.
    std::string why;
};
/// A case that can be run.
struct extreme_case {
    std::string name;
    /// Runs within a second or two, and does not depend on the machine.
    bool quick = true;
    std::function<extreme_outcome()> run;
};

/// Of two bars and the step's limit; of the standing wave; of particles at nodes and at free ends; of bodies in two
/// dimensions, and gases.
std::vector<extreme_case> extreme_bars();
std::vector<extreme_case> extreme_waves();
std::vector<extreme_case> extreme_ends();
std::vector<extreme_case> extreme_bodies();
/// All of them, in the report's order.
std::vector<extreme_case> extreme_cases();

/// "1.23e-05"
std::string short_number(double value);
