#pragma once
// Everything, in the order of the layers.
#include <tamis/core/config.hpp>
#include <tamis/core/execution.hpp>
#include <tamis/core/fields.hpp>
#include <tamis/core/names.hpp>
#include <tamis/grid/uniform_grid.hpp>
#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/linear.hpp>
#include <tamis/shape/quadratic_spline.hpp>
#include <tamis/material/linear_elastic.hpp>
#include <tamis/boundary/conditions.hpp>
#include <tamis/stress/order.hpp>
#include <tamis/load/load.hpp>
#include <tamis/particles/body.hpp>
#include <tamis/transfer/schemes.hpp>
#include <tamis/solver/solver.hpp>
