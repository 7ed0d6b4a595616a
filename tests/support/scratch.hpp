#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

/// A folder for one test's files, below the working folder; empty at first, gone at the end.
class scratch_folder {
  public:
    explicit scratch_folder(const std::string& name) : path_(std::filesystem::path("scratch") / name) {
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    scratch_folder(const scratch_folder&) = delete;
    scratch_folder& operator=(const scratch_folder&) = delete;
    ~scratch_folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }
    /// Names in the folder, in order.
    std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const auto& entry : std::filesystem::directory_iterator(path_))
            all.push_back(entry.path().filename().string());
        std::sort(all.begin(), all.end());
        return all;
    }

  private:
    std::filesystem::path path_;
};

inline std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}
inline std::vector<std::string> lines_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}
/// A table with a line of names: its columns.
struct table {
    std::vector<std::string> names;
    std::vector<std::vector<double>> rows;

    double at(std::size_t row, const std::string& name) const {
        for (std::size_t k = 0; k < names.size(); ++k)
            if (names[k] == name) return rows.at(row).at(k);
        throw std::runtime_error("the table has no column " + name);
    }
};
inline table table_of(const std::filesystem::path& file) {
    table all;
    const auto lines = lines_of(file);
    for (std::size_t k = 0; k < lines.size(); ++k) {
        std::istringstream in(lines[k]);
        if (k > 0) all.rows.emplace_back();
        for (std::string cell; std::getline(in, cell, ',');) {
            if (k == 0)
                all.names.push_back(cell);
            else
                all.rows.back().push_back(std::stod(cell));
        }
    }
    return all;
}
