// SPDX-License-Identifier: Apache-2.0
#include "prove/rigid_surfaces.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "model/skin.hpp"

namespace gltfx::prove {
namespace {

// The number after the name of a list in a pointer.
std::optional<std::size_t> index_in(std::string_view pointer, std::string_view list) {
  if (!pointer.starts_with(list)) return std::nullopt;
  std::size_t number = 0;
  const auto read =
      std::from_chars(pointer.data() + list.size(), pointer.data() + pointer.size(), number);
  return read.ec == std::errc() ? std::optional(number) : std::nullopt;
}

bool at(const std::vector<bool>& list, std::size_t index) {
  return index < list.size() && list[index];
}

bool moves_nodes(model::AnimationPath path) {
  return path == model::AnimationPath::translation || path == model::AnimationPath::rotation ||
         path == model::AnimationPath::scale;
}

}  // namespace

RigidSurfaces::RigidSurfaces(const Content& content, const NodeTree& nodes,
                             const model::SceneRoots& scene, Motions motions,
                             const std::vector<bool>& kept)
    : content_(content), nodes_(nodes), scene_(scene) {
  const Side& side = content.side();
  in_scene_ = model::compute_pose(side.asset(), side.views(), scene).in_scene;
  find_rigid(find_moved(motions), kept);
  count();
}

// Nodes that something moves and that do not count.
std::vector<bool> RigidSurfaces::find_moved(Motions motions) const {
  if (motions == Motions::all) return std::vector<bool>(nodes_.size(), false);
  std::vector<bool> moved = find_pointed_items(content_, content_.list("/nodes"));
  moved.resize(nodes_.size(), false);
  const Side& side = content_.side();
  for (const model::Animation& animation : side.views().animations) {
    for (const model::AnimationChannel& channel : animation.channels) {
      if (channel.node) moved[*channel.node] = true;
    }
  }
  for (const std::uint32_t node : nodes_.order()) {
    const model::NodeIndex above = nodes_.parent(node);
    if (above != model::kNoNodeIndex && moved[above]) moved[node] = true;
  }
  return moved;
}

std::vector<bool> RigidSurfaces::find_joints() const {
  const Side& side = content_.side();
  std::vector<bool> joints(nodes_.size(), false);
  for (const json::NodeId skin : side.asset().elements(model::RootArray::skins)) {
    if (skin == json::kNoNode) continue;
    for (const model::NodeIndex joint : model::read_skin(side.asset(), skin).joint_nodes) {
      joints[joint] = true;
    }
  }
  return joints;
}

void RigidSurfaces::find_rigid(const std::vector<bool>& moved, const std::vector<bool>& kept) {
  const auto& views = content_.side().views();
  const std::vector<bool> joints = find_joints();
  const std::vector<bool> animated = find_moved(Motions::none);
  rigid_.assign(nodes_.size(), false);
  more_.assign(nodes_.size(), false);
  whole_.assign(nodes_.size(), true);
  meshes_.assign(views.meshes.size(), true);
  for (const std::uint32_t node : nodes_.order()) {
    const model::Node& described = views.nodes[node];
    const bool alone = !says_more(described.object, true);
    const bool mesh = described.mesh.has_value();
    rigid_[node] = mesh && !moved[node] && is_rigid_mesh(described);
    if (mesh && !rigid_[node]) meshes_[*described.mesh] = false;
    more_[node] = !alone || (mesh && !rigid_[node]);
    const bool plain = !joints[node] && !more_[node];
    whole_[node] = !moved[node] && (plain || (kept[node] && !animated[node]));
  }
  for (auto each = nodes_.order().rbegin(); each != nodes_.order().rend(); ++each) {
    const model::NodeIndex above = nodes_.parent(*each);
    if (!whole_[*each] && above != model::kNoNodeIndex) whole_[above] = false;
  }
}

bool RigidSurfaces::is_rigid_mesh(const model::Node& node) const {
  if (node.skin) return false;
  const auto& primitives = content_.side().views().meshes[*node.mesh].primitives;
  return std::all_of(primitives.begin(), primitives.end(), [&](const model::Primitive& each) {
    return each.targets.empty() && !each.targets_are_broken && !says_more(each.node, false);
  });
}

// Whether a primitive or a node has an extension that draws anything but its surfaces, such as
// materials of variants, or a light.
bool RigidSurfaces::says_more(json::NodeId owner, bool of_node) const {
  if (owner == json::kNoNode) return false;
  const json::Document& document = content_.side().document();
  const json::NodeId extensions = document.find(owner, "extensions");
  if (extensions == json::kNoNode || !document.is_object(extensions)) return false;
  for (const auto member : document.members(extensions)) {
    const std::string_view name = document.key(member.key_id);
    if (!is_drawn_extension(content_, name, member.value)) continue;
    if (!of_node || !places_copies(name)) return true;
  }
  return false;
}

void RigidSurfaces::count() {
  const Side& side = content_.side();
  model::MemoryBudget budget(kMostElements * sizeof(model::Affine));
  for (const std::uint32_t node : nodes_.order()) {
    if (in_scene_[node] == 0 || !rigid_[node]) continue;
    const model::Node& described = side.views().nodes[node];
    PlacedCopies placed{node, read_copies(side, described, budget)};
    const std::uint64_t copies = placed.copies ? placed.copies->size() : 1;
    for (const Surface& surface : content_.surfaces(*described.mesh)) {
      if (surface.primitive != json::kNoNode) elements_ += copies * (surface.elements + 1);
    }
    placed_.push_back(std::move(placed));
    if (!fits()) return;
  }
}

std::vector<SurfacePiece> RigidSurfaces::pieces(const model::AnimatedValues& animated) const {
  const Side& side = content_.side();
  model::Pose pose;
  if (!animated.empty()) {
    pose = model::compute_pose(side.asset(), side.views(), scene_, animated);
  }
  std::vector<SurfacePiece> all;
  for (const PlacedCopies& placed : placed_) {
    const model::Affine& world =
        animated.empty() ? nodes_.world(placed.node) : pose.world[placed.node];
    const auto add = [&](const model::Affine& place) {
      for (const Surface& surface : content_.surfaces(*side.views().nodes[placed.node].mesh)) {
        if (surface.primitive == json::kNoNode) continue;
        all.push_back({&content_, surface.primitive, surface.material, place, nullptr, &surface});
      }
    };
    if (!placed.copies) {
      add(world);
    } else {
      for (const model::Affine& copy : *placed.copies) add(world * copy);
    }
  }
  return all;
}

bool RigidSurfaces::covers_animation(std::uint32_t animation) const {
  const auto& animations = content_.side().views().animations;
  if (animation >= animations.size()) return false;
  const auto& channels = animations[animation].channels;
  return std::all_of(channels.begin(), channels.end(), [&](const auto& channel) {
    return channel.node && moves_nodes(channel.path) && whole_[*channel.node];
  });
}

bool RigidSurfaces::covers(const std::optional<std::string>& pointer) const {
  if (!pointer) return true;
  if (const auto node = index_in(*pointer, "/nodes/")) {
    if (*node < rigid_.size() && pointer->ends_with("/mesh")) {
      const auto& mesh = content_.side().views().nodes[*node].mesh;
      return !mesh || rigid_[*node];
    }
    return at(whole_, *node);
  }
  if (const auto mesh = index_in(*pointer, "/meshes/")) return at(meshes_, *mesh);
  if (const auto animation = index_in(*pointer, "/animations/")) {
    return covers_animation(static_cast<std::uint32_t>(*animation));
  }
  return index_in(*pointer, "/scenes/").has_value();
}

bool RigidSurfaces::covers_value(const std::optional<std::string>& pointer) const {
  if (!pointer) return true;
  const auto node = index_in(*pointer, "/nodes/");
  const bool more = node && at(more_, *node) && !pointer->ends_with("/mesh");
  return !more && covers(pointer);
}

}  // namespace gltfx::prove
