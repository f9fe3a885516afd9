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

/// Finds the rules of a type by its name once, and not again for each of a million objects.
template <class Rule>
class RulesOfTypes {
 public:
  using Table = std::unordered_map<std::string_view, std::vector<Rule>>;  ///< by name

  /// The table must outlive it.
  explicit RulesOfTypes(const Table& table) : table_(table) {}

  /// `type` is an element of a Set that outlives this.
  const std::vector<Rule>& of(const schema::ObjectType& type) {
    Slot& slot = slots_[reinterpret_cast<std::uintptr_t>(&type) / sizeof(type) % slots_.size()];
    if (slot.type != &type) {
      const auto found = table_.find(type.name);
      slot = {&type, found == table_.end() ? &none_ : &found->second};
    }
    return *slot.rules;
  }

 private:
  struct Slot {
    const schema::ObjectType* type = nullptr;
    const std::vector<Rule>* rules = nullptr;
  };
  const Table& table_;
  const std::vector<Rule> none_;
  std::array<Slot, 64> slots_;
};

}  // namespace gltfx::validate
