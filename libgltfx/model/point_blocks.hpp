// SPDX-License-Identifier: Apache-2.0
/// The vertices that a mesh draws, in blocks with bounds, so that those which leave a region are
/// found without a look at most others: at rest and in any pose.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.hpp"
#include "model/geometry.hpp"
#include "model/scene_box.hpp"

namespace gltfx::model {

/// The box of a mesh without morph targets and skins, as accessors state it. Empty: they do not.
Box stated_bounds(const GeometrySource& source, const Mesh& mesh);

/// Receives points in the space to which a placement moves them.
class PointWatcher {
 public:
  virtual ~PointWatcher() = default;
  /// Whether points in the box matter.
  virtual bool wants(const Box& box) const = 0;
  /// `index`: for PointBlocks::origin_of().
  virtual void take(const Vector3& point, std::size_t index) = 0;
};

/// Where a mesh is: one matrix, or those of its joints; and the weights of its morph targets.
struct Placement {
  std::span<const Affine> matrices;
  std::span<const float> weights;
};

class PointBlocks {
 public:
  /// A vertex that is drawn.
  struct Origin {
    std::uint32_t primitive = 0, vertex = 0;
  };

  PointBlocks() = default;
  /// Points without morph targets and joints.
  explicit PointBlocks(Vectors<3> points);
  /// `joints`: their number; 0: the mesh is not skinned. `morphs`: read the morph targets. The
  /// Error is half a sentence.
  static Result<PointBlocks> read(const GeometrySource& source, const Mesh& mesh,
                                  std::size_t joints, bool morphs, MemoryBudget& budget);

  std::size_t size() const { return points_.size(); }
  Origin origin_of(std::size_t index) const {
    return index < origins_.size() ? origins_[index] : Origin();
  }

  /// Passes on the points of the blocks that the watcher wants. Takes its steps from `work`; false:
  /// there were too few, and the watcher has not seen all points.
  bool visit(const Placement& placement, std::uint64_t& work, PointWatcher& watcher) const;

 private:
  static constexpr std::size_t kInBlock = 32, kFanout = 8, kMostLevels = 12;

  struct FloatBox {
    std::array<float, 3> least, greatest;
  };
  struct Influence {
    std::uint32_t joint = 0;
    float weight = 0;
  };
  struct Level {
    std::vector<FloatBox> boxes;                     ///< by block
    std::vector<FloatBox> deltas;                    ///< by block, then by morph target
    std::vector<std::vector<std::uint32_t>> joints;  ///< by block, each once; empty: no skin
  };
  class Reader;

  void build();
  Level lowest_level() const;
  Level level_above(const Level& below) const;
  Box bounds_of(const Level& level, std::size_t block, const Placement& placement) const;
  Vector3 place(std::size_t index, const Placement& placement) const;

  Vectors<3> points_;
  std::vector<Origin> origins_;
  std::vector<Vectors<3>> targets_;        ///< by target: how it moves each point
  std::vector<std::uint32_t> influenced_;  ///< where the influences of each point end
  std::vector<Influence> influences_;      ///< weights of a point add up to 1
  std::vector<Level> levels_;              ///< the last one has one block
};

}  // namespace gltfx::model
