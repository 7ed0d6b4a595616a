#pragma once
#include <tamis/core/each_of.hpp>
#include <tamis/observe/atomic_file.hpp>
#include <tamis/observe/watch.hpp>

#include <algorithm>

namespace tamis {

/// An observer for debugging, ADMPM's dump: each time it is called it writes, for every node with mass, the node's
/// values and the particles in its reach with their weight, slope and every stored field; then the particles in no
/// node's reach; then the particles that are not numbers and the number of cell crossings since the last record. Node
/// values (mass, momentum, internal force; velocity, density, stress, strain as mass-weighted means) are made from the
/// particles as they are at that time.
///
///     dump_output all(mpm, bodies(bar), "bar.txt");
///     try {
///         integrate(mpm, bodies(bar), {0, 2}, courant{0.1}, every(100, std::ref(all)));
///     } catch (const error& e) {
///         all.commit(e.what());
///         throw;
///     }
///     all.commit();
///
/// The file appears at `commit`; a run that failed is committed with the reason, its records are the use of a dump.
/// Throws `error` where the file cannot be written. Solver and bodies must outlive it.
template <class Lattice, class Shape, class... Body> class dump_output {
  public:
    /// Of these bodies, into a file.
    template <class Solver> dump_output(const Solver& mpm, std::tuple<Body&...> all, std::filesystem::path path)
        : dump_output(
              mpm.lattice(), mpm.functions(), [&mpm] { return mpm.crossings(); }, all, std::move(path)) {}
    /// `crossings` counts the cell crossings so far.
    dump_output(const Lattice& lattice, const Shape& functions, std::function<std::size_t()> crossings,
                std::tuple<Body&...> all, std::filesystem::path path)
        : lattice_(lattice),
          functions_(functions),
          all_(all),
          crossings_(std::move(crossings)),
          told_(crossings_()),
          file_(std::move(path)) {}

    void operator()(const progress_state& now) {
        std::ostream& out = file_.out();
        out << "step " << now.step << " time " << now.time << '\n';
        const std::vector<std::string> texts = particle_texts();
        std::vector<touch> touches;
        std::vector<std::size_t> alone;
        find_touches(touches, alone);
        auto next = touches.begin();
        for (const auto& node : node_records(lattice_, functions_, all_)) {
            put_node(out, node);
            for (; next != touches.end() && before(next->node, node.index); ++next) {
            }
            for (; next != touches.end() && next->node == node.index; ++next) {
                out << "    weight " << next->weight << " slope";
                put(out, next->slope);
                out << ' ' << texts[next->particle] << '\n';
            }
        }
        out << "  in no node's reach: " << alone.size() << '\n';
        for (const std::size_t k : alone) out << "    " << texts[k] << '\n';
        const std::size_t crossings = crossings_();
        const watch_report report{now.step, now.time, detail::bad_particles(all_), crossings - told_};
        told_ = crossings;
        out << "  not a number: " << report.bad.size() << ", cell crossings since the last record: " << report.crossings
            << '\n'
            << report;
    }
    /// Puts the file in place; the text given becomes its last line.
    void commit(const std::string& last_line = "end of the run") {
        file_.out() << last_line << '\n';
        file_.commit();
    }

  private:
    static constexpr int dim = Lattice::D;
    using real = typename Lattice::real;
    struct touch {
        std::array<int, 3> node;
        std::size_t particle;
        real weight;
        point<dim, real> slope;
    };
    const Lattice& lattice_;
    const Shape& functions_;
    std::tuple<Body&...> all_;
    std::function<std::size_t()> crossings_;
    std::size_t told_;
    atomic_file file_;

    static bool before(const std::array<int, 3>& a, const std::array<int, 3>& b) {
        return std::tie(a[2], a[1], a[0]) < std::tie(b[2], b[1], b[0]);
    }
    template <class Values> static void put(std::ostream& out, const Values& values) {
        for (int k = 0; k < values.size(); ++k) out << ' ' << values.data()[k];
    }
    template <class Node> static void put_node(std::ostream& out, const Node& node) {
        const auto& mean = node.mean;
        out << "  node";
        for (int d = 0; d < dim; ++d) out << ' ' << node.index[static_cast<std::size_t>(d)];
        out << " position";
        put(out, mean.position);
        out << " mass " << mean.mass << " momentum";
        put(out, point<dim, real>(mean.mass * mean.velocity));
        out << " velocity";
        put(out, mean.velocity);
        out << " internal_force";
        put(out, node.internal_force);
        if constexpr ((tells_density<Body> && ...)) out << " density " << mean.density;
        out << " stress";
        put(out, mean.stress);
        if constexpr ((tells_strain<Body> && ...)) {
            out << " strain";
            put(out, mean.strain);
        }
        out << '\n';
    }
    std::vector<std::string> particle_texts() const {
        std::vector<std::string> texts;
        int k = 0;
        const auto each = [&](const auto& body) {
            using body_type = std::remove_cvref_t<decltype(body)>;
            long n = 0;
            for (const auto p : body) {
                std::ostringstream text;
                text.precision(std::numeric_limits<double>::max_digits10);
                text << "body " << k << " particle " << n++;
                each_stored_field(body, [&](auto field) {
                    text << ' ' << field.name;
                    for (const auto& value : field.values(p)) text << ' ' << value;
                });
                if constexpr (tells_density<body_type> && !body_type::has(symbols::rho))
                    text << " density " << density_of(body, p);
                if constexpr (tells_strain<body_type> && !body_type::has(symbols::epsilon)) {
                    text << " strain";
                    put(text, strain_of(body, p));
                }
                texts.push_back(text.str());
            }
            ++k;
        };
        detail::each_of(all_, each);
        return texts;
    }
    void find_touches(std::vector<touch>& touches, std::vector<std::size_t>& alone) const {
        std::size_t n = 0;
        const auto each = [&](const auto& body) {
            for (const auto p : body) {
                bool reached = false;
                each_near_node(lattice_, functions_, p, [&](const auto& near) {
                    if (near.weight == real(0)) return;
                    reached = true;
                    touches.push_back({near.index, n, near.weight, near.slope});
                });
                if (!reached) alone.push_back(n);
                ++n;
            }
        };
        detail::each_of(all_, each);
        std::stable_sort(touches.begin(), touches.end(),
                         [](const touch& a, const touch& b) { return before(a.node, b.node); });
    }
};
template <class Solver, class... Body> dump_output(const Solver& mpm, std::tuple<Body&...>, std::filesystem::path)
    -> dump_output<std::remove_cvref_t<decltype(mpm.lattice())>, std::remove_cvref_t<decltype(mpm.functions())>,
                   Body...>;

}  // namespace tamis
