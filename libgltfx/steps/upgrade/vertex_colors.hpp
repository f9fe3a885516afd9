// SPDX-License-Identifier: Apache-2.0
/// Who uses a material, and what COLOR_0 of these primitives makes of its base colour (glTF 2.0
/// section 3.9.2: it is multiplied with it).
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

/// Keeps references to what it is made of. Not thread-safe.
class AccessorValues {
 public:
  /// Null bytes: nothing can be read.
  AccessorValues(const model::Asset& asset, model::AssetBytes* bytes)
      : asset_(asset), bytes_(bytes) {}

  /// The elements as they lie in a buffer; nothing where they do not all lie there, or an extension
  /// says that they are to be decoded first.
  std::optional<model::AccessorData> open(std::uint64_t accessor);

 private:
  bool is_plain(const model::Accessor& accessor) const;
  void read_all();

  const model::Asset& asset_;
  model::AssetBytes* bytes_;
  std::optional<model::Views> views_;  ///< nothing until somebody asked
  model::ResourceData resources_;
};

/// A place in the document that gives a primitive a material: its own, or one of those that
/// extensions name.
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
    std::vector<json::NodeId> users;  ///< MaterialUse::index of the primitives that have it
  };
  std::string problem;      ///< why they are not known, or no numbers; else empty
  std::vector<Part> parts;  ///< each color once; white for primitives without COLOR_0
};

/// `uses` are those of one material.
Tint find_tint(const model::Asset& asset, AccessorValues& values,
               const std::vector<MaterialUse>& uses);

}  // namespace gltfx::upgrade
