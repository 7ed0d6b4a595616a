#pragma once
#include <tamis/run/solver.hpp>

#include <string>
#include <string_view>

namespace tamis {

namespace detail {

/// Puts what a composition's step does into words.
template <class C> class explanation {
    using S = typename C::S;
    using plan = schedule_of<C>;

  public:
    std::string text() {
        title();
        [&]<int... Pass>(std::integer_sequence<int, Pass...>) { (pass<Pass>(), ...); }
        (std::make_integer_sequence<int, plan::count>{});
        if (C::sums_ahead)
            out_ +=
                "   pass 1 is made in the last pass over particles of the step before, where none went to another "
                "cell\n";
        list("not run, for nobody reads it", texts(typename plan::dropped{}));
        std::string absent;
        const auto leaves_out = [&](bool there, std::string_view what) {
            if (!there) absent += (absent.empty() ? "" : ", ") + std::string(what);
        };
        leaves_out(has_conditions<C>, "conditions");
        leaves_out(C::own_velocities, "contact");
        leaves_out(C::loaded, "loads");
        leaves_out(C::mass::full || filters_start<C>, "full mass matrix");
        list("not there", absent);
        out_ += "stored: particle" + fields_in(typename C::step_fields{}, true) + " besides the law's own; node" +
                fields_in(stored_on_nodes(typename plan::layout{}), false) + " in " +
                std::to_string(column_row<S, typename plan::layout>::components) + " numbers\n";
        return out_;
    }

  private:
    std::string out_;

    template <class Policy> static std::string name_of() {
        if constexpr (requires { Policy::name; })
            return std::string(Policy::name);
        else
            return "(your own)";
    }
    void title() {
        out_ += name_of<typename C::transfer>();
        if constexpr (requires { C::mass::fixed_terms; }) out_ += "<" + std::to_string(C::mass::fixed_terms) + ">";
        out_ += ", " + name_of<typename C::order>() + ", " + name_of<typename C::shape>() + ", " +
                name_of<typename C::motion>() + " particles, " + std::to_string(C::dim) + "D\n";
    }
    void list(std::string_view what, const std::string& items) {
        if (!items.empty()) out_ += std::string(what) + ": " + items + "\n";
    }
    template <class F> static std::string symbol(bool of_particle) {
        // Held particles keep their weights, not a place.
        if (std::same_as<F, field::position> && !C::places) return "weights";
        if constexpr (requires { F::particle_letter; })
            if (of_particle) return std::string(F::particle_letter);
        return letter<F>();
    }
    template <class... F> static std::string fields_in(fields<F...>, bool of_particle) {
        int numbers = 0;
        std::string all;
        ((all += " " + symbol<F>(of_particle), numbers += F::template components<S>), ...);
        return all + " (" + std::to_string(numbers) + ")";
    }
    template <class Columns, class... F, class... G>
    static auto stored_on_nodes(shared_columns<Columns, shares<F, G>...>) {
        return fields<F...>{};
    }
    template <class... Stage> static std::string texts(stages<Stage...>) {
        std::string all;
        ((all += (all.empty() ? "" : "; ") + Stage::text()), ...);
        return all;
    }
    template <class List> void moved(std::string_view what, List fields_moved, bool of_particle, std::string& line) {
        if constexpr (!std::same_as<List, fields<>>)
            line += (line.empty() ? "" : ", ") + std::string(what) + fields_in(fields_moved, of_particle);
    }
    template <int Pass> void pass() {
        constexpr over kind = plan::template kind<Pass>;
        constexpr std::string_view kinds[] = {"particles", "nodes    ", "held     ", "barrier  ", "storage  "};
        const std::string number = std::to_string(Pass + 1);
        out_ += std::string(number.size() < 2 ? 1 : 0, ' ') + number + " " +
                std::string(kinds[static_cast<std::size_t>(kind)]) + "  " +
                texts(typename plan::template stages_of_pass<Pass>{}) + "\n";
        if constexpr (kind == over::storage) return;
        std::string of_particle, of_node;
        if constexpr (kind == over::particles) {
            moved("reads", typename plan::template particle_loads<Pass>{}, true, of_particle);
            moved("writes", typename plan::template particle_saves<Pass>{}, true, of_particle);
        }
        moved("reads", typename plan::template loads<Pass>{}, false, of_node);
        moved(kind == over::particles ? "sums" : "writes", typename plan::template saves<Pass>{}, false, of_node);
        if (!of_particle.empty()) out_ += "     particle: " + of_particle + "\n";
        if (!of_node.empty()) out_ += "     node: " + of_node + "\n";
        if constexpr (!std::same_as<typename plan::template sums<Pass>, fields<>>)
            out_ += "     exchange" + fields_in(typename plan::template sums<Pass>{}, false) + "\n";
    }
};

}  // namespace detail

/// What a step of this solver does, as text: its passes with their stages in the letters of docs/method.md; what each
/// reads and writes of a particle and of a node, in numbers; which sums are exchanged after it (between the two sides
/// of a periodic axis); what is not run because nobody reads it; what is stored.
///
///     std::cout << explain(mpm);
template <class Grid, class... Policies> std::string explain(const solver<Grid, Policies...>&) {
    return detail::explanation<typename solver<Grid, Policies...>::C>().text();
}

}  // namespace tamis
