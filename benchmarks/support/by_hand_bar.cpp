#include "by_hand_bar.hpp"

#include <charconv>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "by_hand_1d.hpp"

namespace by_hand {

namespace {

/// The tables of the library's csv_output: the same columns, rows and files, every number with all its digits.
class tables {
  public:
    explicit tables(const std::filesystem::path& folder) : folder_(folder) {
        std::filesystem::create_directories(folder);
    }
    void write(const bar_1d& bar, long step) {
        const std::size_t cells = bar.cells(), slots = bar.slots();
        const double h = bar.spacing();
        mean_.assign(cells + 1, {});
        text_ = "time,position,density,velocity,stress,strain,mass\n";
        for (std::size_t c = 0; c < cells; ++c)
            for (std::size_t s = 0; s < slots; ++s) {
                const std::size_t p = bar.number(s, c);
                const double w = bar.place(p), m = bar.mass(p);
                const row r{bar.time(),
                            h * (static_cast<double>(c) + w),
                            m / bar.volume(p) / (1 + bar.strain(p)),
                            bar.velocity(p),
                            bar.stress(p),
                            bar.strain(p)};
                put(r);
                text_.back() = ',';
                put(m, '\n');
                add(mean_[c], r, m * (1 - w));
                add(mean_[c + 1], r, m * w);
            }
        save("particles", step);
        text_ = "time,position,density,velocity,stress,strain\n";
        for (std::size_t i = 0; i <= cells; ++i) {
            const double share = 1 / mean_[i].mass;
            const row& sum = mean_[i].sum;
            put({bar.time(), h * static_cast<double>(i), sum.density * share, sum.velocity * share, sum.stress * share,
                 sum.strain * share});
        }
        save("nodes", step);
    }

  private:
    struct row {
        double time, position, density, velocity, stress, strain;
    };
    struct mean {
        row sum;
        double mass;
    };
    std::filesystem::path folder_;
    std::string text_;
    std::vector<mean> mean_;

    static void add(mean& to, const row& r, double share) {
        to.mass += share;
        to.sum.density += share * r.density;
        to.sum.velocity += share * r.velocity;
        to.sum.stress += share * r.stress;
        to.sum.strain += share * r.strain;
    }
    void put(double value, char after) {
        char digits[32];
        const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
        *end = after;
        text_.append(digits, end + 1);
    }
    void put(const row& r) {
        for (const double value : {r.time, r.position, r.density, r.velocity, r.stress}) put(value, ',');
        put(r.strain, '\n');
    }
    void save(const char* what, long step) const {
        char name[64];
        std::snprintf(name, sizeof name, "%s_%09ld.csv", what, step);
        std::FILE* const file = std::fopen((folder_ / name).c_str(), "w");
        if (!file || std::fwrite(text_.data(), 1, text_.size(), file) != text_.size())
            throw std::runtime_error("cannot write " + (folder_ / name).string());
        std::fclose(file);
    }
};

}  // namespace

std::vector<double> run_bar(const bar_run& run, const std::filesystem::path& folder) {
    bar_1d bar(run.nodes, run.per_cell, run.dt, run.moving);
    if (folder.empty()) {
        for (long k = 0; k < run.steps; ++k) bar.step();
    } else {
        tables to(folder);
        to.write(bar, 0);
        for (long k = 1; k <= run.steps; ++k) {
            bar.step();
            if (k % run.record_every == 0) to.write(bar, k);
        }
    }
    std::vector<double> velocities;
    for (std::size_t c = 0; c < bar.cells(); ++c)
        for (std::size_t s = 0; s < bar.slots(); ++s) velocities.push_back(bar.velocity(bar.number(s, c)));
    return velocities;
}

}  // namespace by_hand
