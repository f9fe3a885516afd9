// SPDX-License-Identifier: Apache-2.0
/// Memory for the few arrays that hold most of a large file.
#pragma once

#include <cstddef>

namespace gltfx {

/// `bytes` of memory, not cleared; many bytes on huge pages where the system has them, which costs
/// a fraction of the page faults. std::bad_alloc when there is not enough, as operator new.
void* allocate_pages(std::size_t bytes);
/// `bytes` as passed to allocate_pages().
void free_pages(void* memory, std::size_t bytes) noexcept;

/// The same for standard containers.
template <typename T>
struct PageAllocator {
  using value_type = T;

  PageAllocator() = default;
  template <typename U>
  PageAllocator(const PageAllocator<U>&) noexcept {}

  /// Containers request less than PTRDIFF_MAX bytes.
  T* allocate(std::size_t count) { return static_cast<T*>(allocate_pages(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t count) noexcept { free_pages(memory, count * sizeof(T)); }

  bool operator==(const PageAllocator&) const { return true; }
};

/// Returns freed memory to the system, between two tasks that need much memory.
void give_back_memory() noexcept;

}  // namespace gltfx
