#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>
#if defined(__unix__) || defined(__APPLE__)
#include <sys/mman.h>
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

/// Whether so many bytes are taken from the system as pages of their own: such come zeroed, take no memory before they
/// are written, and go back when they are given back. In the heap of glibc large vectors that come and go, each of
/// another size, would leave holes, and it would grow for ever.
inline bool takes_pages([[maybe_unused]] std::size_t bytes) {
#if defined(MAP_ANONYMOUS)
    return bytes > (std::size_t(1) << 20);
#else
    return false;
#endif
}
/// Throws std::bad_alloc if there is no such range of addresses.
inline void* take_pages([[maybe_unused]] std::size_t bytes) {
#if defined(MAP_ANONYMOUS)
#if defined(MAP_NORESERVE)
    constexpr int flags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
#else
    constexpr int flags = MAP_PRIVATE | MAP_ANONYMOUS;
#endif
    void* const pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, flags, -1, 0);
    if (pages != MAP_FAILED) return pages;
#endif
    throw std::bad_alloc();
}
inline void give_pages_back([[maybe_unused]] void* pages, [[maybe_unused]] std::size_t bytes) noexcept {
#if defined(MAP_ANONYMOUS)
    munmap(pages, bytes);
#endif
}
/// Asks for large pages, for what is used densely: a processor keeps the places of few pages, and to look one up takes
/// long, most of all on a virtual machine.
inline void ask_for_large_pages([[maybe_unused]] void* pages, [[maybe_unused]] std::size_t bytes) {
#if defined(MADV_HUGEPAGE)
    // Whether they are given or not, the memory is there.
    static_cast<void>(madvise(pages, bytes, MADV_HUGEPAGE));
#endif
}

/// Vectors aligned to cache lines, by plain allocations or by pages: aligned allocations leave holes in the heap of
/// glibc before 2.38.
template <class T> struct aligned_allocator {
    using value_type = T;
    static constexpr std::size_t alignment = 64;
    aligned_allocator() = default;
    template <class U> aligned_allocator(const aligned_allocator<U>&) {}
    T* allocate(std::size_t count) {
        if (count > (std::numeric_limits<std::size_t>::max() / 2 - alignment) / sizeof(T)) throw std::bad_alloc();
        if (takes_pages(count * sizeof(T))) {
            void* const pages = take_pages(count * sizeof(T));
            ask_for_large_pages(pages, count * sizeof(T));
            return static_cast<T*>(pages);
        }
        char* const all = static_cast<char*>(::operator new(count * sizeof(T) + alignment));
        const std::size_t to_next = alignment - reinterpret_cast<std::uintptr_t>(all) % alignment;
        char* const first = all + to_next;
        first[-1] = static_cast<char>(to_next);
        return reinterpret_cast<T*>(first);
    }
    void deallocate(T* from, std::size_t count) noexcept {
        if (takes_pages(count * sizeof(T))) return give_pages_back(from, count * sizeof(T));
        char* const first = reinterpret_cast<char*>(from);
        ::operator delete(first - first[-1]);
    }
    /// What a vector makes without a value is left as it is: threads write it first, and so spread its memory.
    template <class U> void construct(U* at) { ::new (static_cast<void*>(at)) U; }
    template <class U> bool operator==(const aligned_allocator<U>&) const { return true; }
};

/// A vector whose copies have its room too: they grow without being moved for as long as it does.
template <class T> class roomy_vector : public std::vector<T, aligned_allocator<T>> {
    using base = std::vector<T, aligned_allocator<T>>;

  public:
    roomy_vector() = default;
    roomy_vector(const roomy_vector& from) : base() {
        base::reserve(from.capacity());
        base::assign(from.begin(), from.end());
    }
    roomy_vector(roomy_vector&&) noexcept = default;
    roomy_vector& operator=(roomy_vector from) noexcept {
        base::swap(from);
        return *this;
    }
    ~roomy_vector() = default;
};

/// Numbers that start as zero and, where there are many, take memory only where they are written: a page at a time.
/// Numbers that are more than their bytes take it at once. Throws std::bad_alloc if there is no such range of
/// addresses.
template <class T> class zeros {
  public:
    zeros() = default;
    explicit zeros(std::size_t count) : size_(count), data_(allocate(count)) {}
    zeros(const zeros& from) : zeros(from.size_) {
        if constexpr (std::is_trivially_copyable_v<T>) {
            // A page of zeros is not written, so that it takes no memory here either.
            constexpr std::size_t page = 4096;
            const auto* const bytes = reinterpret_cast<const unsigned char*>(from.data_);
            auto* const to = reinterpret_cast<unsigned char*>(data_);
            for (std::size_t k = 0; k < size_ * sizeof(T); k += page) {
                const std::size_t n = std::min(page, size_ * sizeof(T) - k);
                if (std::any_of(bytes + k, bytes + k + n, [](unsigned char a) { return a != 0; }))
                    std::memcpy(to + k, bytes + k, n);
            }
        } else
            std::copy_n(from.data_, size_, data_);
    }
    zeros(zeros&& from) noexcept { swap(from); }
    zeros& operator=(zeros from) noexcept {
        swap(from);
        return *this;
    }
    ~zeros() { release(); }

    std::size_t size() const { return size_; }
    T* data() { return data_; }
    const T* data() const { return data_; }
    T& operator[](std::size_t k) { return data_[k]; }
    const T& operator[](std::size_t k) const { return data_[k]; }

  private:
    std::size_t size_ = 0;
    T* data_ = nullptr;

    void swap(zeros& other) noexcept {
        std::swap(size_, other.size_);
        std::swap(data_, other.data_);
    }
    static bool is_mapped(std::size_t count) {
        return std::is_trivially_copyable_v<T> && count <= most && takes_pages(count * sizeof(T));
    }
    static constexpr std::size_t most = std::numeric_limits<std::size_t>::max() / 2 / sizeof(T);
    static T* allocate(std::size_t count) {
        if (is_mapped(count)) return static_cast<T*>(take_pages(count * sizeof(T)));
        T* const found = aligned_allocator<T>().allocate(count);
        std::uninitialized_fill_n(found, count, T(0));
        return found;
    }
    void release() noexcept {
        if (!data_) return;
        if (is_mapped(size_)) return give_pages_back(data_, size_ * sizeof(T));
        std::destroy_n(data_, size_);
        aligned_allocator<T>().deallocate(data_, size_);
    }
};

}  // namespace tamis::detail
