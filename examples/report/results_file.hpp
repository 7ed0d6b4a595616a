#pragma once
#include "measurement.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

/// A table of all runs, `errors.csv`. The file is whole at any time: it is written under another name and put in place.
class results_file {
  public:
    /// `machine`: what the run times are of. An existing table is read if `resume`, else refused. Throws `tamis::error`
    /// if it cannot be read, is of another machine or compiler, or may not be written.
    results_file(std::filesystem::path path, std::string machine, bool resume);

    const std::vector<measurement>& runs() const { return runs_; }
    bool has(const configuration& what) const { return known_.count(what.text()) > 0; }
    /// Adds a run. The file follows at most once a second, and at `save`.
    void add(const measurement& run);
    void save();
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    std::string machine_;
    std::vector<measurement> runs_;
    std::set<std::string> known_;
    double saved_ = 0;

    void read();
    void take(const measurement& run);
};
