#pragma once
// Catch2 3 where it is installed, otherwise Catch2 2. Tests keep to what both have: compare numbers by
// Catch::Matchers::WithinAbs and WithinRel.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#else
#include <catch2/catch.hpp>
#endif
