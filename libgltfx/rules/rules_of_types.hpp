// SPDX-License-Identifier: Apache-2.0
/// Rules by the type of their objects.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "json/keys.hpp"
#include "schema/set.hpp"

namespace gltfx::validate {

/// A cache of values by type, for assets with a million objects.
template <class Value>
class TypeCache {
 public:
  /// `type` is an element of a Set that outlives this; `make(type)` is called if there is no value
  /// yet.
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

/// Rules by the name of a type; `Rules` holds the rules of one type.
template <class Rules>
class RulesByName {
 public:
  /// The rules of a type, to add to. The name must outlive the table.
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
  std::vector<Rules> rules_;  // by the number of the name
  Rules none_;
};

}  // namespace gltfx::validate
