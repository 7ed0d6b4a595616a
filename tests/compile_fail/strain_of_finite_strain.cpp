// expect: tamis: the law tells no stress of a strain alone
#include <tamis/tamis.hpp>

using namespace tamis;

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}};
    auto body = mpm.make_body(neo_hookean{.young = 1, .density = 1}, everywhere, per_cell{2});
    set_strain_of(body, [](const auto& at) { return 0.1 * at[0]; });
}
