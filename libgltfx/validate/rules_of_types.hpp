// SPDX-License-Identifier: Apache-2.0
/// Rules by the type of the objects that they are about.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "schema/set.hpp"

namespace gltfx::validate {

/// Remembers what was found out about types, for the next of a million objects.
template <class Value>
class TypeCache {
 public:
  /// `type` is an element of a Set that outlives this; `make(type)` is called when it is not known.
  template <class Make>
  const Value& of(const schema::ObjectType& type, const Make& make) {
    Slot& slot = slots_[reinterpret_cast<std::uintptr_t>(&type) / sizeof(type) % slots_.size()];
    if (slot.type != &type) slot = {&type, make(type)};
    return slot.value;
  }

 private:
  struct Slot {
    const schema::ObjectType* type = nullptr;
    Value value{};
  };
  std::array<Slot, 64> slots_;
};

/// Finds the rules of a type by its name.
template <class Rule>
class RulesOfTypes {
 public:
  using Table = std::unordered_map<std::string_view, std::vector<Rule>>;  ///< by name

  /// The table must outlive it.
  explicit RulesOfTypes(const Table& table) : table_(table) {}

  /// `type` is an element of a Set that outlives this.
  const std::vector<Rule>& of(const schema::ObjectType& type) {
    return *known_.of(type, [this](const schema::ObjectType& unknown) {
      const auto found = table_.find(unknown.name);
      return found == table_.end() ? &none_ : &found->second;
    });
  }

 private:
  const Table& table_;
  const std::vector<Rule> none_;
  TypeCache<const std::vector<Rule>*> known_;
};

}  // namespace gltfx::validate
