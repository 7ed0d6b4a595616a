// The scene, its initial state and its exact answer are in scenes/standing_wave.hpp; `standing_wave --help` lists what
// can be composed.
#include "scenes/standing_wave.hpp"
#include "support/driver.hpp"

int main(int argc, char** argv) { return run_scene(standing_wave(), argc, argv); }
