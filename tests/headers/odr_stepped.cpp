#include "odr_stepped.hpp"

template void stepped_solver::step(std::tuple<stepped_body&>, const double&, double);
template long tamis::integrate(stepped_solver&, std::tuple<stepped_body&>, tamis::interval, tamis::courant);
