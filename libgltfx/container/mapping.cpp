// SPDX-License-Identifier: Apache-2.0
// A list that only grows and whose entries are used again, so that it can be read at any moment, in
// a signal handler too.
#include "container/mapping.hpp"

#include <gltfx/mapping.hpp>

#include <atomic>
#include <cerrno>
#include <cstdint>

#include <sys/mman.h>
#include <unistd.h>

namespace gltfx {
namespace container {
namespace {

struct Mapping {
  std::atomic<std::uintptr_t> begin{0};  ///< 0: free
  std::atomic<std::uintptr_t> end{0};
  std::atomic<bool> torn{false};
  Mapping* next = nullptr;  ///< set before it is listed, never changed

  bool holds(std::uintptr_t address) const {
    return begin != 0 && begin <= address && address < end;
  }
};
static_assert(std::atomic<std::uintptr_t>::is_always_lock_free);

constexpr std::uintptr_t kTaken = 1;  // no address of a mapping

std::atomic<Mapping*>& first_mapping() {
  static std::atomic<Mapping*> first{nullptr};
  return first;
}

Mapping* find(std::uintptr_t address) {
  Mapping* at = first_mapping();
  while (at != nullptr && !at->holds(address)) at = at->next;
  return at;
}

Mapping* take_free() {
  for (Mapping* at = first_mapping(); at != nullptr; at = at->next) {
    std::uintptr_t free = 0;
    if (at->begin.compare_exchange_strong(free, kTaken)) return at;
  }
  auto* fresh = new Mapping;  // stays listed until the process ends
  fresh->begin = kTaken;
  fresh->next = first_mapping();
  while (!first_mapping().compare_exchange_weak(fresh->next, fresh)) {
  }
  return fresh;
}

std::uintptr_t address_of(const void* memory) { return reinterpret_cast<std::uintptr_t>(memory); }

}  // namespace

std::shared_ptr<const void> own_mapping(void* start, std::size_t length) {
  Mapping* const mapping = take_free();
  mapping->torn = false;
  mapping->end = address_of(start) + length;
  mapping->begin = address_of(start);
  return {start, [mapping, length](const void* mapped) {
            mapping->begin = 0;
            ::munmap(const_cast<void*>(mapped), length);
          }};
}

bool is_torn(const Bytes& bytes) {
  const Mapping* const mapping = find(address_of(bytes.view().data()));
  return mapping != nullptr && mapping->torn;
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
  mapping->torn = true;
  void* const rest = ::mmap(begin, mapping->end - (fault - into_page), PROT_READ,
                            MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0);
  errno = error;
  return rest != MAP_FAILED;
}

}  // namespace gltfx
