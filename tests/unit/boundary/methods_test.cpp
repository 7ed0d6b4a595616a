#include <tamis/boundary/methods.hpp>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;

TEST_CASE("boundary methods: chosen by name at run time") {
    using detail::held_by;
    CHECK(boundary_method::chosen{"incremental"}.how == boundary_method::incremental::how);
    CHECK(boundary_method::chosen{"velocity"}.how == boundary_method::velocity::how);
    CHECK(boundary_method::chosen{"unlumped2"}.how == boundary_method::unlumped2::how);
    CHECK(boundary_method::chosen{"collected"}.how == boundary_method::collected::how);
    CHECK(names(complaint([] { boundary_method::chosen{"nitsche"}; }), "boundary_method::chosen", "\"nitsche\"",
                "give incremental"));
    static_assert(detail::on_momentum(held_by::combined) && !detail::on_momentum(held_by::velocity));
}
