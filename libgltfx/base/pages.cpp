// SPDX-License-Identifier: Apache-2.0
#include "base/pages.hpp"

#include <mutex>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "base/fork.hpp"

namespace gltfx {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20U;
constexpr std::align_val_t kAlignment{kHugePage};

#ifdef __GLIBC__
// One call at a time: in a program with another malloc(), the first call initialises glibc's, and a
// concurrent second call would find it half initialised.
ForkMutex trimming;
#endif

bool is_worth_it(std::size_t bytes) { return bytes >= 2 * kHugePage; }

}  // namespace

void* allocate_pages(std::size_t bytes) {
  if (!is_worth_it(bytes)) return ::operator new(bytes);
  void* const memory = ::operator new(bytes, kAlignment);
#ifdef MADV_HUGEPAGE
  // A hint: a system without huge pages gives small ones. The part beyond the last whole huge page
  // stays small.
  ::madvise(memory, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
  return memory;
}

void free_pages(void* memory, std::size_t bytes) noexcept {
  if (is_worth_it(bytes)) {
    ::operator delete(memory, kAlignment);
  } else {
    ::operator delete(memory);
  }
}

void give_back_memory() noexcept {
#ifdef __GLIBC__
  const std::unique_lock lock(trimming, std::try_to_lock);
  if (lock) ::malloc_trim(0);
#endif
}

}  // namespace gltfx
