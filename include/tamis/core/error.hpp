#pragma once
#include <tamis/core/config.hpp>

#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace tamis {

/// What the library throws: a sentence that names what is wrong, where, and what to do.
class error : public std::runtime_error {
  public:
    /// Of a sentence, which `what()` gives.
    using std::runtime_error::runtime_error;
};

namespace detail {

/// Where a sentence is put together. There are many sentences: what they have in common is compiled once.
class sentence_text {
  public:
    TAMIS_SELDOM sentence_text() { text_.precision(9); }
    TAMIS_SELDOM ~sentence_text() = default;
    TAMIS_SELDOM void add(const char* part) { text_ << part; }
    template <class Part> TAMIS_SELDOM void add(const Part& part) { text_ << part; }
    TAMIS_SELDOM std::string made() const { return text_.str(); }

  private:
    std::ostringstream text_;
};

/// Text put together from parts, numbers in their shortest form that tells neighbours apart in a message.
template <class... Parts> TAMIS_SELDOM std::string sentence(const Parts&... parts) {
    sentence_text text;
    (text.add(parts), ...);
    return text.made();
}

/// The components of a vector, "1, 2.5, 0", for messages.
template <class Vector> TAMIS_SELDOM std::string list_of(const Vector& vector) {
    sentence_text text;
    for (int d = 0; d < static_cast<int>(vector.size()); ++d) {
        if (d > 0) text.add(", ");
        text.add(vector[d]);
    }
    return text.made();
}

}  // namespace detail
}  // namespace tamis
