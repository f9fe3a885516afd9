// SPDX-License-Identifier: Apache-2.0
/// What is written differently in glTF 2.0 and in glTF 2.1, for the ways there and back.
#pragma once

#include <array>
#include <string_view>

namespace gltfx::steps {

/// An index that glTF 2.1 has as a member of its own, and programs write into extras before.
struct MovedIndex {
  std::string_view object;  ///< the member of the root that has it, directly or in its extras
  std::string_view name;    ///< of the member in both
  std::string_view array;   ///< of the root, into which it is an index
};
inline constexpr std::array kMovedIndices{MovedIndex{"asset", "thumbnail", "images"}};

/// Extensions that glTF 2.1 is to include, for which its draft has no members.
inline constexpr std::array<std::string_view, 4> kPromoted{
    "EXT_texture_webp", "KHR_materials_emissive_strength", "KHR_mesh_quantization",
    "KHR_node_visibility"};

/// The extension that had what is `shapes` in glTF 2.1.
inline constexpr std::string_view kShapesExtension = "KHR_implicit_shapes";

/// A number of a shape of that extension, with the default that it has there.
struct ShapeNumber {
  std::string_view type;
  std::string_view member;
  std::string_view value;
};
inline constexpr std::array kShapeNumbers{
    ShapeNumber{"box", "size", "[1,1,1]"},           ShapeNumber{"sphere", "radius", "0.5"},
    ShapeNumber{"capsule", "height", "0.5"},         ShapeNumber{"capsule", "radiusBottom", "0.25"},
    ShapeNumber{"capsule", "radiusTop", "0.25"},     ShapeNumber{"cylinder", "height", "0.5"},
    ShapeNumber{"cylinder", "radiusBottom", "0.25"}, ShapeNumber{"cylinder", "radiusTop", "0.25"}};

}  // namespace gltfx::steps
