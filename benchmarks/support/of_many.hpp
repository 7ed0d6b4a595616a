#pragma once
#include <tamis/tamis.hpp>

// What one_solver.cpp composes, with its step compiled in another file (docs/guide/many-files.md).
using solver_of_many = tamis::solver<tamis::uniform_grid<3>, tamis::quadratic_spline, tamis::flip>;
using body_of_many = solver_of_many::body_for<tamis::linear_elastic>;

extern template void solver_of_many::step(std::tuple<body_of_many&>, const double&, double);
