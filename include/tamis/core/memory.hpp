#pragma once
#include <limits>
#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

namespace tamis::detail {

/// Bytes of memory this machine has; infinity where it does not say.
inline double memory_of_machine() {
#if defined(_SC_PHYS_PAGES) && defined(_SC_PAGESIZE)
    const double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    if (bytes > 0) return bytes;
#endif
    return std::numeric_limits<double>::infinity();
}

}  // namespace tamis::detail
