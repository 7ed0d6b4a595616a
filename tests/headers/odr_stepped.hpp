#pragma once
#include <tamis/tamis.hpp>

// docs/guide/many-files.md: a composition whose step and run are compiled in one file.

using stepped_solver = tamis::solver<tamis::uniform_grid<1>, tamis::linear, tamis::fmpm<2>>;
using stepped_body = stepped_solver::body_for<tamis::linear_elastic>;

extern template void stepped_solver::step(std::tuple<stepped_body&>, const double&, double);
extern template long tamis::integrate(stepped_solver&, std::tuple<stepped_body&>, tamis::interval, tamis::courant);
