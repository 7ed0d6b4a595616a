#include "account.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <stdexcept>

namespace bits {

account::account(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "w")) {
    if (file_ == nullptr) throw std::runtime_error(path + " cannot be written; give a folder that can");
}
account::~account() {
    if (file_ != nullptr) std::fclose(file_);
}
void account::line(std::string_view owner, std::string_view what, long which, std::span<const double> numbers) {
    begin(owner, what);
    std::fprintf(file_, " %ld", which);
    put(numbers);
}
void account::line(std::string_view owner, std::string_view what, const std::array<int, 3>& node,
                   std::span<const double> numbers) {
    begin(owner, what);
    std::fprintf(file_, " %d,%d,%d", node[0], node[1], node[2]);
    put(numbers);
}
void account::begin(std::string_view owner, std::string_view what) {
    std::fwrite(owner.data(), 1, owner.size(), file_);
    std::fwrite(what.data(), 1, what.size(), file_);
}
void account::put(std::span<const double> numbers) {
    for (const double value : numbers) {
        if (finite_ && !std::isfinite(value)) {
            finite_ = false;
            complain("it ends with what is not a number, which shows nothing");
        }
        std::fprintf(file_, " %a", value);
    }
    std::fputc('\n', file_);
}
void account::tell(std::string_view what, double value) { line("", what, 0, std::span(&value, 1)); }
void account::complain(const std::string& sentence) { complaints_.push_back(sentence); }
void account::close() {
    const bool failed = std::ferror(file_) != 0;
    const bool closed = std::fclose(file_) == 0;
    file_ = nullptr;
    if (failed || !closed) throw std::runtime_error(path_ + " could not be written; is the disk full?");
}

composition::composition(const char* the_name, run_type the_run) : name(the_name), run(the_run) {
    all().push_back(*this);
}
std::vector<composition>& composition::all() {
    static std::vector<composition> list;
    return list;
}

}  // namespace bits

/// bits FOLDER [PART...]: runs all compositions, or those whose names have one of the parts, and writes a file for each
/// into the folder. `bits --list` tells the names.
int main(int count, char** words) {
    auto all = bits::composition::all();
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return std::strcmp(a.name, b.name) < 0; });
    if (count == 2 && std::strcmp(words[1], "--list") == 0) {
        for (const auto& one : all) std::printf("%s\n", one.name);
        return 0;
    }
    if (count < 2) {
        std::fprintf(stderr, "usage: bits FOLDER [PART...], or bits --list\n");
        return 2;
    }
    int failed = 0, done = 0;
    try {
        std::filesystem::create_directories(words[1]);
        for (std::size_t k = 0; k < all.size(); ++k) {
            const auto& one = all[k];
            const auto named = [&](const char* part) { return std::strstr(one.name, part) != nullptr; };
            if (count > 2 && std::none_of(words + 2, words + count, named)) continue;
            if (k > 0 && std::strcmp(all[k - 1].name, one.name) == 0)
                throw std::runtime_error(std::string("two compositions are called ") + one.name);
            bits::account out(std::string(words[1]) + "/" + one.name);
            try {
                one.run(out);
            } catch (const std::exception& e) {
                out.complain(e.what());
            }
            out.close();
            std::printf("%-64s %s\n", one.name, out.remark.c_str());
            for (const auto& sentence : out.complaints()) std::printf("    %s\n", sentence.c_str());
            failed += out.complaints().empty() ? 0 : 1;
            ++done;
        }
    } catch (const std::exception& e) {
        std::fprintf(stderr, "bits: %s\n", e.what());
        return 2;
    }
    if (done == 0) {
        std::fprintf(stderr, "bits: no composition has such a name; bits --list tells them\n");
        return 2;
    }
    return failed == 0 ? 0 : 1;
}
