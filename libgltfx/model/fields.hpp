// SPDX-License-Identifier: Apache-2.0
/// Members of a JSON object as the types glTF gives them. What has another type counts as absent:
/// the schema walk has reported it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "json/document.hpp"

namespace gltfx::model {

/// A non-negative integer, at most 2^53.
std::optional<std::uint64_t> unsigned_member(const json::Document& document, json::NodeId object,
                                             std::string_view name);

/// Any finite number.
std::optional<double> number_member(const json::Document& document, json::NodeId object,
                                    std::string_view name);

/// `true` only when the member is the literal true.
bool true_member(const json::Document& document, json::NodeId object, std::string_view name);

/// A string, or empty.
std::string string_member(const json::Document& document, json::NodeId object,
                          std::string_view name);

/// The object's member of that name when it is an object, otherwise json::kNoNode.
json::NodeId object_member(const json::Document& document, json::NodeId object,
                           std::string_view name);

/// The object of an extension on `object`, or json::kNoNode.
json::NodeId extension_object(const json::Document& document, json::NodeId object,
                              std::string_view extension);

}  // namespace gltfx::model
