// SPDX-License-Identifier: Apache-2.0
/// Common parts of property tables, textures, attributes and objects: a class, and a value for each
/// of its properties.
#pragma once

#include <functional>
#include <string_view>

#include "model/metadata.hpp"
#include "rules/payload/metadata/phase.hpp"

namespace gltfx::validate {

/// The value of one of them for a property of its class.
struct PropertyUse {
  const model::MetadataProperty& property;
  json::NodeId value;  ///< the value, of any kind
  const Path& path;    ///< path of the value
};

/// Calls `use` for each property of the class in `object`. Reports a class and properties that do
/// not exist, and a required property that is missing.
void for_each_property(MetadataPhase& phase, json::NodeId object, const Path& path,
                       const std::function<void(const PropertyUse&)>& use);

/// Likewise for each object of a list of the root object. `use` also gets the object's index.
void for_each_listed(
    MetadataPhase& phase, std::string_view list,
    const std::function<void(std::size_t index, json::NodeId object, const PropertyUse&)>& use);

/// The cost of a name lookup, in numbers of the budget.
inline constexpr std::uint64_t kCostOfName = 16;

/// Calls `use(index, list, path)` for each index below `size` of a list of indices; `path` is that
/// of the element.
void for_each_index(
    const MetadataPhase& phase, json::NodeId object, const Path& path, std::string_view list,
    std::size_t size,
    const std::function<void(std::size_t index, json::NodeId list, const Path& path)>& use);

/// Reports an enumType that is not the name of an enum.
void check_enum_type(const model::MetadataSchema& schema, const model::MetadataProperty& property,
                     const Path& path, Sink& sink);

/// Reports a property that cannot be stored in `what` ("a property texture") because of `why`.
void report_unstorable(MetadataPhase& phase, const PropertyUse& use, std::string_view what,
                       std::string_view why);

}  // namespace gltfx::validate
