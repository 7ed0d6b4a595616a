// expect: tamis: FMPM(k) and XPIC(k) need k >= 1; use fmpm<dynamic>{k} for a k known at run time, flip
#include <tamis/tamis.hpp>

using namespace tamis;

int main() { solver mpm{uniform_grid{{0.}, {1.}, 0.1}, linear{}, fmpm<0>{}}; }
