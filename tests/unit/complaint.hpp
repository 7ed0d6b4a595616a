#pragma once
#include <tamis/core/error.hpp>

#include <string>
#include <string_view>

/// What the error that f() throws says; "nothing" if it throws none.
template <class F> std::string complaint(F&& f) {
    try {
        f();
    } catch (const tamis::error& e) {
        return e.what();
    }
    return "nothing";
}

/// Does the text name all of these?
template <class... Part> bool names(const std::string& text, const Part&... part) {
    return ((text.find(std::string_view(part)) != std::string::npos) && ...);
}
