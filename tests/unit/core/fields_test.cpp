#include <tamis/core/names.hpp>

#include "catch.hpp"

using namespace tamis;

namespace fields_test {

struct temperature : scalar_field {
    static constexpr std::string_view name = "temperature";
};
struct nameless : scalar_field {};
struct not_empty : scalar_field {
    static constexpr std::string_view name = "not_empty";
    double value;
};
struct asks {
    using on_particles = fields<temperature>;
};

template <class A, class B> constexpr bool same = std::is_same_v<A, B>;

using reads_mass = fields<const field::mass, field::velocity>;

}  // namespace fields_test

using namespace fields_test;

TEST_CASE("fields: a union has every field once, at its first place, without const") {
    STATIC_REQUIRE(same<merge<>, fields<>>);
    STATIC_REQUIRE(same<merge<reads_mass>, fields<field::mass, field::velocity>>);
    STATIC_REQUIRE(same<merge<reads_mass, fields<>, fields<temperature, field::mass>, fields<const temperature>>,
                        fields<field::mass, field::velocity, temperature>>);
}

TEST_CASE("fields: a list says what it contains and what it writes") {
    STATIC_REQUIRE(contains<reads_mass, field::mass>);
    STATIC_REQUIRE(contains<reads_mass, const field::velocity>);
    STATIC_REQUIRE_FALSE(contains<reads_mass, temperature>);
    STATIC_REQUIRE_FALSE(writes<reads_mass, field::mass>);
    STATIC_REQUIRE(writes<reads_mass, field::velocity>);
    STATIC_REQUIRE_FALSE(writes<fields<>, field::velocity>);
}

TEST_CASE("fields: a policy that does not say asks for nothing") {
    STATIC_REQUIRE(same<on_particles_t<asks>, fields<temperature>>);
    STATIC_REQUIRE(same<on_nodes_t<asks>, fields<>>);
    STATIC_REQUIRE(same<on_particles_t<int>, fields<>>);
}

TEST_CASE("fields: only an empty struct with a name is a field") {
    STATIC_REQUIRE(Field<temperature>);
    STATIC_REQUIRE(Field<const temperature>);
    STATIC_REQUIRE_FALSE(Field<nameless>);
    STATIC_REQUIRE_FALSE(Field<not_empty>);
    STATIC_REQUIRE_FALSE(Field<int>);
}

TEST_CASE("fields: numbers per kind and dimension") {
    using plane = space<2, double>;
    using volume = space<3, double>;
    STATIC_REQUIRE(scalar_field::components<volume> == 1);
    STATIC_REQUIRE(vector_field::components<plane> == 2);
    STATIC_REQUIRE(tensor_field::components<volume> == 9);
    STATIC_REQUIRE(symmetric_field::components<space<1, double>> == 1);
    STATIC_REQUIRE(symmetric_field::components<plane> == 3);
    STATIC_REQUIRE(symmetric_field::components<volume> == 6);
}
