#pragma once
#include <string>
#include <vector>

/// What a report was measured on: date, processor, compiler, library, and the command that makes it again. Names and
/// values, for `page::facts`; no name of a host or a user.
std::vector<std::vector<std::string>> provenance(const std::string& command);
