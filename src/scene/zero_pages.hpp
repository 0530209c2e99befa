#pragma once
// Large arrays of zeros. Fresh memory of the kernel's is zero without being written: a page comes when it is first touched, so
// the threads that fill a picture share that work instead of waiting for it.

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace lanecast {

/// An allocator that leaves elements without a value as they are: as zeros, if the vector has never been longer.
template <class T>
struct ZeroPages {
    static_assert(std::is_arithmetic_v<T>);
    using value_type = T;

    ZeroPages() = default;
    template <class U>
    ZeroPages(const ZeroPages<U>&) noexcept {}

    [[nodiscard]] T* allocate(std::size_t count) {
        if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
        void* const bytes = std::calloc(count, sizeof(T));
        if (bytes == nullptr) throw std::bad_alloc();
        return static_cast<T*>(bytes);
    }
    void deallocate(T* data, std::size_t) noexcept { std::free(data); }

    template <class U>
    void construct(U*) noexcept {}
    template <class U, class... Arguments>
    void construct(U* at, Arguments&&... arguments) {
        ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
    }

    friend bool operator==(const ZeroPages&, const ZeroPages&) noexcept { return true; }
};

template <class T>
using ZeroVector = std::vector<T, ZeroPages<T>>;

} // namespace lanecast
