#pragma once
#include <tamis/core/error.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

namespace tamis {

/// A text file that appears whole or not at all: it is written under another name beside its place, and takes its own
/// at `commit`. Without it the text is thrown away. Throws `error` where the file cannot be written.
class atomic_file {
  public:
    explicit atomic_file(std::filesystem::path path) : path_(std::move(path)), draft_(path_.string() + ".part") {
        std::error_code failed;
        if (std::filesystem::is_directory(path_, failed))
            throw error(detail::sentence("cannot write ", path_.string(), ": it is a folder; give the name of a file"));
        // A device or a pipe would be replaced by a file of its name.
        if (std::filesystem::exists(path_, failed) && !std::filesystem::is_regular_file(path_, failed))
            throw error(detail::sentence("cannot write ", path_.string(),
                                         ": it is no regular file; give the name of a file, or of none that exists"));
        if (path_.has_parent_path()) {
            std::filesystem::create_directories(path_.parent_path(), failed);
        }
        out_.open(draft_);
        if (!out_)
            throw error(detail::sentence("cannot write ", draft_.string(),
                                         "; check that its folder exists and may be written to"));
        out_.precision(std::numeric_limits<double>::max_digits10);
    }
    atomic_file(atomic_file&& other) noexcept
        : path_(std::move(other.path_)),
          draft_(std::move(other.draft_)),
          out_(std::move(other.out_)),
          open_(std::exchange(other.open_, false)) {}
    atomic_file& operator=(atomic_file&&) = delete;
    ~atomic_file() {
        if (!open_) return;
        if (out_.is_open()) out_.close();
        std::error_code ignored;
        std::filesystem::remove(draft_, ignored);
    }

    const std::filesystem::path& path() const { return path_; }
    std::ostream& out() { return out_; }
    /// Ends the text; the file waits for its commit. Many may wait, few can be open.
    void close() {
        if (out_.is_open()) out_.close();
        if (out_) return;
        open_ = false;
        std::error_code ignored;
        std::filesystem::remove(draft_, ignored);
        throw error(detail::sentence("writing ", path_.string(), " failed; is the disk full?"));
    }
    void commit() {
        close();
        open_ = false;
        std::error_code failed;
        std::filesystem::rename(draft_, path_, failed);
        if (failed) {
            const std::string why = failed.message();
            std::filesystem::remove(draft_, failed);
            throw error(detail::sentence("cannot put ", path_.string(), " in place: ", why));
        }
    }

  private:
    std::filesystem::path path_, draft_;
    std::ofstream out_;
    bool open_ = true;
};

}  // namespace tamis
