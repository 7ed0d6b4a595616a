#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/lanes.hpp>
#include <tamis/core/names.hpp>

#include <array>
#include <concepts>
#include <type_traits>

namespace tamis {

/// An order k that is known only at run time: `fmpm<dynamic>{k}`.
inline constexpr int dynamic = -1;

namespace detail {

template <int K> struct term_count {
    static_assert(K >= 1,
                  "tamis: FMPM(k) and XPIC(k) need k >= 1; use fmpm<dynamic>{k} for a k known at run time, flip "
                  "for no full mass matrix");
    static constexpr int fixed_terms = K;
    static constexpr int terms() { return K; }
};
template <> class term_count<dynamic> {
  public:
    explicit term_count(int k) : terms_(k) {
        if (k < 1) throw error(sentence("FMPM(k) and XPIC(k): k is ", k, "; give k >= 1"));
    }
    int terms() const { return terms_; }

  private:
    int terms_;
};

/// m becomes 1/m.
struct invert_mass {
    using list = fields<const field::mass, field::inverse_mass>;
    TAMIS_INLINE void operator()(auto i) const { i[symbols::im] = inverse_or_zero(i[symbols::m]); }
};
/// ... in the mass's place.
struct invert_in_place {
    using list = fields<field::inverse_mass>;
    TAMIS_INLINE void operator()(auto i) const { i[symbols::im] = inverse_or_zero(i[symbols::im]); }
};
/// To = From.
template <class From, class To> struct copy_field {
    using list = fields<const From, To>;
    TAMIS_INLINE void operator()(auto i) const { i[To{}] = i[From{}]; }
};
/// dv = A u = u - m^-1 S^T M S u of the field `From`, added to `To`; dv is in `Term`, S^T M S u in `Image`. `Clears`:
/// the image is zero then, as the next sum needs it. Its memory is at hand here, and would not be in a pass of its own.
/// `Keeps`: dv is read again; else it is not written.
template <class From, class To, class Term, class Image, bool Clears, bool Keeps> struct next_increment {
    using image = std::conditional_t<Clears, Image, const Image>;
    using list =
        typename concatenate<fields_if<!(Keeps && std::same_as<From, Term>)&&!std::same_as<From, To>, const From>,
                             fields<const field::inverse_mass, image>, fields_if<Keeps, Term>, fields<To>>::type;
    TAMIS_INLINE void operator()(auto i) const {
        if constexpr (Keeps) {
            i[Term{}] = i[From{}] - i[symbols::im] * i[Image{}];
            i[To{}] += i[Term{}];
        } else
            i[To{}] += i[From{}] - i[symbols::im] * i[Image{}];
        if constexpr (Clears) i[Image{}].setZero();
    }
};
/// dv becomes A dv, where nothing is summed.
struct next_increment_alone {
    using list = fields<const field::inverse_mass, const field::image, field::increment>;
    TAMIS_INLINE void operator()(auto i) const {
        using namespace symbols;
        i[dv] -= i[im] * i[Sdv];
    }
};
/// dv becomes m^-1 S^T M S dv.
struct image_to_increment {
    using list = fields<const field::inverse_mass, const field::image, field::increment>;
    TAMIS_INLINE void operator()(auto i) const {
        using namespace symbols;
        i[dv] = i[im] * i[Sdv];
    }
};
/// To += dv.
template <class To> struct add_increment {
    using list = fields<const field::increment, To>;
    TAMIS_INLINE void operator()(auto i) const { i[To{}] += i[symbols::dv]; }
};
/// m and m dv^2 of nodes.
template <class S> struct increment_square {
    using list = fields<const field::inverse_mass, const field::increment>;
    using T = typename S::scalar;
    TAMIS_INLINE std::array<T, 2> operator()(auto i) const {
        using namespace symbols;
        const T m = inverse_or_zero(i[im]);
        return {m, m * i[dv].squaredNorm()};
    }
};

/// `add_term`: A u of the field `From` becomes dv and is added to `To`. `add_series`: so for all A^l u, 0 < l < k, with
/// A = I - S+ S and S+ = m^-1 S^T M (docs/method.md, Mass policies; Nairn & Hammerquist 2021). By increments: the sum
/// with alternating binomials is the same in exact arithmetic, but loses k log10(2) digits. `felt`: do particles feel
/// what conditions take from the increments?
template <class To, class From, class Term = field::increment, class Image = field::image, bool Keeps = true,
          class Pass>
void add_term(bool felt, Pass& pass) {
    pass.template spread<From>();
    pass.nodes(next_increment<From, To, Term, Image, Pass::clears_image, Keeps>{});
    if constexpr (Pass::clears_image) pass.image_is_zero();
    pass.template hold_increment<To>(felt);
}
/// The same series by the assembled matrix: a pass over nodes makes a term and adds it, of what is in one of two fields
/// in the other one. The first takes two passes where what it is made of is the sum itself.
template <class To, class From, class Term, class Image, class Pass>
void add_products(int terms, bool felt, Pass& pass) {
    constexpr bool keeps_last = Pass::reads_last_increment;
    const auto add = [&](auto from, auto to, int term) {
        using Next = typename decltype(to)::type;
        pass.template add_product<typename decltype(from)::type, To, Next>(keeps_last || term < terms - 1);
        pass.template hold_increment<To, Next>(felt);
    };
    const std::type_identity<Term> one;
    const std::type_identity<Image> other;
    if constexpr (!std::same_as<From, To>)
        add(std::type_identity<From>{}, one, 1);
    else if (terms == 2)
        add_term<To, From, Term, Image, keeps_last>(felt, pass);
    else
        add_term<To, From, Term, Image>(felt, pass);
    for (int term = 2; term < terms; ++term)
        if (term % 2 == 0)
            add(one, other, term);
        else
            add(other, one, term);
}
template <class To, class From, class Term = field::increment, class Image = field::image, class Pass>
void add_series(int terms, bool felt, Pass& pass) {
    constexpr bool keeps_last = Pass::reads_last_increment;
    if (terms < 2) return;
    if constexpr (requires { requires Pass::may_multiply; })
        if (pass.multiplies()) {
            // The first term must not go to the field that it is made of.
            constexpr bool swap = std::same_as<From, Term>;
            using Next = std::conditional_t<swap, Image, Term>;
            return add_products<To, From, Next, std::conditional_t<swap, Term, Image>>(terms, felt, pass);
        }
    if (terms == 2) return add_term<To, From, Term, Image, keeps_last>(felt, pass);
    add_term<To, From, Term, Image>(felt, pass);
    for (int l = 2; l < terms - 1; ++l) add_term<To, Term, Term, Image>(felt, pass);
    add_term<To, Term, Term, Image, keeps_last>(felt, pass);
}

}  // namespace detail

/// A mass policy: how nodes make velocity from momentum. `full`: does it make more than p/m? Then it has
/// `filter<From, To>(felt, op)`, which makes the full velocity in `To` of the lumped one in `From` with what a
/// `mass_operator` offers (step/mass_operator.hpp), and says by `on_nodes` what memory that takes.
template <class M>
concept MassPolicy = requires {
    { M::full } -> std::convertible_to<bool>;
};

/// Diagonal mass matrix: v = p/m.
struct lumped_mass {
    static constexpr bool full = false;
};

/// Full mass matrix S^T M S, inverted by k terms: v(k), FMPM(k) of Nairn & Hammerquist (2021).
template <int K> struct full_mass : detail::term_count<K> {
    using detail::term_count<K>::term_count;
    static constexpr bool full = K != 1;
    using on_nodes =
        std::conditional_t<full, fields<const field::inverse_mass, field::velocity, field::increment, field::image>,
                           fields<>>;
    /// The lumped velocity in `From` becomes v(k) in `To`. With K = 1 the matrix is the lumped one.
    template <class From, class To> void filter(bool felt, auto& pass) const requires(full) {
        if constexpr (!std::same_as<From, To>) pass.nodes(detail::copy_field<From, To>{});
        detail::add_series<To, From>(this->terms(), felt, pass);
    }
    /// Adds M~_k^-1 m dv to `To`, dv the increment at hand.
    template <class To> void series(bool felt, auto& pass) const {
        pass.nodes(detail::add_increment<To>{});
        detail::add_series<To, field::increment>(this->terms(), felt, pass);
    }
    /// The terms of M~_k^-1 m dv one after the other in dv, each shown by look().
    template <class Look> void each_term(auto& pass, Look look) const {
        look();
        for (int l = 1; l < this->terms(); ++l) {
            pass.template spread<field::increment>();
            pass.nodes(detail::next_increment_alone{});
            look();
        }
    }
};

/// XPIC(k) of Hammerquist & Nairn (2017): the full mass matrix acts on the momentum of the step's start only.
template <int K> struct filtered_mass : detail::term_count<K> {
    using detail::term_count<K>::term_count;
    static constexpr bool full = false;
    static constexpr bool filters_start = true, has_series = K != 1;
    using on_nodes = std::conditional_t<has_series, fields<const field::inverse_mass, field::increment, field::image>,
                                        fields<const field::inverse_mass>>;
};

}  // namespace tamis
