#pragma once

/// An independent reference for one step of the material point method: every operator a full matrix, every equation
/// written out as it stands in the specification. Meant to be obviously right, not fast: memory and work grow with
/// particles x nodes. Double precision; dimension 1, 2 or 3 at run time. It shares no code with the library it checks.

#include "basis.hpp"     // IWYU pragma: export
#include "boundary.hpp"  // IWYU pragma: export
#include "held.hpp"      // IWYU pragma: export
#include "law.hpp"       // IWYU pragma: export
#include "load.hpp"      // IWYU pragma: export
#include "mass.hpp"      // IWYU pragma: export
#include "scene.hpp"     // IWYU pragma: export
#include "shape.hpp"     // IWYU pragma: export
#include "step.hpp"      // IWYU pragma: export
