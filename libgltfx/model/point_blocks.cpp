// SPDX-License-Identifier: Apache-2.0
#include "model/point_blocks.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/checked.hpp"
#include "model/skin.hpp"

namespace gltfx::model {
namespace {

Vector3 widened(const std::array<float, 3>& from) {
  return {static_cast<double>(from[0]), static_cast<double>(from[1]), static_cast<double>(from[2])};
}

// Joints and weights of a set, by vertex.
struct InfluenceSet {
  Vectors<4> joints, weights;
};

// The sets that can be read, as skin() takes them.
std::vector<InfluenceSet> read_sets(const PrimitiveData& data, std::size_t vertices) {
  std::vector<InfluenceSet> sets;
  for (std::size_t i = 0; i < joint_sets(data.primitive()); ++i) {
    const auto joints = data.open(SemanticKind::joints, i);
    const auto weights = data.open(SemanticKind::weights, i);
    const auto fits = [&](const std::optional<AccessorData>& elements) {
      return elements && elements->count() == vertices && elements->components() == 4;
    };
    if (!fits(joints) || !fits(weights)) continue;
    InfluenceSet& set = sets.emplace_back();
    set.joints.resize(vertices);
    set.weights.resize(vertices);
    read_elements(*joints, set.joints);
    read_elements(*weights, set.weights);
  }
  return sets;
}

std::vector<bool> drawn_vertices(const Geometry& geometry) {
  std::vector<bool> drawn(geometry.positions.size());
  const auto use = [&](std::uint32_t vertex) { drawn[vertex] = true; };
  for (const auto& each : geometry.triangles) std::for_each(each.begin(), each.end(), use);
  for (const auto& each : geometry.segments) std::for_each(each.begin(), each.end(), use);
  std::for_each(geometry.points.begin(), geometry.points.end(), use);
  return drawn;
}

}  // namespace

Box stated_bounds(const GeometrySource& source, const Mesh& mesh) {
  Box all;
  for (const Primitive& primitive : mesh.primitives) {
    const Attribute* const position = primitive.find(SemanticKind::position);
    if (position == nullptr || !position->accessor) return {};
    const Accessor& accessor = source.views.accessors[*position->accessor];
    const auto least = float_array<3>(source.asset.document(), accessor.min);
    const auto most = float_array<3>(source.asset.document(), accessor.max);
    if (!least || !most || accessor.format.normalized) return {};
    all.add(widened(*least));
    all.add(widened(*most));
  }
  return all;
}

class PointBlocks::Reader {
 public:
  Reader(const GeometrySource& source, std::size_t joints, MemoryBudget& budget, PointBlocks& to)
      : source_(source), joints_(joints), budget_(budget), to_(to) {}

  GeometryError add(const Primitive& primitive, std::uint32_t index) {
    if (primitive.node == json::kNoNode || primitive.find(SemanticKind::position) == nullptr) {
      return GeometryError::none;
    }
    GeometryRequest request;
    request.surface = false;
    Geometry geometry;
    const GeometryError error = read_geometry(source_, primitive, request, budget_, geometry);
    if (error == GeometryError::empty) return GeometryError::none;
    if (error != GeometryError::none) return error;
    const std::vector<bool> drawn = drawn_vertices(geometry);
    if (!budget_.take(bytes_for(geometry.positions.size(), primitive))) {
      return GeometryError::too_large;
    }
    for (std::uint32_t i = 0; i < drawn.size(); ++i) {
      if (!drawn[i]) continue;
      to_.points_.push_back(geometry.positions[i]);
      to_.origins_.push_back({index, i});
    }
    const PrimitiveData data(source_, primitive);
    add_targets(data, drawn);
    if (joints_ > 0) add_influences(data, drawn);
    return GeometryError::none;
  }

 private:
  Checked bytes_for(std::size_t vertices, const Primitive& primitive) const {
    const std::size_t sets = joints_ > 0 ? joint_sets(primitive) : 0;
    return checked_mul(vertices, 32 + 12 * to_.targets_.size() + 64 * sets);
  }

  void add_targets(const PrimitiveData& data, const std::vector<bool>& drawn) {
    const auto& objects = data.primitive().targets;
    for (std::size_t i = 0; i < to_.targets_.size(); ++i) {
      Vectors<3> moves(drawn.size());
      if (i < objects.size()) {
        for (const Attribute& each : read_attributes(source_.asset, objects[i])) {
          if (each.semantic.kind != SemanticKind::position) continue;
          const auto elements = data.open(each.accessor);
          if (elements && elements->count() == moves.size()) add_elements(*elements, 1, 3, moves);
        }
      }
      for (std::size_t k = 0; k < drawn.size(); ++k) {
        if (drawn[k]) to_.targets_[i].push_back(moves[k]);
      }
    }
  }

  void add_influences(const PrimitiveData& data, const std::vector<bool>& drawn) {
    const std::vector<InfluenceSet> sets = read_sets(data, drawn.size());
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (drawn[i]) add_influences(sets, i);
    }
  }

  void add_influences(const std::vector<InfluenceSet>& sets, std::size_t vertex) {
    const std::size_t first = to_.influences_.size();
    double sum = 0;
    for (const InfluenceSet& set : sets) {
      for (std::size_t k = 0; k < 4; ++k) {
        const float weight = set.weights[vertex][k];
        const float joint = set.joints[vertex][k];
        if (!(weight > 0) || !(joint < static_cast<float>(joints_))) continue;
        to_.influences_.push_back({static_cast<std::uint32_t>(joint), weight});
        sum += static_cast<double>(weight);
      }
    }
    if (to_.influences_.size() == first) {
      const float joint = sets.empty() ? 0 : sets.front().joints[vertex][0];
      const bool exists = joint < static_cast<float>(joints_);
      to_.influences_.push_back({exists ? static_cast<std::uint32_t>(joint) : 0, 1});
      sum = 1;
    }
    for (std::size_t k = first; k < to_.influences_.size(); ++k) {
      float& weight = to_.influences_[k].weight;
      weight = static_cast<float>(static_cast<double>(weight) / sum);
    }
    to_.influenced_.push_back(static_cast<std::uint32_t>(to_.influences_.size()));
  }

  const GeometrySource& source_;
  std::size_t joints_;
  MemoryBudget& budget_;
  PointBlocks& to_;
};

PointBlocks::PointBlocks(Vectors<3> points) : points_(std::move(points)) { build(); }

Result<PointBlocks> PointBlocks::read(const GeometrySource& source, const Mesh& mesh,
                                      std::size_t joints, bool morphs, MemoryBudget& budget) {
  PointBlocks blocks;
  if (morphs) {
    std::size_t targets = 0;
    for (const Primitive& each : mesh.primitives) targets = std::max(targets, each.targets.size());
    blocks.targets_.resize(targets);
  }
  Reader reader(source, joints, budget, blocks);
  for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
    const GeometryError error = reader.add(mesh.primitives[i], static_cast<std::uint32_t>(i));
    if (error == GeometryError::too_large) return Error{"has too many vertices"};
    if (error != GeometryError::none) return Error{"has geometry that cannot be read"};
  }
  blocks.build();
  return blocks;
}

void PointBlocks::build() {
  if (points_.empty()) return;
  levels_.push_back(lowest_level());
  while (levels_.back().boxes.size() > 1) levels_.push_back(level_above(levels_.back()));
}

PointBlocks::Level PointBlocks::lowest_level() const {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const FloatBox nothing{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  const auto add = [](FloatBox& box, const std::array<float, 3>& point) {
    for (std::size_t k = 0; k < 3; ++k) {
      box.least[k] = std::min(box.least[k], point[k]);
      box.greatest[k] = std::max(box.greatest[k], point[k]);
    }
  };
  Level level;
  const std::size_t blocks = (points_.size() + kInBlock - 1) / kInBlock;
  level.boxes.assign(blocks, nothing);
  level.deltas.assign(blocks * targets_.size(), nothing);
  if (!influenced_.empty()) level.joints.resize(blocks);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    add(level.boxes[i / kInBlock], points_[i]);
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      add(level.deltas[i / kInBlock * targets_.size() + t], targets_[t][i]);
    }
    if (influenced_.empty()) continue;
    for (std::size_t k = i == 0 ? 0 : influenced_[i - 1]; k < influenced_[i]; ++k) {
      std::vector<std::uint32_t>& joints = level.joints[i / kInBlock];
      const std::uint32_t joint = influences_[k].joint;
      if (std::find(joints.begin(), joints.end(), joint) == joints.end()) joints.push_back(joint);
    }
  }
  return level;
}

PointBlocks::Level PointBlocks::level_above(const Level& below) const {
  const auto join = [](FloatBox& box, const FloatBox& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      box.least[k] = std::min(box.least[k], other.least[k]);
      box.greatest[k] = std::max(box.greatest[k], other.greatest[k]);
    }
  };
  Level level;
  const std::size_t blocks = (below.boxes.size() + kFanout - 1) / kFanout;
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::size_t first = i * kFanout;
    const std::size_t last = std::min(first + kFanout, below.boxes.size());
    FloatBox box = below.boxes[first];
    for (std::size_t k = first + 1; k < last; ++k) join(box, below.boxes[k]);
    level.boxes.push_back(box);
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      FloatBox delta = below.deltas[first * targets_.size() + t];
      for (std::size_t k = first + 1; k < last; ++k) {
        join(delta, below.deltas[k * targets_.size() + t]);
      }
      level.deltas.push_back(delta);
    }
    if (below.joints.empty()) continue;
    std::vector<std::uint32_t>& joints = level.joints.emplace_back();
    for (std::size_t k = first; k < last; ++k) {
      joints.insert(joints.end(), below.joints[k].begin(), below.joints[k].end());
    }
    std::sort(joints.begin(), joints.end());
    joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  }
  return level;
}

// A skinned point is between those that its joints would make of it alone.
Box PointBlocks::bounds_of(const Level& level, std::size_t block,
                           const Placement& placement) const {
  Box box{widened(level.boxes[block].least), widened(level.boxes[block].greatest)};
  const std::size_t targets = std::min(targets_.size(), placement.weights.size());
  for (std::size_t t = 0; t < targets; ++t) {
    const auto weight = static_cast<double>(placement.weights[t]);
    if (weight == 0) continue;
    const FloatBox& delta = level.deltas[block * targets_.size() + t];
    const Vector3 least = widened(delta.least), greatest = widened(delta.greatest);
    for (std::size_t k = 0; k < 3; ++k) {
      box.least[k] += std::min(weight * least[k], weight * greatest[k]);
      box.greatest[k] += std::max(weight * least[k], weight * greatest[k]);
    }
  }
  if (level.joints.empty()) return moved_box(placement.matrices.front(), box);
  Box all;
  for (const std::uint32_t joint : level.joints[block]) {
    const Box moved = moved_box(placement.matrices[joint], box);
    all.add(moved.least);
    all.add(moved.greatest);
  }
  return all;
}

Vector3 PointBlocks::place(std::size_t index, const Placement& placement) const {
  Vector3 point = widened(points_[index]);
  const std::size_t targets = std::min(targets_.size(), placement.weights.size());
  for (std::size_t t = 0; t < targets; ++t) {
    const auto weight = static_cast<double>(placement.weights[t]);
    if (weight == 0) continue;
    const Vector3 delta = widened(targets_[t][index]);
    for (std::size_t k = 0; k < 3; ++k) point[k] += weight * delta[k];
  }
  if (influenced_.empty()) return placement.matrices.front().point(point);
  Vector3 placed{};
  for (std::size_t i = index == 0 ? 0 : influenced_[index - 1]; i < influenced_[index]; ++i) {
    const Vector3 moved = placement.matrices[influences_[i].joint].point(point);
    const auto weight = static_cast<double>(influences_[i].weight);
    for (std::size_t k = 0; k < 3; ++k) placed[k] += weight * moved[k];
  }
  return placed;
}

bool PointBlocks::visit(const Placement& placement, std::uint64_t& work,
                        PointWatcher& watcher) const {
  struct Step {
    std::size_t level, block;
  };
  if (levels_.empty()) return true;
  std::array<Step, kMostLevels * kFanout> open{};
  std::size_t count = 0;
  open[count++] = {levels_.size() - 1, 0};
  while (count > 0) {
    const auto [level, block] = open[--count];
    const Level& at = levels_[level];
    const std::uint64_t steps = at.joints.empty() ? 1 : at.joints[block].size();
    if (work < steps + kInBlock) return false;
    work -= steps;
    if (!watcher.wants(bounds_of(at, block, placement))) continue;
    if (level > 0) {
      const std::size_t last = std::min((block + 1) * kFanout, levels_[level - 1].boxes.size());
      for (std::size_t child = last; child > block * kFanout; --child) {
        open[count++] = {level - 1, child - 1};
      }
      continue;
    }
    const std::size_t last = std::min((block + 1) * kInBlock, points_.size());
    work -= last - block * kInBlock;
    for (std::size_t i = block * kInBlock; i < last; ++i) watcher.take(place(i, placement), i);
  }
  return true;
}

}  // namespace gltfx::model
