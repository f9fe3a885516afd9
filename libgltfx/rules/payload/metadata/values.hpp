// SPDX-License-Identifier: Apache-2.0
/// Values of metadata in JSON: their form and range according to their property.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "model/metadata.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// A document, an object of it, and the sink for findings about the object.
struct MetadataObject {
  const json::Document& document;
  json::NodeId node;
  const Path& path;
  Sink& sink;
};

/// The meaning of the number of a value.
enum class MetadataNumber : std::uint8_t {
  stored,       ///< the stored number: noData
  transformed,  ///< the number after offset and scale: min, max, default
  factor,       ///< any number: offset, scale
};

/// The numbers of a value in order. Nothing if it does not have that form.
std::optional<std::vector<double>> metadata_numbers(const json::Document& document,
                                                    json::NodeId value,
                                                    const model::MetadataProperty& property);

/// Reports a value that does not have the form of the property, is not a name of its enum, or has
/// numbers outside its component type. Nothing for json::kNoNode.
void check_metadata_value(const MetadataObject& owner, std::string_view member, json::NodeId value,
                          const model::MetadataProperty& property, MetadataNumber number);

/// The members offset, scale, min and max of a class property, or of an object that stores its
/// values: their form, and that no min is above its max. `stored`: not of the class itself; then
/// members that such a property cannot have are reported.
void check_metadata_limits(const MetadataObject& owner, const model::MetadataProperty& property,
                           bool stored);

}  // namespace gltfx::validate
