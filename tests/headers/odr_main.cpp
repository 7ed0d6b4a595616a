#include "odr.hpp"

#include <cmath>
#include <cstdio>

int main() {
    const double a = momentum_a();
    const double b = momentum_b();
    std::printf("momentum of the bar: %.17g and %.17g, exactly 0.01\n", a, b);
    return a == b && std::abs(a - 0.01) < 1e-14 ? 0 : 1;
}
