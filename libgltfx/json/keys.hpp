// SPDX-License-Identifier: Apache-2.0
/// Member names and other texts, each stored once and identified by a number.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gltfx::json {

/// A member name, the same number for the same name within one document (after unescaping).
using KeyId = std::uint32_t;
inline constexpr KeyId kNoKey = UINT32_MAX;

/// Interns names in an open-addressing table. The hash is seeded per process, so that a file whose
/// names all collide cannot be prepared. Names are views: into the document's text, or into storage
/// that copies of the table share.
class KeyTable {
 public:
  KeyTable();
  /// With a given seed, for tests.
  KeyTable(std::uint64_t seed_a, std::uint64_t seed_b) : seed_a_(seed_a), seed_b_(seed_b) {}

  std::size_t size() const { return names_.size(); }
  std::string_view name(KeyId id) const { return names_[id]; }
  /// The number of a name, or kNoKey.
  KeyId find(std::string_view name) const;
  bool contains(std::string_view name) const { return find(name) != kNoKey; }
  /// The number of a name, which must outlive the table: the next free number when it is new.
  KeyId intern(std::string_view name);
  /// The same for a name that the table must store.
  KeyId intern_copy(std::string name);
  /// As intern(); says whether the name is new.
  bool insert(std::string_view name) {
    const std::size_t before = size();
    return intern(name) == before;
  }
  /// As intern_copy(); says whether the name is new.
  bool insert_copy(std::string name) {
    const std::size_t before = size();
    return intern_copy(std::move(name)) == before;
  }

 private:
  struct Slot {
    std::uint32_t tag = 0;  // upper half of the hash
    KeyId id = kNoKey;
  };
  std::uint64_t hash(std::string_view name) const;
  // The slot that holds `name` or would take it. Precondition: slots_ is not empty.
  std::size_t slot_of(std::string_view name, std::uint64_t hash) const;
  void grow();

  std::uint64_t seed_a_;
  std::uint64_t seed_b_;
  std::vector<Slot> slots_;  // a power of two, at most two thirds full
  std::vector<std::string_view> names_;
  std::shared_ptr<std::deque<std::string>> kept_;
};

}  // namespace gltfx::json
