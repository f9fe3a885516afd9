// SPDX-License-Identifier: Apache-2.0
#include "json/keys.hpp"

#include <array>
#include <bit>
#include <utility>

#include "base/fork.hpp"
#include "base/random_bytes.hpp"
#include "json/scan.hpp"

namespace gltfx::json {
namespace {

__extension__ using Product = unsigned __int128;

// Folded 64 x 64 multiplication, the mixing step of wyhash (Wang Yi, 2019). With 32-bit pointers,
// as in WebAssembly, the wide product would be a function call; there it is wyhash's step for such
// machines, with four products of halves.
std::uint64_t mix(std::uint64_t a, std::uint64_t b) {
  if constexpr (sizeof(void*) == 4) {
    const std::uint64_t high_a = a >> 32, low_a = a & 0xFFFFFFFF;
    const std::uint64_t high_b = b >> 32, low_b = b & 0xFFFFFFFF;
    const std::uint64_t crossed = high_a * low_b, other = low_a * high_b;
    return ((crossed >> 32 | crossed << 32) ^ high_a * high_b) ^
           ((other >> 32 | other << 32) ^ low_a * low_b);
  } else {
    const Product product = static_cast<Product>(a) * b;
    return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
  }
}

std::uint64_t load4(const char* p) {
  std::uint32_t bytes = 0;
  std::memcpy(&bytes, p, sizeof bytes);
  return bytes;
}

std::uint64_t byte(char c) { return static_cast<unsigned char>(c); }

struct Seed {
  std::uint64_t a;
  std::uint64_t b;
};

Seed make_seed() {
  std::array<unsigned char, sizeof(Seed)> bytes{};
  fill_with_random(bytes);
  return std::bit_cast<Seed>(bytes);
}

const Seed& process_seed() {
  static constinit MadeOnce<Seed> seed;
  return seed.get(make_seed);
}

}  // namespace

KeyTable::KeyTable() : KeyTable(process_seed().a, process_seed().b) {}

std::uint64_t KeyTable::hash(std::string_view name) const {
  const char* p = name.data();
  std::size_t left = name.size();
  std::uint64_t state = seed_b_ ^ left;
  for (; left > 16; p += 16, left -= 16) state = mix(load8(p) ^ seed_a_, load8(p + 8) ^ state);
  std::uint64_t low = 0;
  std::uint64_t high = 0;
  if (left >= 8) {
    low = load8(p);
    high = load8(p + left - 8);
  } else if (left >= 4) {
    low = load4(p);
    high = load4(p + left - 4);
  } else if (left > 0) {
    low = byte(p[0]) << 16 | byte(p[left / 2]) << 8 | byte(p[left - 1]);
  }
  return mix(low ^ seed_a_, high ^ state);
}

std::size_t KeyTable::slot_of(std::string_view name, std::uint64_t hash) const {
  const std::size_t mask = slots_.size() - 1;
  const auto tag = static_cast<std::uint32_t>(hash >> 32);
  std::size_t at = hash & mask;
  for (;; at = (at + 1) & mask) {
    const Slot& slot = slots_[at];
    if (slot.id == kNoKey || (slot.tag == tag && is_same(names_[slot.id], name))) return at;
  }
}

KeyId KeyTable::find(std::string_view name) const {
  return slots_.empty() ? kNoKey : slots_[slot_of(name, hash(name))].id;
}

KeyId KeyTable::intern(std::string_view name) {
  if ((names_.size() + 1) * 3 > slots_.size() * 2) grow();
  const std::uint64_t hashed = hash(name);
  Slot& slot = slots_[slot_of(name, hashed)];
  if (slot.id == kNoKey) {
    slot = {static_cast<std::uint32_t>(hashed >> 32), static_cast<KeyId>(names_.size())};
    // Grows by less than doubling: the table of a text that consists of names is larger than the
    // text.
    if (names_.size() == names_.capacity()) names_.reserve(names_.size() / 4 * 5 + 16);
    names_.push_back(name);
  }
  return slot.id;
}

KeyId KeyTable::intern_copy(std::string name) {
  if (const KeyId known = find(name); known != kNoKey) return known;
  if (!kept_) kept_ = std::make_shared<std::deque<std::string>>();
  kept_->push_back(std::move(name));
  return intern(kept_->back());
}

void KeyTable::grow() {
  constexpr std::size_t kFirstSize = 64;
  const std::size_t size = slots_.empty() ? kFirstSize : slots_.size() * 2;
  slots_.assign(size, Slot{});
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const std::uint64_t hashed = hash(names_[i]);
    std::size_t at = hashed & (size - 1);
    while (slots_[at].id != kNoKey) at = (at + 1) & (size - 1);
    slots_[at] = {static_cast<std::uint32_t>(hashed >> 32), static_cast<KeyId>(i)};
  }
}

}  // namespace gltfx::json
