// expect: tamis: contact_method::velocity corrects what the full mass matrix gave; give fmpm<k> with k > 1
#include <tamis/tamis.hpp>

using namespace tamis;

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}, flip{},
               contact{frictionless{}, normal_by_mass{}, by_approach{}, contact_method::velocity{}}};
}
