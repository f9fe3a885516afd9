// SPDX-License-Identifier: Apache-2.0
#include "model/fields.hpp"

#include <cmath>

namespace gltfx::model {
std::optional<std::uint64_t> unsigned_member(const json::Document& document, json::NodeId object,
                                             std::string_view name) {
  const json::NodeId value = document.find(object, name);
  if (value == json::kNoNode) return std::nullopt;
  return document.unsigned_integer(value);
}

std::optional<double> number_member(const json::Document& document, json::NodeId object,
                                    std::string_view name) {
  const json::NodeId value = document.find(object, name);
  if (value == json::kNoNode || !document.is_number(value)) return std::nullopt;
  const double number = document.number(value).value;
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

bool true_member(const json::Document& document, json::NodeId object, std::string_view name) {
  const json::NodeId value = document.find(object, name);
  return value != json::kNoNode && document.kind(value) == json::Kind::true_value;
}

std::string string_member(const json::Document& document, json::NodeId object,
                          std::string_view name) {
  const json::NodeId value = document.find(object, name);
  if (value == json::kNoNode || !document.is_string(value)) return {};
  return document.string(value);
}

json::NodeId object_member(const json::Document& document, json::NodeId object,
                           std::string_view name) {
  const json::NodeId value = document.find(object, name);
  return value != json::kNoNode && document.is_object(value) ? value : json::kNoNode;
}

json::NodeId extension_object(const json::Document& document, json::NodeId object,
                              std::string_view extension) {
  return object_member(document, object_member(document, object, "extensions"), extension);
}

const std::vector<json::NodeId>& ArrayLookup::elements(json::NodeId array) {
  const auto [known, fresh] = elements_.try_emplace(array);
  if (fresh) {
    for (const json::NodeId element : document_.elements(array)) known->second.push_back(element);
  }
  return known->second;
}

std::uint64_t ArrayLookup::size(json::NodeId array) {
  if (document_.kind(array) == json::Kind::array) return elements(array).size();
  const auto [known, fresh] = sizes_.try_emplace(array);
  if (fresh) known->second = document_.array_size(array);
  return known->second;
}

}  // namespace gltfx::model
