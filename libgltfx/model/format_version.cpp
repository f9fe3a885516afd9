// SPDX-License-Identifier: Apache-2.0
#include "model/format_version.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace gltfx::model {
namespace {

// glTF 1.0 kept its objects in dictionaries and always had shaders; `asset` was optional.
bool looks_like_version_1(const json::Document& document) {
  static constexpr std::array<std::string_view, 3> kOld{"techniques", "programs", "shaders"};
  static constexpr std::array<std::string_view, 3> kArrays{"accessors", "buffers", "meshes"};
  const auto is_object = [&](std::string_view name) {
    const json::NodeId value = document.find(document.root(), name);
    return value != json::kNoNode && document.is_object(value);
  };
  return std::any_of(kOld.begin(), kOld.end(), is_object) &&
         std::any_of(kArrays.begin(), kArrays.end(), is_object);
}

}  // namespace

// Exporters of that time wrote a number as often as a string.
bool is_gltf_1(const json::Document& document) {
  const json::NodeId place = document.find(document.find(document.root(), "asset"), "version");
  if (place == json::kNoNode) return looks_like_version_1(document);
  if (document.is_string(place)) {
    const std::string version = document.string(place);
    return version == "1.0" || version == "1.1";
  }
  if (!document.is_number(place)) return false;
  const double number = document.number(place).value;
  return number >= 1 && number < 2;
}

}  // namespace gltfx::model
