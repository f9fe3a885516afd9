// SPDX-License-Identifier: Apache-2.0
/// Builds small assets whose data is in one buffer.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

namespace gltfx::test {

struct AssetBuilder {
  using Json = nlohmann::ordered_json;

  AssetBuilder() { json["asset"]["version"] = "2.0"; }

  /// An object with the members in a text, which may begin with a comma.
  static Json members_of(const std::string& text) {
    const std::size_t begin = std::min(text.find_first_not_of(", "), text.size());
    return Json::parse("{" + text.substr(begin) + "}");
  }

  /// Appends an object to a root array and returns its index.
  std::size_t add(const char* array, Json object) {
    json[array].push_back(std::move(object));
    return json[array].size() - 1;
  }
  /// Adds a buffer view of new bytes, aligned to 4, and returns its index.
  std::size_t view(const std::string& data, const Json& more = Json::object()) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    Json object{{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", data.size()}};
    object.update(more);
    bytes += data;
    return add("bufferViews", std::move(object));
  }
  /// Adds an accessor with a buffer view of its own and returns its index; without data it has no
  /// view. `component`: the number in the text, 5126 for floats.
  std::size_t accessor(const std::string& type, int component, std::size_t count,
                       const std::string& data, const Json& more = Json::object(),
                       const Json& of_view = Json::object()) {
    Json object;
    if (!data.empty()) object["bufferView"] = view(data, of_view);
    object["componentType"] = component;
    object["count"] = count;
    object["type"] = type;
    object.update(more);
    return add("accessors", std::move(object));
  }
  /// The text, with further members of the root. The buffer has no URI if `uri` is empty.
  std::string text(const std::string& uri = {}, const std::string& members = {}) const {
    Json buffer;
    buffer["byteLength"] = bytes.size();
    if (!uri.empty()) buffer["uri"] = uri;
    Json all = json;
    if (!bytes.empty()) all["buffers"].push_back(std::move(buffer));
    all.update(members_of(members));
    return all.dump();
  }

  Json json;          ///< without `buffers`
  std::string bytes;  ///< of the buffer
};

}  // namespace gltfx::test
