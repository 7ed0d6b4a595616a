#include "provenance.hpp"

#include <ctime>
#include <fstream>
#include <thread>

namespace {

std::string processor() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.rfind("model name", 0) == 0) {
            const std::size_t colon = line.find(':');
            if (colon != std::string::npos) return line.substr(line.find_first_not_of(' ', colon + 1));
        }
    return "unknown";
}
std::string vectors() {
#if defined(__AVX512F__)
    return "AVX-512";
#elif defined(__AVX2__)
    return "AVX2";
#else
    return "the processor's oldest vectors";
#endif
}
std::string compiler() {
#if defined(__clang__)
    return "clang " __clang_version__;
#elif defined(__GNUC__)
    return "g++ " __VERSION__;
#else
    return "unknown";
#endif
}

}  // namespace

std::vector<std::vector<std::string>> provenance(const std::string& command) {
    char day[40];
    const std::time_t now = std::time(nullptr);
    std::strftime(day, sizeof day, "%Y-%m-%d %H:%M UTC", std::gmtime(&now));
    return {{"command", "`" + command + "`"},
            {"date", day},
            {"processor", processor() + ", " + std::to_string(std::thread::hardware_concurrency()) +
                              " cores, compiled for " + vectors()},
            {"compiler", compiler()}};
}
