// SPDX-License-Identifier: Apache-2.0
// A list that only grows and whose entries are reused, so that it can be read at any time, also in
// a signal handler.
#include "container/mapped_files.hpp"

#include <gltfx/mapping.hpp>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <mutex>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

#include "base/fork.hpp"

namespace gltfx {
namespace container {

struct Mapping {
  std::atomic<std::uintptr_t> begin{0};  ///< 0: free
  std::atomic<std::uintptr_t> end{0};
  std::atomic<bool> truncated{false};
  std::atomic<std::size_t> read{0};  ///< bytes since its pages were released
  Mapping* next = nullptr;           ///< set before it is listed, never changed

  bool holds(std::uintptr_t address) const {
    return begin != 0 && begin <= address && address < end;
  }
};
static_assert(std::atomic<std::uintptr_t>::is_always_lock_free);

namespace {

constexpr std::size_t kMostResident = std::size_t{16} << 20U;

std::atomic<Mapping*>& first_mapping() {
  static constinit std::atomic<Mapping*> first{nullptr};
  return first;
}

Mapping* find(std::uintptr_t address) {
  Mapping* at = first_mapping();
  while (at != nullptr && !at->holds(address)) at = at->next;
  return at;
}

/// Entries of the list without a mapping. Never destroyed: mappings may be freed last.
struct FreeEntries {
  ForkMutex mutex;
  std::vector<Mapping*> entries;
  std::size_t listed = 0;  ///< all entries; `entries` has room for them
};

FreeEntries& free_entries() {
  static auto* const kept = new FreeEntries;
  return *kept;
}
[[maybe_unused]] FreeEntries& made_when_loaded = free_entries();

Mapping* take_entry() {
  FreeEntries& free = free_entries();
  const std::lock_guard lock(free.mutex);
  if (!free.entries.empty()) {
    Mapping* const entry = free.entries.back();
    free.entries.pop_back();
    return entry;
  }
  if (free.entries.capacity() <= free.listed) free.entries.reserve(2 * free.listed + 16);
  auto* const fresh = new Mapping;  // stays listed until the process ends
  ++free.listed;
  fresh->next = first_mapping();
  first_mapping() = fresh;
  return fresh;
}

/// Unmaps a mapping with its last owner.
struct Unmap {
  Mapping* mapping;
  std::size_t length;

  void operator()(const void* mapped) const noexcept {
    mapping->begin = 0;
    ::munmap(const_cast<void*>(mapped), length);
    FreeEntries& free = free_entries();
    const std::lock_guard lock(free.mutex);
    free.entries.push_back(mapping);
  }
};

Mapping* mapping_of(const Bytes& bytes) {
  const auto* const unmap = std::get_deleter<Unmap>(bytes.owner());
  return unmap == nullptr ? nullptr : unmap->mapping;
}

std::uintptr_t address_of(const void* memory) { return reinterpret_cast<std::uintptr_t>(memory); }

}  // namespace

std::shared_ptr<const void> own_mapping(void* start, std::size_t length) {
  Mapping* const mapping = take_entry();
  mapping->truncated = false;
  mapping->read = 0;
  mapping->end = address_of(start) + length;
  mapping->begin = address_of(start);
  return {start, Unmap{mapping, length}};
}

bool is_truncated(const Bytes& bytes) {
  const Mapping* const mapping = mapping_of(bytes);
  return mapping != nullptr && mapping->truncated;
}

ReadMeter::ReadMeter(const Bytes& bytes) : mapping_(mapping_of(bytes)) {}

// The mapping is read-only: its pages can be read again.
void ReadMeter::add(std::size_t bytes) const {
  if (mapping_ == nullptr || mapping_->read.fetch_add(bytes) + bytes < kMostResident) return;
  mapping_->read = 0;
  const std::uintptr_t begin = mapping_->begin;
  // NOLINTNEXTLINE(performance-no-int-to-ptr): a number, so that a signal handler may read it
  ::madvise(reinterpret_cast<void*>(begin), mapping_->end - begin, MADV_DONTNEED);
}

}  // namespace container

bool repair_mapping(const void* address) noexcept {
  const int error = errno;
  const std::uintptr_t fault = container::address_of(address);
  container::Mapping* const mapping = container::find(fault);
  if (mapping == nullptr) return false;
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const std::uintptr_t into_page = fault % page;
  void* const begin = const_cast<char*>(static_cast<const char*>(address) - into_page);
  mapping->truncated = true;
  void* const rest = ::mmap(begin, mapping->end - (fault - into_page), PROT_READ,
                            MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0);
  errno = error;
  return rest != MAP_FAILED;
}

}  // namespace gltfx
