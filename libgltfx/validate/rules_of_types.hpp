// SPDX-License-Identifier: Apache-2.0
/// Rules by the type of the objects that they are about.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "json/keys.hpp"
#include "schema/set.hpp"

namespace gltfx::validate {

/// Remembers what was found out about types, for the next of a million objects.
template <class Value>
class TypeCache {
 public:
  /// `type` is an element of a Set that outlives this; `make(type)` is called when it is not known.
  template <class Make>
  const Value& of(const schema::ObjectType& type, const Make& make) {
    Slot& slot = slots_[type.shape % slots_.size()];
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
  class Table {
   public:
    /// The name must outlive the table.
    void add(std::string_view type, const Rule& rule) {
      const json::KeyId id = names_.intern(type);
      rules_.resize(names_.size());
      rules_[id].push_back(rule);
    }
    const std::vector<Rule>& of(std::string_view type) const {
      const json::KeyId id = names_.find(type);
      return id == json::kNoKey ? none_ : rules_[id];
    }

   private:
    json::KeyTable names_;
    std::vector<std::vector<Rule>> rules_;  // by number of the name
    std::vector<Rule> none_;
  };

  /// The table must outlive it.
  explicit RulesOfTypes(const Table& table) : table_(table) {}

  /// `type` is an element of a Set that outlives this.
  const std::vector<Rule>& of(const schema::ObjectType& type) {
    return *known_.of(
        type, [this](const schema::ObjectType& unknown) { return &table_.of(unknown.name); });
  }

 private:
  const Table& table_;
  TypeCache<const std::vector<Rule>*> known_;
};

}  // namespace gltfx::validate
