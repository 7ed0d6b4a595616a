// expect: nobody reads what a stage of the step makes; is the name of a field right?
// expect: stage_nobody_reads.cpp
#include <tamis/step/text.hpp>

using namespace tamis;
using namespace tamis::detail;

using text = stages<p2g<field::force, unloaded, moving>, divide<field::force, field::acceleration>>;
constexpr int passes = schedule<space<2, double>, text>::count;
int main() { return passes; }
