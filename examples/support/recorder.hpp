#pragma once
#include "bar.hpp"

#include <tamis/tamis.hpp>

#include <chrono>
#include <optional>

using bar_observer = std::function<void(const tamis::progress_state&)>;

/// What the recorder asks the solver.
struct bar_questions {
    std::function<double()> boundary_work;
    std::function<std::size_t()> crossings;
};

/// Gives a bar its initial state, follows its run, and gathers the result. It knows the body but not the update and the
/// stress order, so it is compiled for a few types only.
template <class Lattice, class Shape, class Body> class recorder {
  public:
    recorder(const Lattice& lattice, const Shape& functions, Body& bar, const bar_scene& scene, const bar_options& o,
             bar_questions solver)
        : bar_(bar),
          scene_(scene),
          o_(o),
          exact_(scene.exact(o.amplitude)),
          solver_(std::move(solver)),
          every_(record_every(o)) {
        tamis::set_velocity_of(bar, [&](const auto& at) { return exact_.at(static_cast<double>(at[0]), 0).velocity; });
        tamis::set_strain_of(bar, [&](const auto& at) { return exact_.at(static_cast<double>(at[0]), 0).strain; });
        if (!o.csv.empty())
            open("--csv", [&] {
                tables_.emplace(lattice, functions, tamis::bodies(bar), o.csv);
                energies_.emplace(std::filesystem::path(o.csv) / "energy.csv");
            });
        if (!o.dump.empty())
            open("--dump", [&] { dump_.emplace(lattice, functions, solver_.crossings, tamis::bodies(bar), o.dump); });
    }

    bar_result follow(std::size_t bytes_per_node, const std::function<long(const bar_observer&)>& integrate) {
        const auto begun = clock::now();
        try {
            result_.steps = integrate(std::ref(*this));
        } catch (const tamis::error& e) {
            // A failed run leaves its dump, which is there to find out why.
            if (dump_) dump_->commit(std::string("the run failed: ") + e.what());
            throw;
        }
        result_.wall_seconds = std::chrono::duration<double>(clock::now() - begun - spent_).count();
        result_.dt = o_.time / static_cast<double>(result_.steps);
        result_.bytes_per_particle = bar_.bytes_per_particle();
        result_.bytes_per_node = bytes_per_node;
        result_.particles = snapshot();
        result_.mass = static_cast<double>(tamis::total_mass(std::as_const(bar_)));
        result_.momentum = static_cast<double>(tamis::total_momentum(std::as_const(bar_))[0]);
        if (tables_) tables_->commit();
        if (energies_) put_energies(*energies_);
        if (dump_) dump_->commit();
        return std::move(result_);
    }

    void operator()(const tamis::progress_state& now) {
        const bool record = now.step % every_ == 0, at_end = now.step == now.steps;
        const bool fronts = scene_.fronts && now.step > 0 && (now.step % std::max(1L, now.steps / 100) == 0 || at_end);
        if (!record && !fronts && !at_end) return;
        const auto begun = clock::now();
        if (record || at_end)
            result_.energy.push_back({now.time, static_cast<double>(tamis::kinetic_energy(std::as_const(bar_))),
                                      static_cast<double>(tamis::elastic_energy(std::as_const(bar_))),
                                      solver_.boundary_work()});
        if (record && tables_) (*tables_)(now);
        if (record && dump_) (*dump_)(now);
        if (fronts) result_.fronts.push_back(find_fronts(now.time, snapshot(), o_.amplitude));
        spent_ += clock::now() - begun;
    }

  private:
    using clock = std::chrono::steady_clock;
    Body& bar_;
    const bar_scene& scene_;
    const bar_options& o_;
    const bar_answer exact_;
    bar_questions solver_;
    long every_;
    bar_result result_;
    std::optional<tamis::csv_output<Lattice, Shape, Body>> tables_;
    std::optional<tamis::atomic_file> energies_;
    std::optional<tamis::dump_output<Lattice, Shape, Body>> dump_;
    clock::duration spent_{0};

    static void open(const char* option, const std::function<void()>& make) {
        try {
            make();
        } catch (const tamis::error& e) {
            throw bad_option(std::string(option) + ": " + e.what());
        }
    }
    std::vector<bar_particle> snapshot() const {
        using namespace tamis::symbols;
        std::vector<bar_particle> all;
        for (const auto p : std::as_const(bar_))
            all.push_back({static_cast<double>(p[x][0]), static_cast<double>(p[v][0]),
                           static_cast<double>(p[sigma](0, 0)) / bar_scene::young});
        std::sort(all.begin(), all.end(), [](const auto& one, const auto& other) { return one.x < other.x; });
        return all;
    }
    void put_energies(tamis::atomic_file& file) const {
        file.out() << "time,kinetic,elastic,total,boundary_work,exact\n";
        for (const auto& e : result_.energy)
            file.out() << e.t << ',' << e.kinetic << ',' << e.elastic << ',' << e.total() << ',' << e.boundary_work
                       << ',' << exact_.energy(e.t) << '\n';
        file.commit();
    }
};
