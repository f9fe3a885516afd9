// SPDX-License-Identifier: Apache-2.0
#include "prove/skinned_corners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include <fmt/format.h>

#include "model/keyframes.hpp"
#include "model/skin.hpp"
#include "prove/primitive_pair.hpp"

namespace gltfx::prove {
namespace {

using model::Affine;
using model::SemanticKind;
using model::Vector3;

constexpr std::size_t kMostAnimations = 8;
constexpr std::size_t kMostPosedNodes = std::size_t{1} << 22U;
constexpr int kMoments = 5;  // of an animation

Vector3 position_at(const Column& column, std::uint32_t vertex) {
  const Element at = column.at(vertex);
  return {at[0], at[1], at[2]};
}

void add_moved(Vector3& to, const Vector3& by) {
  for (std::size_t i = 0; i < 3; ++i) to[i] += by[i];
}

using StreamsByName = std::map<std::string, const Stream*, std::less<>>;

void read_influences(const StreamsByName& streams, const std::vector<std::uint32_t>& used,
                     ComparedCorners& corners) {
  const auto find = [&](const char* name, std::size_t set) {
    const auto found = streams.find(fmt::format("{}_{}", name, set));
    return found == streams.end() ? nullptr : found->second;
  };
  while (find("JOINTS", corners.sets) != nullptr && find("WEIGHTS", corners.sets) != nullptr)
    ++corners.sets;
  const std::size_t width = 4 * corners.sets;
  corners.here.resize(used.size() * width);
  corners.there.resize(used.size() * width);
  for (std::size_t set = 0; set < corners.sets; ++set) {
    const Stream& joints = *find("JOINTS", set);
    const Stream& weights = *find("WEIGHTS", set);
    const auto read = [&](const Column& joint, const Column& weight, std::vector<Influence>& to) {
      for (std::size_t i = 0; i < used.size(); ++i) {
        const Element j = joint.at(used[i]);
        const Element w = weight.at(used[i]);
        for (std::size_t k = 0; k < 4; ++k)
          to[i * width + 4 * set + k] = {static_cast<std::uint32_t>(j[k]), w[k]};
      }
    };
    read(joints.ours, weights.ours, corners.here);
    read(joints.theirs, weights.theirs, corners.there);
  }
}

// A vertex without weights follows its first joint.
Vector3 skinned(const Vector3& at, const Influence* influences, std::size_t count,
                const std::vector<Affine>& joints) {
  Vector3 sum{};
  double weights = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Influence& each = influences[i];
    if (each.weight == 0 || each.joint >= joints.size()) continue;
    const Vector3 moved = joints[each.joint].point(at);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += moved[k] * each.weight;
    weights += each.weight;
  }
  if (weights == 0) {
    return count > 0 && influences->joint < joints.size() ? joints[influences->joint].point(at)
                                                          : at;
  }
  for (double& each : sum) each /= weights;
  return sum;
}

}  // namespace

std::optional<ComparedCorners> read_corners(const Side& before, const Side& after,
                                            json::NodeId ours, json::NodeId theirs) {
  Differences told(0);
  const auto pair = open_pair(before, after, ours, theirs, told);
  if (!pair || pair->ours.indices != pair->theirs.indices) return std::nullopt;
  StreamsByName streams;
  std::vector<const Stream*> targets;
  for (const Stream& stream : pair->streams) {
    if (stream.of_target && stream.kind == SemanticKind::position && stream.components() == 3)
      targets.push_back(&stream);
    if (!stream.of_target) streams.emplace(stream.name, &stream);
  }
  const auto positions = streams.find("POSITION");
  if (positions == streams.end() || positions->second->components() != 3) return std::nullopt;
  std::vector<std::uint32_t> used;
  const std::uint64_t vertices = std::min(pair->ours.vertices, pair->theirs.vertices);
  for (const std::uint32_t index : pair->ours.indices) {
    if (index < vertices) used.push_back(index);
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  ComparedCorners corners;
  for (const std::uint32_t vertex : used) {
    Vector3 here = position_at(positions->second->ours, vertex);
    Vector3 there = position_at(positions->second->theirs, vertex);
    corners.rest.here.push_back(here);
    corners.rest.there.push_back(there);
    if (targets.empty()) continue;
    for (const Stream* target : targets) {
      add_moved(here, position_at(target->ours, vertex));
      add_moved(there, position_at(target->theirs, vertex));
    }
    corners.moved.here.push_back(here);
    corners.moved.there.push_back(there);
  }
  read_influences(streams, used, corners);
  return corners;
}

std::vector<PosePair> read_poses(const Side& before, const Side& after) {
  const model::SceneRoots here = model::choose_scene(before.asset(), before.views());
  const model::SceneRoots there = model::choose_scene(after.asset(), after.views());
  std::vector<PosePair> poses;
  const auto add = [&](const model::AnimatedValues& values) {
    poses.push_back({model::compute_pose(before.asset(), before.views(), here, values),
                     model::compute_pose(after.asset(), after.views(), there, values)});
  };
  add({});
  if (before.asset().count(model::RootArray::skins) == 0) return poses;
  std::size_t size = before.views().nodes.size();
  for (const json::NodeId skin : before.asset().elements(model::RootArray::skins)) {
    if (skin != json::kNoNode)
      size += static_cast<std::size_t>(model::read_skin(before.asset(), skin).joint_count);
  }
  const auto& animations = before.views().animations;
  for (std::uint32_t i = 0; i < std::min(animations.size(), kMostAnimations); ++i) {
    if (animations[i].object == json::kNoNode) continue;
    const double length = model::duration_of(before.asset(), before.views(), animations[i]);
    for (int k = 0; k < kMoments; ++k) {
      if ((poses.size() + 1) * size > kMostPosedNodes) return poses;
      add(model::sample_animation(before.asset(), before.views(), before.resources(),
                                  before.graph().set(), i, length * k / (kMoments - 1))
              .values);
    }
  }
  return poses;
}

JointPair read_joints(const Side& before, const Side& after,
                      const std::pair<std::uint32_t, std::uint32_t>& skins, const PosePair& pose) {
  return {model::joint_matrices(before.asset(), before.views(), before.resources(), skins.first,
                                pose.here),
          model::joint_matrices(after.asset(), after.views(), after.resources(), skins.second,
                                pose.there)};
}

double farthest_skinned(const ComparedCorners& corners, const JointPair& joints) {
  const auto& [here, there] = joints;
  if (here.empty() && there.empty()) return 0;
  if (here.size() != there.size()) return std::numeric_limits<double>::infinity();
  const std::size_t width = 4 * corners.sets;
  double farthest = 0;
  for (const CornerList* list : {&corners.rest, &corners.moved}) {
    for (std::size_t i = 0; i < list->here.size(); ++i) {
      const Vector3 a = skinned(list->here[i], corners.here.data() + i * width, width, here);
      const Vector3 b = skinned(list->there[i], corners.there.data() + i * width, width, there);
      const double away = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      if (std::isnan(away)) continue;  // of values that are not finite in both
      farthest = std::max(farthest, away);
    }
  }
  return farthest;
}

}  // namespace gltfx::prove
