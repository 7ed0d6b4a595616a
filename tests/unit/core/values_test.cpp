#include <tamis/core/values.hpp>

#include <set>

#include "catch.hpp"

using namespace tamis;

namespace {

template <int Dim, class T> void packing_keeps_symmetric_tensors() {
    using S = space<Dim, T>;
    using tensor = typename S::tensor;
    std::set<int> used;
    tensor full;
    for (int d = 0; d < Dim; ++d)
        for (int e = 0; e < Dim; ++e) {
            CHECK(detail::packed(Dim, d, e) == detail::packed(Dim, e, d));
            used.insert(detail::packed(Dim, d, e));
            full(d, e) = T(typename S::real(1 + d * e + d + e));
        }
    CHECK(used.size() == static_cast<std::size_t>(Dim * (Dim + 1) / 2));
    CHECK(*used.begin() == 0);
    CHECK(*used.rbegin() == Dim * (Dim + 1) / 2 - 1);

    symmetric_field::value<S> half;
    detail::pack<S>(half, full);
    const tensor back = detail::unpack<S>(half);
    for (int c = 0; c < Dim * Dim; ++c) CHECK_FALSE(lane<T>::any(back.data()[c] != full.data()[c]));
    for (int d = 0; d < Dim; ++d) CHECK_FALSE(lane<T>::any(half[d] != full(d, d)));
}

using plane = space<2, double>;
using row = values<plane, fields<field::mass, const field::velocity, field::stress>>;

}  // namespace

TEST_CASE("values: the upper half of a symmetric tensor, diagonal first, is all of it") {
    packing_keeps_symmetric_tensors<1, double>();
    packing_keeps_symmetric_tensors<2, double>();
    packing_keeps_symmetric_tensors<3, float>();
#if TAMIS_VECTOR_BYTES > 0
    packing_keeps_symmetric_tensors<2, native_lanes::type<double>>();
    packing_keeps_symmetric_tensors<3, native_lanes::type<float>>();
#endif
}

TEST_CASE("values: a row has its fields one after the other, without gaps") {
    STATIC_REQUIRE(row::components == 6);
    STATIC_REQUIRE(sizeof(row) == 6 * sizeof(double));
    STATIC_REQUIRE(row::first<field::mass>() == 0);
    STATIC_REQUIRE(row::first<field::velocity>() == 1);
    STATIC_REQUIRE(row::first<field::stress>() == 3);

    row r;
    r.set_zero();
    r.get<field::mass>() = 1;
    r.get<field::velocity>() << 2, 3;
    r.get<field::stress>() << 4, 5, 6;
    const auto* numbers = reinterpret_cast<const double*>(&r);
    for (int c = 0; c < 6; ++c) CHECK(numbers[c] == c + 1);
    CHECK(detail::component<plane>(r.get<field::mass>(), 0) == 1);
    CHECK(detail::component<plane>(r.get<field::velocity>(), 1) == 3);
    r.set_zero();
    for (int c = 0; c < 6; ++c) CHECK(numbers[c] == 0);
}

TEST_CASE("values: a view shows what was declared, const where it is only read") {
    row r;
    r.set_zero();
    const view<row, fields<const field::mass, field::velocity>> shown{r};
    STATIC_REQUIRE(std::is_const_v<std::remove_reference_t<decltype(shown[symbols::m])>>);
    STATIC_REQUIRE_FALSE(std::is_const_v<std::remove_reference_t<decltype(shown[symbols::v])>>);
    shown[symbols::v][1] = 7;
    CHECK(r.get<field::velocity>()[1] == 7);
}

TEST_CASE("values: of a tensor that is not symmetric the upper half is stored") {
    using S = space<3, double>;
    using tensor = S::tensor;
    tensor full, upper;
    full << 1, 2, 3, 40, 5, 6, 70, 80, 9;
    upper << 1, 2, 3, 2, 5, 6, 3, 6, 9;
    symmetric_field::value<S> half;
    detail::pack<S>(half, full);
    CHECK(detail::unpack<S>(half) == upper);
    double memory[2 * 6] = {};
    using stored = detail::stored_symmetric<tensor, 6, 2>;
    stored{memory} = full;
    CHECK(tensor(stored::read(memory)) == upper);
    for (int c = 0; c < 6; ++c) CHECK(memory[2 * c + 1] == 0);
    stored{memory} += full;
    CHECK(tensor(stored::read(memory)) == 2 * upper);
}
