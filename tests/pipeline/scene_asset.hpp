// SPDX-License-Identifier: Apache-2.0
/// Assets as text with their buffer inside, and the scenes they become.
#pragma once

#include <string>

#include "model/bytes_asset.hpp"
#include "model/packed_bytes.hpp"
#include "pipeline/scene_builder.hpp"
#include "rules/validated_asset.hpp"
#include "schema/compile.hpp"

namespace gltfx::test {

inline constexpr int kFloat = 5126;
inline constexpr int kUnsignedByte = 5121;

/// The scene of a text that stands nowhere: nothing is looked up beside it.
inline render::Scene scene_of_text(const std::string& text, const SceneOptions& options = {}) {
  const auto bytes = container::Bytes::from_string(std::string(text));
  const validate::ValidatedAsset asset(
      {"a.gltf", container::open_bytes(bytes, "a.gltf"), container::Resolver()}, {});
  EXPECT_FALSE(asset.asset().document().empty()) << text;
  if (asset.asset().document().empty()) return {};
  return build_scene(asset, *schema::builtin_set(), options).scene;
}

/// `members`: those of the root object beside the accessors.
inline render::Scene scene_of(const Accessors& accessors, const std::string& members,
                              const SceneOptions& options = {}) {
  return scene_of_text(accessors.text(members, buffer_uri(accessors.bytes())), options);
}

/// A triangle with positions (accessor 0), normals (1) and texture coordinates (2).
inline Accessors triangle() {
  Accessors accessors;
  accessors.add("VEC3", kFloat, 3, floats({0, 0, 0, 1, 0, 0, 0, 1, 0}));
  accessors.add("VEC3", kFloat, 3, floats({0, 0, 1, 0, 0, 1, 0, 0, 1}));
  accessors.add("VEC2", kFloat, 3, floats({0, 1, 1, 1, 0, 0}));
  return accessors;
}

}  // namespace gltfx::test
