// expect: tamis: the law of taylor_galerkin is no conservation law; give it
#include <tamis/conservation/taylor_galerkin.hpp>

using namespace tamis;

struct still {
    static constexpr int unknowns = 1;
    double wave_speed() const { return 0; }
};

int main() { taylor_galerkin scheme{uniform_grid{{0.}, {1.}, 0.1}, still{}, per_cell{2}}; }
