#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace tamis::detail {

/// What a stage runs over: particles, nodes, held nodes, what it likes (a barrier), or it moves whole particles about.
enum class over { particles, nodes, held, whole, storage };
/// Where a field is: on particles, on nodes, or on held nodes, which keep it themselves. The working memory of one
/// stage has columns of its own.
enum class place { particle, node, held, scratch };

/// A set of fields, by number.
using plan_fields = std::uint64_t;
/// Its address is a field's identity.
template <class F> inline constexpr char tag = 0;

/// How the passes of N stages are found. All is numbers here, so that it costs few instantiations.
template <int N> struct plan {
    template <class T> using by_stage = std::array<T, static_cast<std::size_t>(N)>;
    template <class T> using by_field = std::array<T, 64>;

    // Fields: `type` is where a field's type stands among all that stages name.
    by_field<const void*> known{};
    by_field<place> at{};
    by_field<int> type{}, components{}, owner{};
    int field_count = 0;
    plan_fields nodes = 0, particles = 0, private_columns = 0, stored = 0, kept = 0, masses = 0;
    // Stages.
    by_stage<over> where{};
    by_stage<plan_fields> in{}, out{}, lacks{};
    by_stage<bool> live{}, optional{}, looks_for_mass{};
    by_stage<int> pass{};
    // Passes.
    int count = 0;
    by_stage<over> kind{};
    by_stage<plan_fields> loads{}, saves{}, sums{};

    static constexpr std::size_t i(int k) { return static_cast<std::size_t>(k); }
    static constexpr plan_fields bit(int k) { return plan_fields(1) << k; }
    static constexpr place room_of(place where_it_is) {
        return where_it_is == place::scratch ? place::node : where_it_is;
    }
    constexpr int number_of(const void* field, place where_it_is) const {
        for (int k = 0; k < field_count; ++k)
            if (known[i(k)] == field && at[i(k)] == room_of(where_it_is)) return k;
        return -1;
    }
    constexpr plan_fields find(const void* field, place where_it_is) const {
        const int k = number_of(field, where_it_is);
        return k < 0 ? 0 : bit(k);
    }
    constexpr void note(int stage, const void* field, int of_type, place where_it_is, int numbers, bool reads) {
        int k = number_of(field, where_it_is);
        if (k < 0) {
            k = field_count++;
            known[i(k)] = field;
            at[i(k)] = room_of(where_it_is);
            type[i(k)] = of_type;
            components[i(k)] = numbers;
            if (at[i(k)] == place::node) nodes |= bit(k);
            if (at[i(k)] == place::particle) particles |= bit(k);
        }
        if (where_it_is == place::scratch)
            private_columns |= bit(k);
        else
            (reads ? in : out)[i(stage)] |= bit(k);
    }
    constexpr bool is_in(int stage, int of_pass) const { return live[i(stage)] && pass[i(stage)] == of_pass; }

    constexpr std::uint64_t stages_in(int of_pass) const {
        std::uint64_t all = 0;
        for (int s = 0; s < N; ++s)
            if (is_in(s, of_pass)) all |= std::uint64_t(1) << s;
        return all;
    }
    constexpr std::uint64_t left_out() const {
        std::uint64_t all = 0;
        for (int s = 0; s < N; ++s)
            if (!live[i(s)]) all |= std::uint64_t(1) << s;
        return all;
    }

    constexpr void derive(plan_fields watched, bool ahead) {
        static_assert(N <= 64, "tamis: a step has at most 64 stages");
        plan_fields made = 0, before = 0;
        for (int s = 0; s < N; ++s) {
            // What is read but made nowhere before is there from earlier: of particles always.
            before |= in[i(s)] & ~made;
            made |= out[i(s)];
        }
        // Kept from step to step is a node field that no stage makes, or that is watched.
        plan_fields all_made = 0;
        for (int s = 0; s < N; ++s) all_made |= out[i(s)];
        plan_fields so_far = 0;
        for (int s = 0; s < N; ++s) {
            lacks[i(s)] = in[i(s)] & nodes & all_made & ~so_far & ~watched;
            so_far |= out[i(s)];
        }
        private_columns |= nodes & before & (~all_made | watched);
        const plan_fields last = watched | before;
        drop_unread(last | particles);
        find_passes();
        sink_node_stages();
        leave_out_empty_passes();
        if (ahead)
            for (int s = 0; s < N; ++s)
                if (is_in(s, 0)) private_columns |= out[i(s)] & nodes;
        find_traffic(last);
        share_columns(watched);
    }
    constexpr plan_fields stored_on_nodes() const { return (stored & nodes) | private_columns; }

  private:
    constexpr void drop_unread(plan_fields needed) {
        // Particle fields that stages only pass on to each other are needed by those, not after the step.
        plan_fields passed_on = 0;
        for (int s = N - 1; s >= 0; --s) passed_on |= out[i(s)] & particles;
        for (int s = 0; s < N; ++s) passed_on &= ~in_before_made(s);
        needed &= ~passed_on;
        for (int s = N - 1; s >= 0; --s) {
            live[i(s)] = where[i(s)] == over::storage || (out[i(s)] & needed) != 0;
            if (live[i(s)] && where[i(s)] != over::storage) needed = (needed & ~(out[i(s)] & ~in[i(s)])) | in[i(s)];
        }
    }
    /// Particle fields that stage s reads and no stage before it makes: the state of particles.
    constexpr plan_fields in_before_made(int s) const {
        plan_fields made = 0;
        for (int t = 0; t < s; ++t) made |= out[i(t)];
        return in[i(s)] & ~made;
    }
    constexpr plan_fields clash(int before, int after) const {
        return (out[i(before)] & (in[i(after)] | out[i(after)])) | (in[i(before)] & out[i(after)]);
    }
    /// May two stages that clash, the one before the other, be in one pass? Within a pass a node, or a particle, sees
    /// them one after the other; but what particles add to nodes is there only after the pass, and a pass makes the
    /// terms that it adds after all its updates.
    constexpr bool may_share_pass(int before, int after) const {
        if (where[i(before)] != where[i(after)]) return false;
        if (where[i(before)] == over::nodes || where[i(before)] == over::held) return true;
        if (where[i(before)] != over::particles) return false;
        const bool sums_first = (out[i(before)] & nodes) != 0;
        return (clash(before, after) & nodes) == 0 && !sums_first;
    }
    /// Every stage goes into the first pass of its kind that its fields allow.
    constexpr void find_passes() {
        for (int s = 0; s < N; ++s) {
            if (!live[i(s)]) continue;
            int first = 0;
            for (int t = 0; t < s; ++t) {
                if (!live[i(t)]) continue;
                if (clash(t, s) != 0) first = std::max(first, pass[i(t)] + (may_share_pass(t, s) ? 0 : 1));
                // What is known of held nodes besides their fields follows the text.
                if (where[i(t)] == over::held && where[i(s)] == over::held) first = std::max(first, pass[i(t)]);
            }
            const bool joins = where[i(s)] != over::whole && where[i(s)] != over::storage;
            while (first < count && !(joins && kind[i(first)] == where[i(s)])) ++first;
            if (first == count) kind[i(count++)] = where[i(s)];
            pass[i(s)] = first;
        }
    }
    /// What is done to nodes is done as late as it may, where that needs no pass more: passes between may then be left
    /// out.
    constexpr void sink_node_stages() {
        for (int s = N - 1; s >= 0; --s) {
            if (!live[i(s)] || where[i(s)] != over::nodes) continue;
            int last = count - 1;
            for (int t = s + 1; t < N; ++t)
                if (live[i(t)] && clash(s, t) != 0)
                    last = std::min(last, pass[i(t)] - (where[i(t)] == over::nodes ? 0 : 1));
            while (last > pass[i(s)] && kind[i(last)] != over::nodes) --last;
            if (last > pass[i(s)]) pass[i(s)] = last;
        }
    }
    constexpr void leave_out_empty_passes() {
        for (int q = 0; q < count;) {
            bool used = false;
            for (int s = 0; s < N; ++s) used = used || is_in(s, q);
            if (used) {
                ++q;
                continue;
            }
            for (int r = q; r + 1 < count; ++r) kind[i(r)] = kind[i(r + 1)];
            for (int s = 0; s < N; ++s)
                if (pass[i(s)] > q) --pass[i(s)];
            --count;
        }
    }
    /// What each pass loads and saves; what is made and used up within a pass is not stored.
    constexpr void find_traffic(plan_fields needed) {
        plan_fields state = 0;
        for (int s = 0; s < N; ++s) state |= in_before_made(s) & particles;
        needed |= state;
        for (int q = count - 1; q >= 0; --q) {
            plan_fields read = 0, made = 0;
            for (int s = 0; s < N; ++s)
                if (is_in(s, q) && where[i(s)] != over::storage) {
                    read |= in[i(s)] & ~made;
                    made |= out[i(s)];
                }
            loads[i(q)] = read;
            saves[i(q)] = made & needed;
            if (kind[i(q)] == over::particles) sums[i(q)] = made & needed & nodes;
            needed = (needed & ~(made & ~read)) | read;
            stored |= loads[i(q)] | saves[i(q)];
        }
    }
    /// A node field takes the column of one that nobody reads any more: in a pass over nodes at once, since that loads
    /// all it needs and then saves; else from the next pass on. The mass, or its inverse in the same column, stays
    /// until the last stage that asks which nodes have one.
    constexpr void share_columns(plan_fields watched) {
        by_field<int> ends{}, owns{};
        int columns = 0, last_look = -1, mass_read_to = -1;
        for (int s = 0; s < N; ++s)
            if (live[i(s)] && looks_for_mass[i(s)]) last_look = std::max(last_look, pass[i(s)]);
        kept = stored_on_nodes();
        for (int k = 0; k < field_count; ++k) owner[i(k)] = k;
        for (int q = 0; q < count; ++q)
            for (int k = 0; k < field_count; ++k) {
                if (!(nodes & stored & bit(k)) || (private_columns >> k & 1)) continue;
                int first = count, last = -1;
                for (int r = count - 1; r >= 0; --r) {
                    if (saves[i(r)] >> k & 1) first = r;
                    if ((saves[i(r)] | loads[i(r)]) >> k & 1) last = std::max(last, r);
                }
                if (first != q) continue;
                const bool is_mass = masses >> k & 1, at_once = kind[i(q)] == over::nodes;
                const int read_to = last;
                if (is_mass) last = std::max(last, last_look);
                const auto is_free = [&](int c) {
                    const int end = is_mass && (masses >> owns[i(c)] & 1) ? mass_read_to : ends[i(c)];
                    return components[i(owns[i(c)])] == components[i(k)] && (end < q || (at_once && end == q));
                };
                int c = 0;
                while (c < columns && !is_free(c)) ++c;
                if (is_mass) mass_read_to = read_to;
                if (c == columns)
                    owns[i(columns++)] = k;
                else
                    for (int other = 0; other < field_count; ++other)
                        if (other != k && (nodes & stored & bit(other)) && owner[i(other)] == owns[i(c)] &&
                            !(private_columns >> other & 1) && started(other, q, k))
                            kept &= ~bit(other);
                ends[i(c)] = watched >> k & 1 ? count : last;
                owner[i(k)] = owns[i(c)];
            }
    }
    /// Did a field begin to live before pass q, or in it before field k?
    constexpr bool started(int other, int q, int k) const {
        int first = count;
        for (int r = count - 1; r >= 0; --r)
            if (saves[i(r)] >> other & 1) first = r;
        return first < q || (first == q && other < k);
    }
};

}  // namespace tamis::detail
