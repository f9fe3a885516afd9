// SPDX-License-Identifier: Apache-2.0
/// Values of metadata in JSON: their form and range by the property they belong to.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "model/metadata.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// A document, an object of it, and where findings about the object go.
struct MetadataObject {
  const json::Document& document;
  json::NodeId node;
  const Path& path;
  Sink& sink;
};

/// What the number of a value stands for.
enum class MetadataNumber : std::uint8_t {
  stored,       ///< what is stored: noData
  transformed,  ///< what readers get: min, max, default
  factor,       ///< any number: offset, scale
};

/// The numbers of a value, one behind the other. Nothing when there is none of that form.
std::optional<std::vector<double>> metadata_numbers(const json::Document& document,
                                                    json::NodeId value,
                                                    const model::MetadataProperty& property);

/// Reports a value that does not have the form of the property, names no value of its enum, or has
/// numbers that its component type does not hold. Nothing for json::kNoNode.
void check_metadata_value(const MetadataObject& owner, std::string_view member, json::NodeId value,
                          const model::MetadataProperty& property, MetadataNumber number);

/// The members offset, scale, min and max of a class property, or of what stores its values: their
/// form, and that no min is above its max. `stored`: not of the class itself; then members that
/// such a property cannot have are reported.
void check_metadata_limits(const MetadataObject& owner, const model::MetadataProperty& property,
                           bool stored);

}  // namespace gltfx::validate
