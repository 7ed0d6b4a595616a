#include "results_file.hpp"

#include <tamis/core/error.hpp>
#include <tamis/observe/atomic_file.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>

namespace {

const char* const columns =
    "scene,shape,update,order,stress,boundary,particles,cells,per_cell,courant,error,error_velocity,error_other,"
    "energy_error,seconds,seconds_least,seconds_most,repeats,steps,particle_count,ns_per_particle_step,failure,machine";

/// A text that a cell of the table can hold.
std::string cell(std::string text) {
    for (char& c : text)
        if (c == ',' || c == '\n' || c == '\r') c = ';';
    return text;
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Cells of a line, told as numbers or texts, one by one.
class line_of_cells {
  public:
    line_of_cells(std::string line, const std::string& where) : where_(where) {
        std::istringstream in(line);
        for (std::string text; std::getline(in, text, ',');) cells_.push_back(text);
        const auto wanted =
            static_cast<std::size_t>(std::count(columns, columns + std::string(columns).size(), ',')) + 1;
        if (cells_.size() != wanted)
            throw tamis::error(tamis::detail::sentence(where_, " has ", cells_.size(), " cells, not ", wanted,
                                                       "; it was not written by this program: give another folder"));
    }
    std::string text() { return cells_[next_++]; }
    double number() {
        const std::string& given = cells_[next_++];
        char* end = nullptr;
        const double value = std::strtod(given.c_str(), &end);
        if (end == given.c_str() || *end != '\0')
            throw tamis::error(tamis::detail::sentence(where_, ": '", given,
                                                       "' is not a number; mend the file, or give another folder"));
        return value;
    }
    int whole() { return static_cast<int>(number()); }

  private:
    std::string where_;
    std::vector<std::string> cells_;
    std::size_t next_ = 0;
};

}  // namespace

results_file::results_file(std::filesystem::path path, std::string machine, bool resume)
    : path_(std::move(path)), machine_(cell(std::move(machine))) {
    if (std::filesystem::exists(path_)) {
        if (!resume)
            throw tamis::error("there are measurements in " + path_.string() +
                               " already; give --resume to go on with them, or another folder");
        read();
    }
    save();
}

void results_file::take(const measurement& run) {
    runs_.push_back(run);
    known_.insert(run.what.text());
}

void results_file::add(const measurement& run) {
    take(run);
    if (now() - saved_ > 1) save();
}

void results_file::save() {
    tamis::atomic_file file(path_);
    std::ostream& out = file.out();
    out.precision(9);
    out << columns << '\n';
    for (const measurement& run : runs_) {
        const configuration& w = run.what;
        const outcome& f = run.found;
        out << w.scene << ',' << w.shape << ',' << w.update << ',' << w.order << ',' << w.stress << ',' << w.boundary
            << ',' << w.particles << ',' << w.cells << ',' << w.per_cell << ',' << w.courant << ',' << f.error << ','
            << f.error_velocity << ',' << f.error_other << ',' << f.energy_error << ',' << f.seconds << ','
            << run.seconds_least << ',' << run.seconds_most << ',' << run.repeats << ',' << f.steps << ','
            << f.particle_count << ',' << (run.has_answer() ? run.ns_per_particle_step() : NAN) << ','
            << cell(run.failure) << ',' << machine_ << '\n';
    }
    file.commit();
    saved_ = now();
}

void results_file::read() {
    std::ifstream in(path_);
    std::string line;
    if (!std::getline(in, line) || line != columns)
        throw tamis::error(path_.string() + " is not a table of this program; give another folder");
    for (int number = 2; std::getline(in, line); ++number) {
        line_of_cells cells(line, tamis::detail::sentence(path_.string(), ", line ", number));
        measurement run;
        configuration& w = run.what;
        outcome& f = run.found;
        w.scene = cells.text();
        w.shape = cells.text();
        w.update = cells.text();
        w.order = cells.whole();
        w.stress = cells.text();
        w.boundary = cells.text();
        w.particles = cells.text();
        w.cells = cells.whole();
        w.per_cell = cells.whole();
        w.courant = cells.number();
        f.error = cells.number();
        f.error_velocity = cells.number();
        f.error_other = cells.number();
        f.energy_error = cells.number();
        f.seconds = cells.number();
        run.seconds_least = cells.number();
        run.seconds_most = cells.number();
        run.repeats = cells.whole();
        f.steps = static_cast<long>(cells.number());
        f.particle_count = static_cast<std::size_t>(cells.number());
        cells.number();
        run.failure = cells.text();
        const std::string machine = cells.text();
        if (machine != machine_)
            throw tamis::error(path_.string() + " was measured on '" + machine + "' and this is '" + machine_ +
                               "', whose times cannot be compared with those; give another folder");
        take(run);
    }
}
