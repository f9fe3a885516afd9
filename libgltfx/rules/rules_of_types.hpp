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

/// Rules by the name of a type; `Rules` holds those of one.
template <class Rules>
class RulesByName {
 public:
  /// Those of a type, to add to. The name must outlive the table.
  Rules& to(std::string_view type) {
    const json::KeyId id = names_.intern(type);
    rules_.resize(names_.size());
    return rules_[id];
  }
  const Rules& of(std::string_view type) const {
    const json::KeyId id = names_.find(type);
    return id == json::kNoKey ? none_ : rules_[id];
  }

 private:
  json::KeyTable names_;
  std::vector<Rules> rules_;  // by number of the name
  Rules none_;
};

}  // namespace gltfx::validate
