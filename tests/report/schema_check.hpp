// SPDX-License-Identifier: Apache-2.0
/// A second opinion on JSON Schema: just the keywords that the report's schema uses, on nlohmann's
/// DOM. It is independent of the library, and refuses unknown keywords.
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace gltfx::report::testing {

class SchemaCheck {
 public:
  explicit SchemaCheck(nlohmann::json schema) : root_(std::move(schema)) {}

  /// The errors of a value, each with its pointer; empty: none.
  std::vector<std::string> errors(const nlohmann::json& value) {
    errors_.clear();
    check(value, root_, "");
    return errors_;
  }

 private:
  using Json = nlohmann::json;

  void check(const Json& value, const Json& schema, const std::string& at) {
    static const std::set<std::string> known{"$schema",  "$id",
                                             "title",    "description",
                                             "$defs",    "$ref",
                                             "type",     "enum",
                                             "const",    "minimum",
                                             "required", "properties",
                                             "items",    "additionalProperties"};
    for (const auto& item : schema.items()) {
      if (known.count(item.key()) == 0) errors_.push_back("unknown keyword " + item.key());
    }
    if (schema.contains("$ref")) check(value, target(schema["$ref"]), at);
    if (schema.contains("type") && !has_a_type(value, schema["type"])) fail(at, "type");
    if (schema.contains("const") && value != schema["const"]) fail(at, "const");
    if (schema.contains("enum") && !one_of(value, schema["enum"])) fail(at, "enum");
    if (schema.contains("minimum") && value < schema["minimum"]) fail(at, "minimum");
    if (value.is_object()) check_object(value, schema, at);
    if (value.is_array() && schema.contains("items")) check_items(value, schema["items"], at);
  }

  void check_object(const Json& value, const Json& schema, const std::string& at) {
    for (const Json& name : schema.value("required", Json::array())) {
      if (!value.contains(name.get<std::string>())) fail(at, "required " + name.get<std::string>());
    }
    const Json properties = schema.value("properties", Json::object());
    for (const auto& item : value.items()) {
      const std::string member = at + "/" + item.key();
      if (properties.contains(item.key())) {
        check(item.value(), properties[item.key()], member);
      } else if (schema.value("additionalProperties", true) == false) {
        fail(member, "additionalProperties");
      }
    }
  }

  void check_items(const Json& value, const Json& schema, const std::string& at) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      check(value[i], schema, at + "/" + std::to_string(i));
    }
  }

  const Json& target(const std::string& reference) const {
    return root_.at(Json::json_pointer(reference.substr(1)));
  }

  static bool has_a_type(const Json& value, const Json& types) {
    if (!types.is_array()) return has_type(value, types);
    return std::any_of(types.begin(), types.end(),
                       [&](const Json& type) { return has_type(value, type); });
  }

  static bool has_type(const Json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "number") return value.is_number();
    if (type == "null") return value.is_null();
    return type == "integer" && value.is_number_integer();
  }

  static bool one_of(const Json& value, const Json& choices) {
    return std::find(choices.begin(), choices.end(), value) != choices.end();
  }

  void fail(const std::string& at, const std::string& what) { errors_.push_back(at + ": " + what); }

  Json root_;
  std::vector<std::string> errors_;
};

}  // namespace gltfx::report::testing
