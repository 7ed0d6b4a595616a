// The 2D step of every shape and update.
#include <tamis/tamis.hpp>

#include "block.hpp"
#include "ratios.hpp"

int main(int argc, char** argv) {
    ratio_run run;
    add_steps<2>(run, 128, "2D", "");
    return run.run(argc, argv);
}
