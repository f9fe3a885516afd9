// SPDX-License-Identifier: Apache-2.0
/// Differences between two glTF documents that should be equal, as pointers.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace gltfx::test {

using Json = nlohmann::json;

/// Defaults of the core specification by the member's name, as far as names identify them.
inline bool is_default(const std::string& name, const Json& value) {
  static const std::map<std::string, Json> kDefaults{{"byteOffset", 0},
                                                     {"texCoord", 0},
                                                     {"normalized", false},
                                                     {"doubleSided", false},
                                                     {"metallicFactor", 1},
                                                     {"roughnessFactor", 1},
                                                     {"baseColorFactor", {1, 1, 1, 1}},
                                                     {"emissiveFactor", {0, 0, 0}},
                                                     {"alphaMode", "OPAQUE"},
                                                     {"alphaCutoff", 0.5},
                                                     {"scale", 1},
                                                     {"strength", 1},
                                                     {"mode", 4},
                                                     {"wrapS", 10497},
                                                     {"wrapT", 10497},
                                                     {"interpolation", "LINEAR"},
                                                     {"name", ""},
                                                     {"color", {1, 1, 1}},
                                                     {"intensity", 1},
                                                     {"innerConeAngle", 0},
                                                     {"pbrMetallicRoughness", Json::object()},
                                                     {"extensions", Json::object()}};
  const auto known = kDefaults.find(name);
  return known != kDefaults.end() && known->second == value;
}

inline void without_defaults(Json& value) {
  if (value.is_array()) {
    for (Json& each : value) without_defaults(each);
  }
  if (!value.is_object()) return;
  for (auto at = value.begin(); at != value.end();) {
    if (at.key() != "extras") without_defaults(at.value());
    at = is_default(at.key(), at.value()) ? value.erase(at) : std::next(at);
  }
}

/// Pointers to all that is in one document only, or has another value in the other one.
inline std::vector<std::string> differences(Json one, Json other) {
  without_defaults(one);
  without_defaults(other);
  std::vector<std::string> found;
  for (const Json& change : Json::diff(one, other)) found.push_back(change.at("path"));
  return found;
}

}  // namespace gltfx::test
