// expect: tamis: no policy of this scene asked for that field; name it in make_body's last argument, fields<...>{}
#include <tamis/tamis.hpp>

using namespace tamis;

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}};
    auto body = mpm.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{2});
    for (auto p : body) p[symbols::F].setIdentity();
}
