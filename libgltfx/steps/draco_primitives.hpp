// SPDX-License-Identifier: Apache-2.0
/// Which primitives Draco can hold, and their triangles.
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

/// A primitive on its way into a bitstream.
struct DracoPrimitive {
  const model::Primitive* primitive = nullptr;
  json::NodeId mesh = json::kNoNode;
  bool stays = false;                    ///< it is left or refused, which has been said
  std::vector<std::uint32_t> accessors;  ///< of the attributes, in their order; then of the indices
};

/// All primitives of an asset. Those that share an accessor with one that stays, stay as well.
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
  const std::set<std::uint64_t> meant_;  ///< integers of unknown extensions
  std::vector<DracoPrimitive> all_;
  std::map<std::uint32_t, std::vector<std::size_t>> users_;  ///< primitives, by accessor
  std::map<std::uint32_t, std::size_t> places_;              ///< where primitives refer to it
  /// Objects of extensions without a schema that hold numbers, by the mesh that they are on, or by
  /// the primitive that they are in.
  std::map<json::NodeId, json::NodeId> unknown_;
};

/// A mesh that owns what it refers to.
struct DracoSource {
  codec::DracoMesh mesh;
  std::vector<std::string> values;
  std::vector<std::uint32_t> triangles;
};

/// The triangles of a primitive with its attributes, numbered from 0 as ids; else why Draco cannot
/// hold them.
Result<DracoSource> read_source(const GeometryInput& input, const DracoPrimitive& primitive);

}  // namespace gltfx::steps
