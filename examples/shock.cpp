// The scene, its initial state and its exact answer are in scenes/shock.hpp; `shock --help` lists what can be composed.
#include "scenes/shock.hpp"
#include "support/driver.hpp"

int main(int argc, char** argv) { return run_scene(shock(), argc, argv); }
