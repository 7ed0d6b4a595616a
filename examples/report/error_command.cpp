#include "error_command.hpp"

#include "analysis.hpp"
#include "error_page.hpp"
#include "provenance.hpp"

#include <tamis/core/error.hpp>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <map>
#include <memory>
#include <unistd.h>

namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

/// Ctrl-C lets the run at hand end; a second one ends the program at once.
class interrupts {
  public:
    interrupts() {
        interrupted = false;
        std::signal(SIGINT, [](int) {
            interrupted = true;
            std::signal(SIGINT, SIG_DFL);
        });
    }
    interrupts(const interrupts&) = delete;
    ~interrupts() { std::signal(SIGINT, SIG_DFL); }
};

std::string duration(double seconds) {
    const long all = std::lround(seconds);
    char text[64];
    if (all >= 3600)
        std::snprintf(text, sizeof text, "%ld h %02ld min", all / 3600, all / 60 % 60);
    else if (all >= 60)
        std::snprintf(text, sizeof text, "%ld min %02ld s", all / 60, all % 60);
    else
        std::snprintf(text, sizeof text, "%ld s", all);
    return text;
}

struct error_options {
    bool quick = false, full = false, resume = false;
    std::string program, out;
    std::vector<std::string> only;
};

std::string command_of(const error_options& o) {
    std::string command = o.program + " error --" + (o.full ? "full" : "quick");
    for (const auto& name : o.only) command += " --scene " + name;
    return command + " --out DIR";
}

int report_errors(const error_options& o, std::vector<report_scene> scenes) {
    if (!o.only.empty()) {
        std::vector<report_scene> chosen;
        for (const auto& name : o.only) {
            std::string known;
            bool found = false;
            for (const auto& scene : scenes) {
                known += (known.empty() ? "" : ", ") + scene.name;
                if (scene.name != name) continue;
                chosen.push_back(scene);
                found = true;
            }
            if (!found) throw tamis::error("--scene: '" + name + "' is unknown; there are " + known);
        }
        scenes = chosen;
    }
    if (!has_gnuplot())
        throw tamis::error(
            "gnuplot draws the pictures of the report and is not installed; install it (Debian, Ubuntu: "
            "gnuplot-nox)");
    const std::filesystem::path folder = o.out, page_file = folder / "error.html";
    const auto facts = provenance(command_of(o));
    const interrupts listening;
    // Times of another processor or compiler must not be mixed with these.
    results_file results(folder / "errors.csv", facts.at(2).at(1) + ", " + facts.at(3).at(1), o.resume);

    const bool terminal = isatty(STDERR_FILENO) != 0;
    double told = 0;
    const auto tell = [&](std::size_t done, std::size_t all, double left, const configuration& what) {
        // A log gets a line in ten seconds, a terminal five in one.
        if (done > 0 && now() - told < (terminal ? 0.2 : 10)) return;
        told = now();
        std::fprintf(stderr, "%s%zu of %zu runs, %s%s %s, %d cells%s", terminal ? "\r" : "", done, all,
                     left < 0 ? "" : (duration(left) + " left: ").c_str(), what.scene.c_str(), what.shape.c_str(),
                     what.cells, terminal ? "\033[K" : "\n");
    };
    const bool complete = run_all(scenes, o.full, results, interrupted, tell);
    if (terminal) std::fprintf(stderr, "\r\033[K");
    error_page(scenes, results.runs(), facts, complete).write(page_file);
    std::printf("%zu runs are in %s, the report is %s\n", results.runs().size(), results.path().c_str(),
                page_file.c_str());
    if (complete) return 0;
    std::printf("It was interrupted and is not complete; --resume goes on.\n");
    return 130;
}

/// How long the runs that are left will take: by the time that the same scene's runs took for their work; of scenes not
/// begun by the mean of all.
class remaining_time {
  public:
    void add(const std::string& scene, double work) { scenes_[scene].left += work; }
    void took(const std::string& scene, double work, double seconds) {
        for (auto* one : {&scenes_[scene], &all_}) {
            one->done += work;
            one->seconds += seconds;
        }
    }
    /// Negative: nothing is known yet.
    double seconds() const {
        if (!(all_.done > 0)) return -1;
        double sum = 0;
        for (const auto& [name, one] : scenes_) {
            const part& rate = one.done > 0 ? one : all_;
            sum += one.left * rate.seconds / rate.done;
        }
        return sum;
    }

  private:
    struct part {
        double left = 0, done = 0, seconds = 0;
    };
    std::map<std::string, part> scenes_;
    part all_;
};

}  // namespace

measurement measure(const report_scene& scene, const configuration& what, const std::atomic<bool>& stop) {
    measurement all;
    all.what = what;
    std::vector<double> seconds;
    double total = 0;
    try {
        // Three times, runs of seconds twice, and short ones until they add up to something that a clock can tell; once
        // if it is to stop, for the runs of the finest grids take minutes.
        while (seconds.empty() || (!stop && (seconds.size() < 2 || (seconds.size() < 3 && total < 2) ||
                                             (total < 0.01 && seconds.size() < 5)))) {
            all.found = scene.run(what);
            seconds.push_back(all.found.seconds);
            total += all.found.seconds;
        }
    } catch (const std::exception& e) {
        all.failure = e.what();
        return all;
    }
    all.repeats = static_cast<int>(seconds.size());
    all.found.seconds = median(seconds);
    all.seconds_least = *std::min_element(seconds.begin(), seconds.end());
    all.seconds_most = *std::max_element(seconds.begin(), seconds.end());
    if (!std::isfinite(all.found.error)) all.failure = "the error is not a number";
    return all;
}

bool run_all(const std::vector<report_scene>& scenes, bool full, results_file& results, const std::atomic<bool>& stop,
             const std::function<void(std::size_t, std::size_t, double, const configuration&)>& tell) {
    struct job {
        const report_scene* scene;
        const configuration* what;
    };
    std::vector<job> jobs;
    std::size_t all = 0;
    remaining_time left;
    for (const report_scene& scene : scenes)
        for (const configuration& what : full ? scene.full : scene.quick) {
            ++all;
            if (results.has(what)) continue;
            jobs.push_back({&scene, &what});
            left.add(scene.name, work_of(scene, what));
        }
    // Of a resumed report the runs of before tell how long others take.
    for (const report_scene& scene : scenes)
        for (const measurement& run : results.runs())
            if (run.what.scene == scene.name && run.has_answer())
                left.took(scene.name, work_of(scene, run.what), run.found.seconds * run.repeats);
    std::size_t done = all - jobs.size();
    for (const job& next : jobs) {
        if (stop) break;
        tell(done, all, left.seconds(), *next.what);
        const double begun = now();
        results.add(measure(*next.scene, *next.what, stop));
        left.took(next.scene->name, work_of(*next.scene, *next.what), now() - begun);
        left.add(next.scene->name, -work_of(*next.scene, *next.what));
        ++done;
    }
    results.save();
    return done == all;
}

void add_error_command(CLI::App& app, int& exit_code, std::vector<report_scene> (*scenes)()) {
    auto* command = app.add_subcommand("error", "Error against run time of scenes with an exact answer");
    const auto o = std::make_shared<error_options>();
    o->program = app.get_name();
    auto* quick =
        command->add_flag("--quick", o->quick, "Some compositions of each scene, a minute or two (the default)");
    command->add_flag("--full", o->full, "Many more compositions and resolutions")->excludes(quick);
    command->add_option("--out", o->out, "Folder for errors.csv and error.html")->required();
    command->add_flag("--resume", o->resume, "Go on with the runs of an interrupted report in that folder");
    command->add_option("--scene", o->only, "Only this scene; may be given several times");
    command->callback([o, scenes, &exit_code] {
        try {
            exit_code = report_errors(*o, scenes());
        } catch (const std::exception& e) {
            std::fprintf(stderr, "%s error: %s\n", o->program.c_str(), e.what());
            exit_code = 1;
        }
    });
}
