#pragma once
#include <tamis/core/error.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace tamis {

/// A file that appears whole or not at all: it is written under another name beside its place, and takes its own
/// at `commit`. Without it what was written is thrown away. Throws `error` where the file cannot be written.
class atomic_file {
  public:
    /// Opens the draft, in a folder that is made if need be.
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
        out_.open(draft_, std::ios::binary);
        if (!out_)
            throw error(detail::sentence("cannot write ", draft_.string(),
                                         "; check that its folder exists and may be written to"));
        out_.precision(std::numeric_limits<double>::max_digits10);
    }
    /// The other one is left without a file.
    atomic_file(atomic_file&& other) noexcept
        : path_(std::move(other.path_)),
          draft_(std::move(other.draft_)),
          out_(std::move(other.out_)),
          open_(std::exchange(other.open_, false)) {}
    atomic_file& operator=(atomic_file&&) = delete;
    /// Throws away what was not committed.
    ~atomic_file() {
        if (!open_) return;
        if (out_.is_open()) out_.close();
        std::error_code ignored;
        std::filesystem::remove(draft_, ignored);
    }

    /// Where the file will be.
    const std::filesystem::path& path() const { return path_; }
    /// Where to write.
    std::ostream& out() { return out_; }
    /// Ends the writing; the file waits for its commit. Many may wait, few can be open.
    void close() {
        if (out_.is_open()) out_.close();
        if (out_) return;
        open_ = false;
        std::error_code ignored;
        std::filesystem::remove(draft_, ignored);
        throw error(detail::sentence("writing ", path_.string(), " failed; is the disk full?"));
    }
    /// Puts the file in place.
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

    friend void commit_together(const std::vector<atomic_file*>& files);

  private:
    std::filesystem::path path_, draft_;
    std::ofstream out_;
    bool open_ = true;
};

/// Commits all of some files or, if one of them cannot take its place, none: it throws `error` then, files of before
/// are where they were, and the new ones wait on for a commit.
inline void commit_together(const std::vector<atomic_file*>& files) {
    for (atomic_file* file : files) file->close();
    const auto aside = [](const atomic_file& file) { return std::filesystem::path(file.path_.string() + ".before"); };
    std::error_code failed, ignored;
    std::vector<bool> had(files.size());
    std::size_t done = 0;
    for (; done < files.size() && !failed; ++done) {
        atomic_file& file = *files[done];
        had[done] = std::filesystem::is_regular_file(file.path_, ignored);
        if (had[done]) std::filesystem::rename(file.path_, aside(file), failed);
        if (failed) break;
        std::filesystem::rename(file.draft_, file.path_, failed);
        if (failed && had[done]) std::filesystem::rename(aside(file), file.path_, ignored);
        if (failed) break;
    }
    if (failed) {
        const std::string path = files[done]->path_.string();
        while (done-- > 0) {
            atomic_file& file = *files[done];
            std::filesystem::rename(file.path_, file.draft_, ignored);
            if (had[done]) std::filesystem::rename(aside(file), file.path_, ignored);
        }
        throw error(detail::sentence("cannot put ", path, " in place: ", failed.message(),
                                     "; none of the files that belong together is"));
    }
    for (std::size_t k = 0; k < files.size(); ++k) {
        files[k]->open_ = false;
        if (had[k]) std::filesystem::remove(aside(*files[k]), ignored);
    }
}

}  // namespace tamis
