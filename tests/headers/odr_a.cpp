#include "odr.hpp"

#include "odr_bar.hpp"

double momentum_a() { return momentum_of_bar(); }
