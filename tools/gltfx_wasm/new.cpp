// SPDX-License-Identifier: Apache-2.0
// Keeps some small blocks of memory for reuse: a validation allocates and frees a hundred, for
// which malloc() takes a tenth of the time.
#include <array>
#include <cstddef>
#include <cstdlib>
#include <new>

#include <malloc.h>

namespace {

constexpr std::size_t kStep = 16;

struct Block {
  Block* next;
};

// Blocks of at least so many steps.
struct BlockList {
  static constexpr unsigned kMost = 64;
  Block* first;
  unsigned count;
};

std::array<BlockList, 33> lists;

}  // namespace

void* operator new(std::size_t size) {
  const std::size_t steps = size == 0 ? 1 : (size + kStep - 1) / kStep;
  if (steps < lists.size()) {
    BlockList& list = lists[steps];
    if (Block* const block = list.first; block != nullptr) {
      list.first = block->next;
      --list.count;
      return block;
    }
    size = steps * kStep;
  }
  while (true) {
    if (void* const memory = std::malloc(size)) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* memory) noexcept {
  if (memory == nullptr) return;
  const std::size_t steps = malloc_usable_size(memory) / kStep;
  if (steps < lists.size() && lists[steps].count < BlockList::kMost) {
    BlockList& list = lists[steps];
    list.first = ::new (memory) Block{list.first};
    ++list.count;
    return;
  }
  std::free(memory);
}
