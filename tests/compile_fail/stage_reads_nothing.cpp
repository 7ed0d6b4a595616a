// expect: a stage of the step reads a node field that no stage before it makes; put the stage that makes it before it
// expect: stage_reads_nothing.cpp
#include <tamis/step/text.hpp>

using namespace tamis;
using namespace tamis::detail;

using text = stages<divide<field::force, field::acceleration>, p2g<field::force, unloaded, moving>>;
constexpr int passes = schedule<space<2, double>, text, fields<field::acceleration, field::inverse_mass>>::count;
int main() { return passes; }
