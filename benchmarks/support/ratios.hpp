#pragma once
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// Nanoseconds per particle and step, and their ratio to a step of the same run: medians over repetitions, which Google
/// Benchmark interleaves, so that a machine busy with other work slows both sides.
class ratio_reporter : public benchmark::ConsoleReporter {
  public:
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
            const auto found = run.counters.find("particles");
            if (found == run.counters.end()) continue;
            // Names end in /repeats:n, which is the same for all.
            const std::string name = run.run_name.function_name;
            times_[name].push_back(run.GetAdjustedCPUTime() / found->second.value);
        }
    }
    /// The table, in the order of registration; each step beside the one it is compared with ("": none).
    void print(const std::vector<std::pair<std::string, std::string>>& steps) const {
        std::printf("%-44s %10s %8s   %s\n", "step", "ns/p/step", "ratio", "to");
        for (const auto& [name, to] : steps) {
            if (!times_.count(name)) continue;
            if (times_.count(to))
                std::printf("%-44s %10.2f %8.2f   %s\n", name.c_str(), median(name), median(name) / median(to),
                            to.c_str());
            else
                std::printf("%-44s %10.2f\n", name.c_str(), median(name));
        }
    }

  private:
    std::map<std::string, std::vector<double>> times_;
    double median(const std::string& name) const {
        std::vector<double> t = times_.at(name);
        std::nth_element(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(t.size() / 2), t.end());
        return t[t.size() / 2];
    }
};

/// Registers steps, runs them interleaved, and prints the ratios. `step` is called with nothing and does one step.
class ratio_run {
  public:
    template <class Make> void add(const std::string& name, const std::string& compared_with, Make make) {
        steps_.emplace_back(name, compared_with);
        benchmark::RegisterBenchmark(name.c_str(),
                                     [make](benchmark::State& state) {
                                         auto problem = make();
                                         problem.step();
                                         for (auto _ : state) problem.step();
                                         state.counters["particles"] = static_cast<double>(problem.particles());
                                     })
            ->Repetitions(5)
            ->MinTime(0.1)
            ->Unit(benchmark::kNanosecond);
    }
    /// One more line of the table: a step that is there beside another one.
    void compare(const std::string& name, const std::string& with) { steps_.emplace_back(name, with); }
    int run(int argc, char** argv) {
        std::vector<char*> arguments(argv, argv + argc);
        std::string interleave = "--benchmark_enable_random_interleaving=true";
        arguments.push_back(interleave.data());
        int count = static_cast<int>(arguments.size());
        benchmark::Initialize(&count, arguments.data());
        if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
        ratio_reporter reporter;
        benchmark::RunSpecifiedBenchmarks(&reporter);
        reporter.print(steps_);
        return 0;
    }

  private:
    std::vector<std::pair<std::string, std::string>> steps_;
};
