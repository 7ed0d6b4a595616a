#include "measurement.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace {

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

}  // namespace

std::string configuration::family() const {
    std::ostringstream all;
    all << scene << ' ' << shape << ' ' << update << ' ' << order << ' ' << stress << ' ' << boundary << ' '
        << particles << ' ' << per_cell << ' ' << courant;
    return all.str();
}

std::string update_title(const configuration& what) {
    const std::string k = what.order > 0 ? "(" + std::to_string(what.order) + ")" : "";
    if (what.update == "galerkin") return what.order > 0 ? "full mass" + k : "lumped mass";
    return upper(what.update) + k;
}

std::string configuration::composition() const {
    std::ostringstream all;
    all << shape << ", " << update_title(*this);
    if (update != "galerkin") all << ", " << upper(stress) << ", " << particles;
    if (boundary != "incremental") all << ", conditions " << boundary;
    all << ", " << per_cell << " per cell, Courant " << courant;
    return all.str();
}

bool is_admpm(const configuration& what) {
    return what.shape == "linear" && what.update == "flip" && what.stress == "euler";
}
