// A vector whose new elements are left unset, for megabytes that are overwritten at once: setting them to
// zero first would take about as long as reading them from a file in memory.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace patina {

template <class T>
struct LeaveUnset : std::allocator<T> {
    static_assert(std::is_trivially_default_constructible_v<T>);
    template <class U>
    struct rebind {  // NOLINT(readability-identifier-naming): the standard library's name
        using other = LeaveUnset<U>;
    };
    template <class U>
    void construct(U* at) noexcept {
        ::new (static_cast<void*>(at)) U;
    }
    template <class U, class... Arguments>
    void construct(U* at, Arguments&&... arguments) {
        ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
    }
};

template <class T>
using UnsetVector = std::vector<T, LeaveUnset<T>>;

}  // namespace patina
