#pragma once
// Arrays that may be larger than the memory at hand: beyond a size they live in a file without a
// name, of whose pages only those just touched need be in memory.

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <type_traits>

namespace vlf {

/// Where arrays go that are larger than `largest` bytes.
struct ScratchPlace {
    std::string folder;
    std::size_t largest = 0;
};

/// Zeroed memory that is a new file in `folder`, whose room on the disk is reserved. Throws
/// FileError if there is none.
void* mapScratch(const std::string& folder, std::size_t bytes);
void unmapScratch(void* memory, std::size_t bytes) noexcept;

/// Lets go of the pages of mapScratch that lie within. Their content is kept, in the file.
void releaseScratch(const void* begin, std::size_t bytes) noexcept;

/// Of vectors of trivial types. With a place, what a vector is resized to is zero only as long as
/// it has not held more before.
template <class T>
class ScratchAllocator {
  public:
    static_assert(std::is_trivially_copyable_v<T>);
    using value_type = T;
    using propagate_on_container_copy_assignment = std::true_type;
    using propagate_on_container_move_assignment = std::true_type;
    using propagate_on_container_swap = std::true_type;
    using is_always_equal = std::false_type;

    /// All in memory.
    ScratchAllocator() = default;
    explicit ScratchAllocator(ScratchPlace place)
        : place_(std::make_shared<const ScratchPlace>(std::move(place))) {}
    template <class U>
    ScratchAllocator(const ScratchAllocator<U>& other) : place_(other.place()) {}

    T* allocate(std::size_t n) {
        const std::size_t bytes = n * sizeof(T);
        void* memory = isMapped(n) ? mapScratch(place_->folder, bytes) : std::calloc(n, sizeof(T));
        if (!memory) throw std::bad_alloc();
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t n) noexcept {
        isMapped(n) ? unmapScratch(memory, n * sizeof(T)) : std::free(memory);
    }

    /// Memory of a file that nobody has written to takes no room: zeros are left as they are.
    template <class U>
    void construct(U* item) {
        if (!place_) ::new (static_cast<void*>(item)) U();
    }
    template <class U, class... Arguments>
    void construct(U* item, Arguments&&... arguments) {
        ::new (static_cast<void*>(item)) U(std::forward<Arguments>(arguments)...);
    }

    /// Of a vector with room for n items, those from `first` on are not needed for now.
    void release(std::size_t n, const T* first, std::size_t count) const noexcept {
        if (isMapped(n)) releaseScratch(first, count * sizeof(T));
    }

    const std::shared_ptr<const ScratchPlace>& place() const { return place_; }
    template <class U>
    bool operator==(const ScratchAllocator<U>& other) const {
        return place_ == other.place();
    }

  private:
    bool isMapped(std::size_t n) const { return place_ && n * sizeof(T) > place_->largest; }

    std::shared_ptr<const ScratchPlace> place_;
};

}  // namespace vlf
