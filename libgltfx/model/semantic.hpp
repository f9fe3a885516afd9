// SPDX-License-Identifier: Apache-2.0
/// Names of vertex attributes taken apart (specification section 3.7.2.1).
#pragma once

#include <cstdint>
#include <string_view>

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

/// "TEXCOORD" for texcoord; empty for the kinds that are not glTF's own.
std::string_view semantic_prefix(SemanticKind kind);

/// Whether names of this kind carry a set number.
bool is_indexed(SemanticKind kind);

/// The extension an attribute name belongs to: "KHR_x" of "KHR_x:NAME", or empty.
std::string_view semantic_extension(std::string_view name);

/// Whether `name` is what a table calls `pattern`: equal, or with a set number for a final "_n".
bool matches_semantic(std::string_view pattern, std::string_view name);

}  // namespace gltfx::model
