// SPDX-License-Identifier: Apache-2.0
// Moves large offsets of vertices into their nodes, and those of nodes into their parents.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/disjoint_sets.hpp"
#include "model/scene_box.hpp"
#include "model/scene_graph.hpp"
#include "model/skin.hpp"
#include "report/wording.hpp"
#include "steps/node_moves.hpp"

namespace gltfx::steps {
namespace {

using model::Affine;
using model::Box;
using model::NodeIndex;
using model::Vector3;

// An offset is large if it is greater than both: single precision then costs more than the size.
constexpr double kFar = 4096;
constexpr double kTimesSize = 2;

Vector3 added(const Vector3& a, const Vector3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vector3 negative(const Vector3& a) { return {-a[0], -a[1], -a[2]}; }
bool is_zero(const Vector3& a) { return a == Vector3{}; }

// The large part of the place of a box. All coordinates of a box are within a factor of two of that
// part, so that differences are exact in single precision (Sterbenz).
Vector3 large_offset(const Box& box) {
  Vector3 offset{};
  if (box.empty()) return offset;
  const Vector3 center = box.center();
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_large =
        std::abs(center[i]) >= kFar && std::abs(center[i]) >= kTimesSize * box.diagonal();
    if (is_large) offset[i] = static_cast<double>(static_cast<float>(std::round(center[i])));
  }
  return offset;
}

/// Meshes that share positions.
struct MeshGroup {
  std::vector<std::uint32_t> meshes;
  std::set<std::uint32_t> accessors;  ///< positions
  Box box;
  std::string obstacle;
};

class Rebaser {
 public:
  explicit Rebaser(const StepInput& input)
      : data_(input), changes_(data_), graph_(data_.asset, data_.views.nodes) {
    shift_.resize(data_.views.nodes.size());
    find_fixed();
    users_.resize(data_.views.meshes.size());
    for (NodeIndex i = 0; i < data_.views.nodes.size(); ++i) {
      if (data_.views.nodes[i].mesh) users_[*data_.views.nodes[i].mesh].push_back(i);
    }
  }

  Result<StepOutcome> run() {
    move_vertices();
    move_up();
    NodeMoves moves;
    for (NodeIndex i = 0; i < shift_.size(); ++i) {
      if (!is_zero(shift_[i])) moves[i] = {1, shift_[i], false};
    }
    if (moves.empty()) return std::move(outcome_);
    const double measured = measure(moves);
    outcome_.row.refused = move_nodes(data_, moves, changes_);
    if (!outcome_.row.refused.empty()) return std::move(outcome_);
    if (measured > bound_) return Error{"positions would move by more than their precision"};
    auto change = changes_.finish();
    if (!change) return change.error();
    outcome_.change = *std::move(change);
    outcome_.freedom.own_proof = true;
    if (measured > 0) outcome_.row.losses.push_back({"positions", bound_, measured, " m"});
    outcome_.row.what = report::counted(moves.size(), "node");
    if (!moved_.empty()) {
      outcome_.row.what += fmt::format(" and the vertices of {} {}", moved_.size(),
                                       moved_.size() == 1 ? "mesh" : "meshes");
    }
    return std::move(outcome_);
  }

 private:
  const model::Node& node(NodeIndex index) const { return data_.views.nodes[index]; }

  // Nodes whose own space must stay: joints, animated ones, those that something else refers to.
  void find_fixed() {
    fixed_.assign(data_.views.nodes.size(), {});
    for (NodeIndex i = 0; i < fixed_.size(); ++i) {
      if (node(i).object == json::kNoNode || graph_.on_loop(i)) {
        fixed_[i] = "is not a node of a tree";
      } else if (node(i).camera || node(i).extensions != json::kNoNode) {
        fixed_[i] = "is a node with a camera or an extension";
      } else if (data_.document.holds(node(i).object, "externalAsset") ||
                 data_.document.holds(node(i).object, "boundingVolume")) {
        fixed_[i] = "is a node with an external asset or a bounding volume";
      } else if (node(i).skin) {
        fixed_[i] = "is a node with a skin";
      }
    }
    for (const json::NodeId skin : data_.asset.elements(model::RootArray::skins)) {
      for (const NodeIndex joint : model::read_skin(data_.asset, skin).joint_nodes)
        fixed_[joint] = "is a joint";
    }
    for (const model::Animation& animation : data_.views.animations) {
      for (const model::AnimationChannel& channel : animation.channels) {
        if (!channel.node || channel.path == model::AnimationPath::weights) continue;
        fixed_[*channel.node] = "is an animated node";
        animated_.insert(*channel.node);
      }
    }
    const json::NodeId nodes = data_.document.find(data_.document.root(), "nodes");
    for (const graph::Use& use : data_.graph.uses()) {
      if (data_.graph.tree().parent(use.target) != nodes || is_of_scene_graph(use)) continue;
      fixed_[data_.graph.tree().position(use.target)] = "is a node that other objects refer to";
    }
    for (const graph::PointerText& pointer : data_.graph.pointers()) {
      if (pointer.way.empty() || pointer.steps.front() != "nodes") continue;
      if (pointer.varying != json::kNoNode || pointer.way.size() < 2) {
        for (std::string& each : fixed_) each = "is a node that a pointer may change";
        return;
      }
      fixed_[data_.graph.tree().position(pointer.way[1])] = "is a node that a pointer may change";
    }
  }

  // Lists of children and scenes, and channels, which are looked at on their own.
  bool is_of_scene_graph(const graph::Use& use) const {
    const graph::Tree& tree = data_.graph.tree();
    const json::NodeId owner = tree.root_element(use.at.node);
    if (owner == json::kNoNode || use.kind != graph::UseKind::index) return false;
    const std::string_view list = tree.name(tree.parent(owner));
    const json::NodeId at = use.at.element ? use.at.node : tree.parent(use.at.node);
    if (list == "nodes" || list == "scenes") return tree.parent(at) == owner;
    return list == "animations" || list == "skins";
  }

  void move_vertices() {
    std::vector<MeshGroup> groups = find_groups();
    Box all;
    for (const MeshGroup& group : groups) {
      if (!group.obstacle.empty() || group.box.empty()) continue;
      all.add(group.box.least);
      all.add(group.box.greatest);
    }
    const Vector3 common = large_offset(all);  // one offset for all keeps their seams shut
    for (const MeshGroup& group : groups) {
      Vector3 offset = large_offset(group.box);
      if (is_zero(offset)) continue;
      std::string why = group.obstacle;
      for (std::size_t i = 0; i < 3; ++i) {
        if (common[i] != 0) offset[i] = common[i];
      }
      if (why.empty()) why = store(group, offset);
      if (!why.empty()) {
        outcome_.row.left.push_back(
            {data_.pointer(data_.views.meshes[group.meshes.front()].node), std::move(why)});
        continue;
      }
      for (const std::uint32_t mesh : group.meshes) {
        moved_[mesh] = offset;
        for (const NodeIndex index : users_[mesh]) lift(index, offset);
      }
    }
  }

  std::vector<MeshGroup> find_groups() {
    const auto& meshes = data_.views.meshes;
    DisjointSets sets(meshes.size());
    std::map<std::uint32_t, std::pair<std::uint32_t, std::uint64_t>> readers;  // mesh, uses
    for (std::uint32_t i = 0; i < meshes.size(); ++i) {
      for (const model::Primitive& primitive : meshes[i].primitives) {
        const model::Attribute* const at = primitive.find(model::SemanticKind::position);
        if (at == nullptr || !at->accessor) continue;
        auto& reader = readers.try_emplace(*at->accessor, i, 0).first->second;
        ++reader.second;
        sets.join(reader.first, i);
      }
    }
    std::map<std::uint32_t, std::uint32_t> places;
    std::vector<MeshGroup> groups;
    for (std::uint32_t i = 0; i < meshes.size(); ++i) {
      const auto [place, is_new] =
          places.try_emplace(sets.find(i), static_cast<std::uint32_t>(groups.size()));
      if (is_new) groups.emplace_back();
      MeshGroup& group = groups[place->second];
      group.meshes.push_back(i);
      if (group.obstacle.empty()) group.obstacle = obstacle_of(i);
    }
    for (const auto& [accessor, reader] : readers) {
      MeshGroup& group = groups[places.at(sets.find(reader.first))];
      group.accessors.insert(accessor);
      std::string why = read_box(accessor, reader.second, group.box);
      if (group.obstacle.empty()) group.obstacle = std::move(why);
    }
    return groups;
  }

  std::string obstacle_of(std::uint32_t mesh) const {
    const json::NodeId object = data_.views.meshes[mesh].node;
    if (object == json::kNoNode) return {};
    if (data_.graph.users(object).size() != users_[mesh].size())
      return "is a mesh that objects other than nodes refer to";
    for (const NodeIndex user : users_[mesh]) {
      if (!fixed_[user].empty())
        return fmt::format("{} {}", data_.pointer(node(user).object), fixed_[user]);
      for (const NodeIndex child : children_of(user)) {
        if (animated_.contains(child))
          return fmt::format("{} is an animated child", data_.pointer(node(child).object));
      }
    }
    return {};
  }

  // By the declared bounds, so that assets that are at the origin take no time.
  std::string read_box(std::uint32_t index, std::uint64_t uses, Box& box) const {
    const model::Accessor& accessor = data_.views.accessors[index];
    const auto least = model::float_array<3>(data_.document, accessor.min);
    const auto greatest = model::float_array<3>(data_.document, accessor.max);
    if (!least || !greatest) return "has positions without bounds";
    for (const auto& corner : {*least, *greatest})
      box.add({double{corner[0]}, double{corner[1]}, double{corner[2]}});
    const model::Format wanted{model::ElementType::vec3, model::ComponentType::float32, false};
    if (accessor.format != wanted) return "has positions that are not single-precision numbers";
    if (data_.graph.users(accessor.node).size() != uses)
      return "shares its positions with objects other than primitives";
    return {};
  }

  // Why positions stay; empty: they change.
  std::string store(const MeshGroup& group, const Vector3& offset) {
    std::map<std::uint32_t, NewElements> all;
    for (const std::uint32_t accessor : group.accessors) {
      std::optional<model::AccessorData> data;
      if (std::string why = data_.open(accessor, data); !why.empty()) return why;
      NewElements elements{packed_bytes(*data), data->count(), true};
      for (std::size_t i = 0; i < 3 * data->count(); ++i) {
        float value = 0;
        char* const at = elements.bytes.data() + i * sizeof(float);
        std::memcpy(&value, at, sizeof(value));
        const double exact = static_cast<double>(value) - offset[i % 3];
        const auto moved = static_cast<float>(exact);
        if (static_cast<double>(moved) != exact && offset[i % 3] != 0)
          return "has positions outside of their bounds";
        std::memcpy(at, &moved, sizeof(moved));
      }
      all[accessor] = std::move(elements);
    }
    for (auto& [accessor, elements] : all) changes_.contents.set(accessor, std::move(elements));
    return {};
  }

  std::vector<NodeIndex> children_of(NodeIndex index) const {
    std::vector<NodeIndex> children;
    model::for_each_index(data_.asset, node(index).children, model::RootArray::nodes,
                          [&](std::uint64_t, std::optional<std::uint32_t> child, Span) {
                            if (child) children.push_back(*child);
                          });
    return children;
  }

  // The transform of a node with its shift.
  Affine local(NodeIndex index) const {
    Affine transform;
    if (!read_exact_transform(data_.document, node(index), transform).empty()) return {};
    transform.columns[3] = added(transform.columns[3], shift_[index]);
    return transform;
  }

  // Moves the origin of a node to `offset` in its own space, without moving its children.
  void lift(NodeIndex index, const Vector3& offset) {
    shift_[index] = added(shift_[index], local(index).vector(offset));
    for (const NodeIndex child : children_of(index))
      shift_[child] = added(shift_[child], negative(offset));
  }

  // From the leaves to the roots: a node whose children are all far away moves there.
  void move_up() {
    std::vector<NodeIndex> order;  // parents first
    for (NodeIndex i = 0; i < shift_.size(); ++i) {
      if (graph_.is_root(i) && node(i).object != json::kNoNode) order.push_back(i);
    }
    std::vector<bool> known(shift_.size(), false);
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (const NodeIndex child : children_of(order[i])) {
        if (graph_.parent(child) != order[i] || known[child]) continue;
        known[child] = true;
        order.push_back(child);
      }
    }
    for (auto at = order.rbegin(); at != order.rend(); ++at) move_up(*at);
  }

  void move_up(NodeIndex index) {
    const std::vector<NodeIndex> children = children_of(index);
    if (children.empty() || node(index).mesh || !fixed_[index].empty()) return;
    Box box;
    for (const NodeIndex child : children) {
      if (animated_.contains(child)) return;
      box.add(local(child).columns[3]);
    }
    const Vector3 offset = large_offset(box);
    if (!is_zero(offset)) lift(index, offset);
  }

  std::vector<Affine> world_of(const NodeMoves* moves) const {
    std::vector<Affine> world(shift_.size());
    std::vector<NodeIndex> open;
    const auto enter = [&](NodeIndex index, const Affine& parent) {
      Affine own;
      if (!read_exact_transform(data_.document, node(index), own).empty()) return;
      const auto move = moves == nullptr ? NodeMoves::const_iterator() : moves->find(index);
      if (moves != nullptr && move != moves->end()) {
        for (std::size_t i = 0; i < 3; ++i)
          own.columns[3][i] = rounded(own.columns[3][i] + move->second.shift[i]);
      }
      world[index] = parent * own;
      open.push_back(index);
    };
    for (NodeIndex i = 0; i < shift_.size(); ++i) {
      if (graph_.is_root(i) && node(i).object != json::kNoNode) enter(i, {});
    }
    while (!open.empty()) {
      const NodeIndex index = open.back();
      open.pop_back();
      for (const NodeIndex child : children_of(index)) {
        if (graph_.parent(child) == index) enter(child, world[index]);
      }
    }
    return world;
  }

  // The greatest distance of a corner of a mesh in its scene. The bound: half the step of single
  // precision there.
  double measure(const NodeMoves& moves) {
    const std::vector<Affine> before = world_of(nullptr), after = world_of(&moves);
    double measured = 0, reach = 0;
    for (NodeIndex i = 0; i < shift_.size(); ++i) {
      Vector3 offset{};
      const auto found = node(i).mesh ? moved_.find(*node(i).mesh) : moved_.end();
      if (found != moved_.end()) offset = found->second;
      const Vector3 old = before[i].point(offset);
      const Vector3 now = after[i].point({});
      for (std::size_t k = 0; k < 3; ++k) {
        reach = std::max(reach, std::abs(old[k]));
        // A node that moves without a mesh takes its origin along: its children tell.
        if (node(i).mesh) measured = std::max(measured, std::abs(old[k] - now[k]));
      }
    }
    bound_ = reach * static_cast<double>(std::numeric_limits<float>::epsilon()) / 2;
    return measured;
  }

  const StepData data_;
  StepChanges changes_;
  const model::SceneGraph graph_;
  std::vector<std::string> fixed_;             ///< by node: why it stays; empty: it may change
  std::set<NodeIndex> animated_;               ///< whose transform changes with time
  std::vector<std::vector<NodeIndex>> users_;  ///< by mesh
  std::vector<Vector3> shift_;                 ///< by node, of its translation
  std::map<std::uint32_t, Vector3> moved_;     ///< what was subtracted, by mesh
  StepOutcome outcome_;
  double bound_ = 0;
};

}  // namespace

StepDescription rebase_step();
StepDescription rebase_step() {
  return {"rebase",
          "moves large offsets of vertices into their nodes, and those of nodes into their parents",
          "the place of every vertex in the scene",
          "less than half a step of single precision",
          [](const ConvertOptions& options) { return options.placement.rebase; },
          [](const StepInput& input) { return Rebaser(input).run(); }};
}

}  // namespace gltfx::steps
