#pragma once
// Everything, in the order of the layers.
#include <tamis/core/config.hpp>
#include <tamis/core/execution.hpp>
#include <tamis/core/fields.hpp>
#include <tamis/core/names.hpp>
#include <tamis/grid/uniform_grid.hpp>
#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/gimp.hpp>
#include <tamis/shape/linear.hpp>
#include <tamis/shape/quadratic_spline.hpp>
#include <tamis/material/drucker_prager.hpp>
#include <tamis/material/granular_flow.hpp>
#include <tamis/material/ideal_gas.hpp>
#include <tamis/material/j2.hpp>
#include <tamis/material/johnson_cook.hpp>
#include <tamis/material/johnson_cook_failure.hpp>
#include <tamis/material/linear_elastic.hpp>
#include <tamis/material/mohr_coulomb.hpp>
#include <tamis/material/neo_hookean.hpp>
#include <tamis/material/newtonian.hpp>
#include <tamis/material/pressure_gas.hpp>
#include <tamis/material/tait.hpp>
#include <tamis/boundary/conditions.hpp>
#include <tamis/boundary/methods.hpp>
#include <tamis/contact/policies.hpp>
#include <tamis/order/order.hpp>
#include <tamis/load/load.hpp>
#include <tamis/load/loads.hpp>
#include <tamis/load/damping.hpp>
#include <tamis/load/forces.hpp>
#include <tamis/run/body.hpp>
#include <tamis/update/schemes.hpp>
#include <tamis/update/affine.hpp>
#include <tamis/mass/adaptive.hpp>
#include <tamis/mass/periodic.hpp>
#include <tamis/run/solver.hpp>
#include <tamis/run/explain.hpp>
#include <tamis/run/initial.hpp>
#include <tamis/run/integrate.hpp>
#include <tamis/run/walk.hpp>
#include <tamis/observe/atomic_file.hpp>
#include <tamis/observe/csv.hpp>
#include <tamis/observe/dump.hpp>
#include <tamis/observe/measure.hpp>
#include <tamis/observe/progress.hpp>
#include <tamis/observe/record.hpp>
#include <tamis/observe/vtk.hpp>
#include <tamis/observe/watch.hpp>

/// The Material Point Method: a `solver` composed of policies steps bodies, `integrate` runs it. What is in `detail` is
/// no interface and may change at any time.
namespace tamis {}
