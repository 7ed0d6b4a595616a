#include "odr.hpp"

#include "odr_bar.hpp"

double momentum_b() { return momentum_of_bar(); }
