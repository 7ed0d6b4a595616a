// expect: tamis: a shape may reach at most one node beyond a wall (support up to 4)
#include <tamis/tamis.hpp>

using namespace tamis;

struct wide {
    static constexpr int support = 6;
    static constexpr double shift = 0;
    template <class T> axis_weights<T, 6> on_axis(const T&) const { return {}; }
};

int main() { solver mpm{uniform_grid{{0.}, {1.}, 0.1}, wide{}}; }
