// The scene, its initial state and its exact answer are in scenes/reflection.hpp; `reflection --help` lists what can be
// composed.
#include "scenes/reflection.hpp"
#include "support/driver.hpp"

int main(int argc, char** argv) { return run_scene(reflection(), argc, argv); }
