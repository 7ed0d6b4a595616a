#pragma once
#include <tamis/tamis.hpp>

#include <string>

/// Policies by the names that options give them. Each f(policy) is compiled once for every policy it may get.
namespace choose {

template <class F> auto stress_order(const std::string& name, F f) {
    if (name == "usf") return f(tamis::usf{});
    if (name == "usl-") return f(tamis::usl_minus{});
    if (name == "usl+") return f(tamis::usl_plus{});
    if (name == "usavg-") return f(tamis::usavg_minus{});
    return f(tamis::usavg_plus{});
}

/// PIC and FLIP are the ends of the blend: one type for three names.
inline tamis::blend blend_of(const std::string& name, double alpha) {
    return tamis::blend{name == "pic" ? 0 : name == "flip" ? 1 : alpha};
}
}  // namespace choose
