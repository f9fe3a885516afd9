// SPDX-License-Identifier: Apache-2.0
/// One check of a value against a JSON Schema.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/json_pointer.hpp"
#include "schema/json_schema.hpp"
#include "schema/json_value.hpp"

namespace gltfx::schema {

/// One check. Without a failure to fill, reasons are not formatted.
class Evaluation {
 public:
  Evaluation(const JsonSchema& schema, const CheckedObject& object, std::uint64_t& work)
      : schema_(schema), object_(object), work_(work) {}

  bool exhausted() const { return exhausted_; }
  bool fits(std::uint32_t id, const JsonValue& value, const Path& path, SchemaFailure* failure);

 private:
  struct Frame {
    JsonValue value;
    const Path& path;
    SchemaFailure* failure;
  };

  bool spend(std::uint64_t steps) {
    if (steps > work_) exhausted_ = true;
    work_ -= std::min(work_, steps);
    return !exhausted_;
  }
  /// `reason` gives the text.
  template <class Reason>
  bool fail(const Frame& at, const Reason& reason) const {
    if (at.failure == nullptr) return false;
    const bool own = at.value.document == &object_.document;
    *at.failure = {at.path.pointer(), reason(), own ? at.value.node : json::kNoNode};
    return false;
  }

  bool holds(const Assertion& assertion, const Frame& at);
  bool number_holds(const Assertion& assertion, const Frame& at) const;
  bool text_holds(const Assertion& assertion, const Frame& at);
  bool array_holds(const Assertion& assertion, const Frame& at);
  bool object_holds(const Assertion& assertion, const Frame& at);
  bool combination_holds(const Assertion& assertion, const Frame& at);

  bool has_type(const Assertion& assertion, const Frame& at) const;
  bool equals_one(const Assertion& assertion, const Frame& at);
  bool size_holds(const Assertion& assertion, const Frame& at, std::uint64_t size,
                  std::string_view what) const;
  bool items_hold(const Assertion& assertion, const Frame& at);
  bool contains_enough(const Assertion& assertion, const Frame& at);
  bool members_hold(const Assertion& assertion, const Frame& at);
  bool properties_hold(const Assertion& assertion, const Frame& at);
  bool all_there(const std::vector<std::string>& names, const Frame& at, std::string_view because);
  bool matches(const Pattern& pattern, std::string_view text);
  bool one_fits(const Assertion& assertion, const Frame& at);
  bool does_not_fit(const Assertion& assertion, const Frame& at);

  bool is_checked_object(const JsonValue& value) const {
    return value.document == &object_.document && value.node == object_.object;
  }
  std::optional<JsonValue> member(const JsonValue& value, std::string_view name) const;

  const JsonSchema& schema_;
  const CheckedObject& object_;
  std::uint64_t& work_;
  int depth_ = 0;
  bool exhausted_ = false;
};

}  // namespace gltfx::schema
