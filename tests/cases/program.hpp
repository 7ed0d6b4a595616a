#pragma once
#include "scratch.hpp"

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>
#include <sys/wait.h>

/// What a program did.
struct program_run {
    int code;
    std::string out, err;
};
/// Runs one of the examples, `TAMIS_PROGRAMS/name`, with the rest of the command line. Its output goes through the
/// folder.
inline program_run run_program(const scratch_folder& folder, const std::string& name,
                               const std::string& arguments = "") {
    const auto out = folder / "stdout.text", err = folder / "stderr.text";
    std::ostringstream words;  // sums of strings make GCC 12 warn of bounds that are kept (bug 105651)
    words << '"' << TAMIS_PROGRAMS << '/' << name << "\" " << arguments << " > \"" << out.string() << "\" 2> \""
          << err.string() << '"';
    const std::string command = words.str();
    const int status = std::system(command.c_str());
    program_run run{WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(err)};
    std::filesystem::remove(out);
    std::filesystem::remove(err);
    return run;
}
