// SPDX-License-Identifier: Apache-2.0
/// The users of a material, and the effect of their COLOR_0 on its base colour (glTF 2.0
/// section 3.9.2: the two are multiplied).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "graph/graph.hpp"
#include "model/accessor_data.hpp"
#include "model/asset_bytes.hpp"

namespace gltfx::upgrade {

/// Keeps references to its arguments. Not thread-safe.
class AccessorValues {
 public:
  /// Null bytes: nothing can be read.
  AccessorValues(const model::Asset& asset, model::AssetBytes* bytes)
      : asset_(asset), bytes_(bytes) {}

  /// The elements as stored in a buffer; nothing if some are not in a buffer, or an extension
  /// requires decoding.
  std::optional<model::AccessorData> open(std::uint64_t accessor);

 private:
  bool is_plain(const model::Accessor& accessor) const;
  void read_all();

  const model::Asset& asset_;
  model::AssetBytes* bytes_;
  std::optional<model::Views> views_;  ///< nothing before the first call
  model::ResourceData resources_;
};

/// A place in the document that gives a primitive a material: its member `material`, or one in an
/// extension.
struct MaterialUse {
  json::NodeId primitive;
  json::NodeId index;  ///< number
};

std::vector<MaterialUse> find_material_uses(const model::Asset& asset, const graph::Graph& graph,
                                            std::uint64_t material);

using Rgb = std::array<double, 3>;

/// The colours that multiply the base colour of a material.
struct Tint {
  struct Part {
    Rgb color;
    std::vector<json::NodeId> users;  ///< MaterialUse::index of the primitives with this colour
  };
  std::string problem;      ///< why they are unknown or not numbers; otherwise empty
  std::vector<Part> parts;  ///< each colour once; white for primitives without COLOR_0
};

/// `uses` are the uses of one material.
Tint find_tint(const model::Asset& asset, AccessorValues& values,
               const std::vector<MaterialUse>& uses);

}  // namespace gltfx::upgrade
