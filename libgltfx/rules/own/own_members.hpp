// SPDX-License-Identifier: Apache-2.0
/// The member `gltfx` that an own rule sees in each object: what the object's text does not say.
#pragma once

#include <gltfx/measure.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "json/document.hpp"
#include "json/writer.hpp"
#include "rules/context.hpp"
#include "rules/own/own_page.hpp"

namespace gltfx::validate {

inline constexpr std::string_view kOwnMember = "gltfx";

/// The members of that member, beside measures: those that objects of the scope can have.
std::vector<std::string_view> own_members(const OwnScope& scope);

/// An object that a rule checks.
struct OwnSubject {
  json::NodeId object = json::kNoNode;
  std::optional<std::size_t> index = {};  ///< in its array
  std::optional<std::size_t> mesh = {};   ///< of a primitive
};

/// Makes the member of objects of one asset.
class OwnMembers {
 public:
  /// `name`: the path of the asset; its "." and ".." are resolved. `measured`: the measures that
  /// rules name; may be null. All must outlive this.
  OwnMembers(const Context& context, const std::string& name, const Measurements* measured);

  json::Document document(const OwnScope& scope, const OwnSubject& subject) const;

  /// A measure that the object should have.
  struct Fault {
    const MeasureDescription* measure = nullptr;  ///< null: there is none
    std::string_view why;                         ///< one sentence
  };
  /// The first of these measures that could not be taken of the object.
  Fault fault(const OwnScope& scope, const OwnSubject& subject,
              std::span<const MeasureDescription* const> of) const;

 private:
  void write_node(json::Writer& writer, std::size_t node) const;
  void write_measures(json::Writer& writer, const OwnScope& scope, const OwnSubject& subject) const;
  std::size_t element_of(const OwnSubject& subject) const;
  std::string name_of(model::RootArray array, std::size_t index) const;

  const Context& context_;
  const Measurements* measured_;
  std::string path_, stem_;
};

}  // namespace gltfx::validate
