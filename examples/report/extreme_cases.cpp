#include "extreme_cases.hpp"

#include <cstdio>

std::vector<extreme_case> extreme_cases() {
    std::vector<extreme_case> all;
    for (const auto& group : {extreme_bars(), extreme_waves(), extreme_ends(), extreme_bodies()})
        all.insert(all.end(), group.begin(), group.end());
    return all;
}

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}
