#pragma once

/// The momentum of a bar after a few steps, in kg m/s, computed in each of the two translation units.
double momentum_a();
double momentum_b();
