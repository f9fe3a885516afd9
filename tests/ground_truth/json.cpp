// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "value.hpp"

namespace gltfx::ground_truth {
namespace {

using Json = nlohmann::ordered_json;

Value convert(const Json& json) {
  if (json.is_boolean()) return Value(json.get<bool>());
  if (json.is_number()) return Value(json.get<double>());
  if (json.is_string()) return Value(json.get<std::string>());
  Value value;
  if (json.is_null()) return value;
  value.kind = json.is_array() ? Value::Kind::list : Value::Kind::object;
  for (const auto& [key, item] : json.items()) {
    if (json.is_object()) value.keys.push_back(key);
    value.items.push_back(convert(item));
  }
  return value;
}

}  // namespace

std::optional<Value> parse_json(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return std::nullopt;
  return convert(json);
}

}  // namespace gltfx::ground_truth
