// SPDX-License-Identifier: Apache-2.0
/// Meshes, their primitives and vertex attributes with parsed names (specification section 3.7.2).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "model/asset.hpp"

namespace gltfx::model {

enum class SemanticKind : std::uint8_t {
  position,
  normal,
  tangent,
  texcoord,
  color,
  joints,
  weights,
  application,  ///< begins with an underscore
  extension,    ///< "KHR_x:NAME"
  invalid,
};
inline constexpr std::size_t kCoreSemanticCount = 7;

struct Semantic {
  SemanticKind kind = SemanticKind::invalid;
  std::uint64_t set = 0;  ///< the n of TEXCOORD_n, COLOR_n, JOINTS_n and WEIGHTS_n; saturates
};

/// Never fails: a name without a meaning is `invalid`. Sets are decimal without leading zeros.
Semantic parse_semantic(std::string_view name);

/// "TEXCOORD" for texcoord; empty for application and extension kinds.
std::string_view semantic_prefix(SemanticKind kind);

/// Whether names of this kind have a set number.
bool is_indexed(SemanticKind kind);

/// The extension an attribute name belongs to: "KHR_x" of "KHR_x:NAME", or empty.
std::string_view semantic_extension(std::string_view name);

/// Whether `name` matches `pattern` of a table: equal, or with a set number for a final "_n".
bool matches_semantic(std::string_view pattern, std::string_view name);

enum class Mode : std::uint8_t {
  points,
  lines,
  line_loop,
  line_strip,
  triangles,
  triangle_strip,
  triangle_fan,
};
/// "TRIANGLES".
std::string_view mode_name(Mode mode);
/// Whether a mode draws triangles, and not points or lines.
constexpr bool draws_triangles(Mode mode) { return mode >= Mode::triangles; }

struct Attribute {
  std::string_view name;  ///< lives in the document
  Semantic semantic;
  json::NodeId value = json::kNoNode;     ///< the index in the text
  std::optional<std::uint32_t> accessor;  ///< index of an object
};

/// The attributes of a primitive's `attributes` or of one morph target, in the order of the text.
std::vector<Attribute> read_attributes(const Asset& asset, json::NodeId object);

struct Primitive {
  json::NodeId node = json::kNoNode;
  json::NodeId attributes_node = json::kNoNode;
  std::vector<Attribute> attributes;
  std::vector<json::NodeId> targets;  ///< objects with the attributes of a morph target
  bool targets_are_broken = false;    ///< some are invalid: `targets` is empty
  json::NodeId indices_node = json::kNoNode;
  std::optional<std::uint32_t> indices;  ///< index of an object
  json::NodeId material_node = json::kNoNode;
  std::optional<std::uint32_t> material;       ///< index of an object
  std::optional<Mode> mode = Mode::triangles;  ///< nothing: not one of the seven

  /// The attribute with that meaning, or null.
  const Attribute* find(SemanticKind kind, std::uint64_t set = 0) const;
};

Primitive read_primitive(const Asset& asset, json::NodeId object);

/// One mesh. A primitive that is not an object has no `node`.
struct Mesh {
  json::NodeId node = json::kNoNode;  ///< kNoNode: the element of the array is not an object
  std::vector<Primitive> primitives;
  bool has_holes = false;  ///< an element of `primitives` is not an object
};

/// All meshes, by index.
std::vector<Mesh> read_meshes(const Asset& asset);

/// The objects of a mesh's `primitives`; an element that is not an object is kNoNode.
std::vector<json::NodeId> primitives(const json::Document& document, json::NodeId mesh);

/// The objects of a primitive's `targets`; empty when there are none, or one is empty or not an
/// object.
std::vector<json::NodeId> morph_targets(const json::Document& document, json::NodeId primitive);
/// Whether there are targets, but some are invalid.
bool has_broken_targets(const json::Document& document, json::NodeId primitive);

}  // namespace gltfx::model
