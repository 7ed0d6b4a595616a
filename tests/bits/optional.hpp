#pragma once
// Public headers beside tamis.hpp. Where one has moved, both places are named here, so that the same program compiles
// with headers of before and of after.
#if __has_include(<tamis/mass/exact.hpp>)
#include <tamis/mass/exact.hpp>
#else
#include <tamis/transfer/exact.hpp>
#endif
#include <tamis/conservation/integrate.hpp>
