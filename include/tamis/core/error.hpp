#pragma once
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace tamis {

/// What the library throws: a sentence that names what is wrong, where, and what to do.
class error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

namespace detail {

/// Text put together from parts, numbers in their shortest form that tells neighbours apart in a message.
template <class... Parts> std::string sentence(const Parts&... parts) {
    std::ostringstream text;
    text.precision(9);
    (text << ... << parts);
    return text.str();
}

/// The components of a vector, "1, 2.5, 0", for messages.
template <class Vector> std::string list_of(const Vector& vector) {
    std::ostringstream text;
    text.precision(9);
    for (int d = 0; d < static_cast<int>(vector.size()); ++d) text << (d == 0 ? "" : ", ") << vector[d];
    return text.str();
}

}  // namespace detail
}  // namespace tamis
