#pragma once
#include <tamis/core/values.hpp>

namespace tamis::detail {

/// Field F is where field G is, which nobody reads any more when F is made.
template <class F, class G> struct shares {};
/// Node fields of which some take the columns of others: `Columns` are the fields that columns are called by, each
/// field of the scene is in one `shares`.
template <class Columns, class... Shares> struct shared_columns {};

/// The column of a field in a layout: a list of fields, or `shared_columns`.
template <class Layout, class F> struct column_of {};
template <class... L, class F> struct column_of<fields<L...>, F> { using type = std::remove_const_t<F>; };
template <class F, class... Shares> struct find_share {};
template <class F, class G, class... Rest> struct find_share<F, shares<F, G>, Rest...> { using type = G; };
template <class F, class First, class... Rest> struct find_share<F, First, Rest...> : find_share<F, Rest...> {};
template <class Columns, class... Shares, class F> struct column_of<shared_columns<Columns, Shares...>, F>
    : find_share<std::remove_const_t<F>, Shares...> {};

template <class Layout> struct columns_in { using type = Layout; };
template <class Columns, class... Shares> struct columns_in<shared_columns<Columns, Shares...>> {
    using type = Columns;
};
/// The numbers of W nodes, column by column.
template <class S, class Layout> using column_row = values<S, typename columns_in<Layout>::type>;

}  // namespace tamis::detail

namespace tamis {

template <class Columns, class... F, class... G, class Asked>
inline constexpr bool stores<detail::shared_columns<Columns, detail::shares<F, G>...>, Asked> =
    (std::same_as<F, std::remove_const_t<Asked>> || ...);

}  // namespace tamis
