#pragma once
#include <tamis/core/error.hpp>

#include <algorithm>
#include <initializer_list>
#include <string>

/// An option that cannot be used: the program exits with code 2.
class unusable_option : public tamis::error {
  public:
    using tamis::error::error;
};

/// Throws `unusable_option` unless the name that an option was given is one of those it may have.
inline void require_name(const std::string& option, const std::string& given,
                         std::initializer_list<const char*> names) {
    if (std::any_of(names.begin(), names.end(), [&](const char* name) { return given == name; })) return;
    std::string list;
    for (const char* name : names) list.append(list.empty() ? "" : ", ").append(name);
    throw unusable_option(option + ": '" + given + "' is unknown; give one of " + list);
}
