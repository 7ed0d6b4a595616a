#include "manufactured_run.hpp"

#include <sstream>

namespace {

const std::vector<manufactured::compiled>& compiled(int dim) {
    if (dim != 2 && dim != 3) throw std::invalid_argument("the dimension is not 2 or 3");
    return dim == 2 ? manufactured::compiled_2d() : manufactured::compiled_3d();
}
void need(bool right, const std::string& otherwise) {
    if (!right) throw std::invalid_argument(otherwise);
}

}  // namespace

std::vector<manufactured_composition> manufactured_compositions(int dim) {
    std::vector<manufactured_composition> all;
    for (const auto& one : compiled(dim)) all.push_back(one.names);
    return all;
}

manufactured_result run_manufactured(const manufactured_options& o) {
    need(o.cells >= 4 && o.cells <= 4096, "give 4 to 4096 cells");
    need(o.per_cell >= 1 && o.per_cell <= 10, "give 1 to 10 particles per cell and axis");
    need(o.amplitude > 0 && o.amplitude <= 0.25,
         "give an amplitude above 0 and up to 0.25 m; from 1/pi on the body is "
         "turned inside out");
    need(o.order >= 1 && o.order <= 1000, "give an order of 1 to 1000");
    need(o.courant > 0 && o.courant <= 1, "give a Courant number above 0 and up to 1");
    need(o.time > 0 && o.time <= 1e3, "give an end time above 0 and up to 1000 s");
    need(o.poisson > -1 && o.poisson < 0.5, "give a Poisson's ratio between -1 and 1/2");
    std::ostringstream known;
    for (const auto& one : compiled(o.dim)) {
        const auto& [shape, update, stress] = one.names;
        if (shape == o.shape && update == o.update && stress == o.stress) return one.run(o);
        known << (known.tellp() > 0 ? "; " : "") << shape << ' ' << update << ' ' << stress;
    }
    throw std::invalid_argument("shape " + o.shape + ", update " + o.update + ", stress order " + o.stress +
                                " are not compiled together in " + std::to_string(o.dim) + "D; there are " +
                                known.str() + " (examples/support/manufactured_" + std::to_string(o.dim) + "d.cpp)");
}
