// expect: tamis: the increment and its image are working memory of the mass matrix's series
#include <tamis/tamis.hpp>

using namespace tamis;

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}, fmpm<3>{}};
    return mpm.on_node(field::increment{}, {4, 0, 0})[0] > 0;
}
