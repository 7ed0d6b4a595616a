// The main of the tests for Catch2 2; Catch2 3 comes with a compiled one.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
