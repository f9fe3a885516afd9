// SPDX-License-Identifier: Apache-2.0
#include "base/temporary_files.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>

#include <unistd.h>

namespace gltfx {
namespace {

constexpr std::size_t kSlots = 64;
constexpr std::size_t kLongest = 4096;
constexpr std::size_t kNoSlot = kSlots;

enum State : int { free_slot, being_written, in_use };

struct Slot {
  std::atomic<int> state{free_slot};
  std::array<char, kLongest> path{};
};
static_assert(std::atomic<int>::is_always_lock_free);

std::array<Slot, kSlots> slots;

}  // namespace

TemporaryName::TemporaryName(const std::string& path) : slot_(kNoSlot) {
  if (path.size() >= kLongest) return;
  for (std::size_t i = 0; i < kSlots; ++i) {
    int expected = free_slot;
    if (!slots[i].state.compare_exchange_strong(expected, being_written)) continue;
    std::memcpy(slots[i].path.data(), path.c_str(), path.size() + 1);
    slots[i].state = in_use;
    slot_ = i;
    return;
  }
}

TemporaryName::~TemporaryName() {
  if (slot_ != kNoSlot) slots[slot_].state = free_slot;
}

void remove_temporaries() noexcept {
  const int kept = errno;
  for (const Slot& slot : slots) {
    if (slot.state == in_use) ::unlink(slot.path.data());
  }
  errno = kept;
}

}  // namespace gltfx
