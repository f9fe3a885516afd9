// SPDX-License-Identifier: Apache-2.0
/// Selects the primitives that Draco can store, and reads their triangles.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "codec/client.hpp"
#include "steps/geometry_input.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// A primitive that may become a bitstream.
struct DracoPrimitive {
  const model::Primitive* primitive = nullptr;
  json::NodeId mesh = json::kNoNode;
  bool stays = false;                    ///< left or refused; the note exists
  std::vector<std::uint32_t> accessors;  ///< attributes in order, then indices
};

/// All primitives of an asset. Primitives that share an accessor with one that stays also stay.
class DracoPrimitives {
 public:
  DracoPrimitives(const GeometryInput& input, StepOutcome& outcome);

  std::vector<DracoPrimitive>& all() { return all_; }
  const std::vector<DracoPrimitive>& all() const { return all_; }
  void leave(std::size_t index, std::string reason);
  void refuse(std::size_t index, std::string reason);

 private:
  void find_unknown();
  void consider(std::size_t index);
  bool find_extension_obstacle(std::size_t index);
  std::string find_accessor_obstacle(std::uint32_t accessor) const;
  void stay(std::size_t index);

  const GeometryInput& input_;
  StepOutcome& outcome_;
  const std::set<std::uint64_t> meant_;  ///< integers in unknown extensions
  std::vector<DracoPrimitive> all_;
  std::map<std::uint32_t, std::vector<std::size_t>> users_;  ///< primitives, by accessor
  std::map<std::uint32_t, std::size_t> places_;              ///< references, by accessor
  /// Objects of extensions without a schema that contain numbers, by the mesh or primitive that has
  /// them.
  std::map<json::NodeId, json::NodeId> unknown_;
};

/// A mesh that owns its data.
struct DracoSource {
  codec::DracoMesh mesh;
  std::vector<std::string> values;
  std::vector<std::uint32_t> triangles;
};

/// The triangles and attributes of a primitive. The ids of attributes are their positions, from 0.
/// Returns an Error (half a sentence) if Draco cannot store them.
Result<DracoSource> read_source(const GeometryInput& input, const DracoPrimitive& primitive);

}  // namespace gltfx::steps
