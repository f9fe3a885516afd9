// SPDX-License-Identifier: Apache-2.0
#include "prove/drawn_items.hpp"

#include <algorithm>

#include "model/skin.hpp"
#include "prove/curves.hpp"

namespace gltfx::prove {
namespace {

// Says whether a node is drawn.
constexpr std::string_view kVisibility = "KHR_node_visibility";

std::vector<model::NodeIndex> roots_of_all_scenes(const Content& content) {
  std::vector<model::NodeIndex> roots;
  const std::uint32_t list = content.list("/scenes");
  const auto count = list == kNoItem ? 0 : content.lists()[list].items.size();
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::vector<std::uint32_t> nodes = nodes_of_scene(content, {list, i});
    roots.insert(roots.end(), nodes.begin(), nodes.end());
  }
  return roots;
}

}  // namespace

std::vector<bool> find_pointed_items(const Content& content, std::uint32_t list) {
  std::vector<bool> pointed(list == kNoItem ? 0 : content.lists()[list].items.size(), false);
  for (const graph::PointerText& pointer : content.side().graph().pointers()) {
    for (const json::NodeId value : pointer.way) {
      const ItemId item = content.find(value);
      if (item && item.list == list) pointed[item.index] = true;
    }
  }
  return pointed;
}

bool is_never_drawn(const Content& content, std::string_view extension) {
  const schema::Set& set = content.side().graph().set();
  const schema::ExtensionId id = set.find_extension(extension);
  return id != schema::kNone && set.extensions()[id].undrawn;
}

bool is_drawn_extension(const Content& content, std::string_view name, json::NodeId extension) {
  const Side& side = content.side();
  return side.document().is_object(extension) && side.graph().type(extension) != schema::kNone &&
         !content.storage().contains(name) && !is_never_drawn(content, name);
}

bool places_copies(std::string_view extension) { return extension == "EXT_mesh_gpu_instancing"; }

bool keeps_visible(const json::Document& document, std::string_view name, json::NodeId extension) {
  if (name != kVisibility) return false;
  const json::NodeId visible = document.find(extension, "visible");
  return visible == json::kNoNode || document.raw(visible) == "true";
}

DrawnItems::DrawnItems(const Content& content, const NodeTree& nodes)
    : content_(content), nodes_(nodes), list_(content.list("/nodes")) {
  find_scene();
  find_shown();
  find_reached();
}

void DrawnItems::find_scene() {
  const Side& side = content_.side();
  model::SceneRoots roots = model::choose_scene(side.asset(), side.views());
  if (roots.scene) roots.nodes = roots_of_all_scenes(content_);
  pose_ = model::compute_pose(side.asset(), side.views(), roots);
}

bool DrawnItems::has_drawn_extension(const model::Node& node) const {
  const Side& side = content_.side();
  if (node.extensions == json::kNoNode || !side.document().is_object(node.extensions)) return false;
  for (const auto member : side.document().members(node.extensions)) {
    const std::string_view name = side.document().key(member.key_id);
    if (!is_drawn_extension(content_, name, member.value)) continue;
    if (!places_copies(name) && name != kVisibility) return true;
  }
  return false;
}

bool DrawnItems::shows_itself(std::uint32_t node) const {
  if (!in_scene(node)) return false;
  const model::Node& described = content_.side().views().nodes[node];
  if (has_drawn_extension(described)) return true;
  if (!described.mesh) return false;
  const auto& surfaces = content_.surfaces(*described.mesh);
  return std::any_of(surfaces.begin(), surfaces.end(), [](const Surface& each) {
    return each.primitive != json::kNoNode && (!each.readable || each.elements > 0);
  });
}

void DrawnItems::find_shown() {
  const Side& side = content_.side();
  shows_.assign(nodes_.size(), false);
  std::vector<bool> used(side.asset().count(model::RootArray::skins));
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    shows_[node] = shows_itself(node);
    const auto& skin = side.views().nodes[node].skin;
    if (shows_[node] && skin && *skin < used.size()) used[*skin] = true;
  }
  const auto& skins = side.asset().elements(model::RootArray::skins);
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i] || skins[i] == json::kNoNode) continue;
    for (const model::NodeIndex joint : model::read_skin(side.asset(), skins[i]).joint_nodes) {
      shows_[joint] = true;
    }
  }
  for (auto at = nodes_.order().rbegin(); at != nodes_.order().rend(); ++at) {
    const model::NodeIndex above = nodes_.parent(*at);
    if (shows_[*at] && above != model::kNoNodeIndex) shows_[above] = true;
  }
}

void DrawnItems::reach(ItemId item, std::vector<ItemId>& open) {
  if (!item || reached_[item.list][item.index]) return;
  reached_[item.list][item.index] = true;
  open.push_back(item);
}

void DrawnItems::find_reached() {
  std::vector<ItemId> open;
  for (const ItemList& list : content_.lists()) reached_.emplace_back(list.items.size());
  for (const char* pointer : {"/scenes", "/animations"}) {
    const std::uint32_t list = content_.list(pointer);
    const auto count = list == kNoItem ? 0 : content_.lists()[list].items.size();
    for (std::uint32_t i = 0; i < count; ++i) reach({list, i}, open);
  }
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    if (in_scene(node) || shows_[node]) reach({list_, node}, open);
  }
  for (std::uint32_t i = content_.root().first; i < content_.root().last; ++i) {
    reach(content_.leaves()[i].target, open);
  }
  const std::uint32_t animations = content_.list("/animations");
  while (!open.empty()) {
    const ItemId from = open.back();
    open.pop_back();
    const Item& item = content_.item(from);
    for (std::uint32_t i = item.first; i < item.last; ++i) {
      const ItemId target = content_.leaves()[i].target;
      // What an animation moves is drawn only if something else leads to it.
      if (from.list != animations) reach(target, open);
    }
  }
}

std::vector<float> DrawnItems::rest_of(const model::AnimationChannel& channel) const {
  const Side& side = content_.side();
  const LocalPlace& place = nodes_.local(*channel.node);
  const auto list = [](const auto& values) {
    std::vector<float> numbers;
    for (const double value : values) numbers.push_back(static_cast<float>(value));
    return numbers;
  };
  switch (channel.path) {
    case model::AnimationPath::translation:
      return list(place.translation);
    case model::AnimationPath::rotation:
      return list(place.rotation);
    case model::AnimationPath::scale:
      return list(place.scale);
    case model::AnimationPath::weights:
      return model::morph_weights(side.asset(), side.views(), *channel.node);
    default:
      return {};
  }
}

bool DrawnItems::is_moved_by(const model::AnimationChannel& channel) const {
  constexpr double kRounding = 1e-6;
  if (!channel.sampler) return false;
  if (!channel.node) return true;
  if (!shows_[*channel.node]) return false;
  const std::vector<float> rest = rest_of(channel);
  const auto motion = open_motion(content_.side(), channel.object);
  if (!motion || rest.empty() || nodes_.local(*channel.node).is_matrix) return true;
  const bool rotation = motion->path == model::AnimationPath::rotation;
  const auto moves_at = [&](double moment) {
    const std::vector<float> value = motion->at(moment);
    return value.size() != rest.size() || value_distance(value, rest, rotation) > kRounding;
  };
  for (std::uint64_t k = 0; k < motion->curve.times.count(); ++k) {
    const double time = motion->time(k);
    if (moves_at(time)) return true;
    if (k > 0 && moves_at((motion->time(k - 1) + time) / 2)) return true;
  }
  return false;
}

bool DrawnItems::hides(const std::string& pointer) const {
  const graph::Tree& tree = content_.side().tree();
  json::NodeId at = tree.find(pointer).node;
  while (at != json::kNoNode && at != 0) {
    if (const ItemId item = content_.find(at)) {
      return !reaches(item) || (item.list == list_ && !shows_[item.index]);
    }
    at = tree.parent(at);
  }
  return false;
}

}  // namespace gltfx::prove
