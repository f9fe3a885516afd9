// SPDX-License-Identifier: Apache-2.0
#include "steps/mesh_places.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "base/number.hpp"
#include "model/elements.hpp"
#include "model/instancing.hpp"
#include "model/longest_axis.hpp"
#include "model/skin.hpp"

namespace gltfx::steps {
namespace {

using model::Affine;
using model::AnimationPath;
using model::NodeIndex;
using model::Vector3;

template <std::size_t N>
std::array<float, N> single(const std::array<double, N>& from) {
  std::array<float, N> to{};
  for (std::size_t i = 0; i < N; ++i) to[i] = static_cast<float>(from[i]);
  return to;
}

template <std::size_t N>
std::array<double, N> wide(const std::array<float, N>& from) {
  std::array<double, N> to{};
  for (std::size_t i = 0; i < N; ++i) to[i] = static_cast<double>(from[i]);
  return to;
}

constexpr const char* kTooManyJoints = "shares its skin with too many others";

// From steps of a grid to coordinates.
Affine transform_of(const Grid& grid) {
  Affine affine;
  for (std::size_t i = 0; i < 3; ++i) affine.columns[i][i] = grid.step;
  affine.columns[3] = grid.origin;
  return affine;
}

std::array<float, 16> matrix_of(const Affine& affine) {
  std::array<float, 16> matrix{};
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 3; ++row) {
      matrix[4 * column + row] = static_cast<float>(affine.columns[column][row]);
    }
  }
  matrix[15] = 1;
  return matrix;
}

/// The transform of a node after it took up a grid, as it will be written.
struct NewTransform {
  std::optional<std::array<float, 16>> matrix;
  std::optional<std::array<float, 3>> translation;  ///< nothing: unchanged
  std::array<float, 3> scale{1, 1, 1};
  Affine affine;
};

NewTransform with_grid(const model::Asset& asset, const model::Node& node, const Grid& grid) {
  const model::Transform old = model::read_transform(asset.document(), node);
  const Affine exact = model::stored_transform(asset, node);
  NewTransform now;
  if (old.matrix) {
    now.matrix = matrix_of(exact * transform_of(grid));
    now.affine = Affine::from_matrix(*now.matrix);
    return now;
  }
  Vector3 translation = exact.columns[3];
  if (grid.origin != Vector3{}) {
    now.translation = single(exact.point(grid.origin));
    translation = wide(*now.translation);
  }
  const std::array<float, 3> scale = old.scale.value_or(std::array<float, 3>{1, 1, 1});
  for (std::size_t i = 0; i < 3; ++i) {
    now.scale[i] = static_cast<float>(static_cast<double>(scale[i]) * grid.step);
  }
  const auto rotation = wide(old.rotation.value_or(std::array<float, 4>{0, 0, 0, 1}));
  now.affine = Affine::from_parts(translation, rotation, wide(now.scale));
  return now;
}

double distance(const Vector3& a, const Vector3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Both are affine: the greatest distance is at a corner.
double farthest_corner(const Affine& exact, const Affine& now, double size) {
  double farthest = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vector3 at{};
    for (std::size_t i = 0; i < 3; ++i) at[i] = (corner >> i & 1U) != 0 ? size : 0;
    const double away = distance(exact.point(at), now.point(at));
    farthest = std::isfinite(away) ? std::max(farthest, away) : away;
    if (!std::isfinite(away)) break;
  }
  return farthest;
}

std::string array_text(std::span<const float> numbers) {
  return fmt::format("[{}]", fmt::join(numbers, ","));
}

// All digits: readers in double precision get powers of two.
std::string exact_text(std::span<const float> numbers) {
  std::string text = "[";
  for (const float each : numbers) {
    if (text.size() > 1) text += ',';
    text += number_text(static_cast<double>(each));
  }
  return text + ']';
}

void set_member(const json::Document& document, json::Editor& editor, json::NodeId object,
                std::string_view name, const std::string& json) {
  const json::NodeId old = document.find(object, name);
  if (old == json::kNoNode) {
    editor.append_member(object, name, json);
  } else {
    editor.replace(object, old, json);
  }
}

}  // namespace

MeshPlaces::MeshPlaces(const StepData& data, const AttributeRoles& roles)
    : data_(data),
      roles_(roles),
      pose_(
          model::compute_pose(data.asset, data.views, model::choose_scene(data.asset, data.views))),
      hierarchy_(data.asset, data.views.nodes),
      places_(data.views.meshes.size()) {
  read_users();
  std::vector<std::size_t> users(places_.size());
  for (NodeIndex i = 0; i < data.views.nodes.size(); ++i) {
    if (node(i).object == json::kNoNode || !node(i).mesh) continue;
    ++users[*node(i).mesh];
    add_node(i);
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const json::NodeId mesh = data.views.meshes[i].node;
    if (mesh == json::kNoNode || !places_[i].obstacle.empty()) continue;
    if (users[i] == 0) places_[i].obstacle = "no node draws it";
    if (data.graph.users(mesh).size() != users[i])
      places_[i].obstacle = "objects other than nodes refer to it";
  }
}

void MeshPlaces::read_users() {
  for (const model::Animation& animation : data_.views.animations) {
    for (const model::AnimationChannel& channel : animation.channels) {
      if (!channel.node) continue;
      (channel.path == AnimationPath::weights ? users_.weighted : users_.moved)
          .insert(*channel.node);
    }
  }
  const auto& nodes = data_.asset.elements(model::RootArray::nodes);
  const graph::Tree& tree = data_.graph.tree();
  for (const graph::PointerText& pointer : data_.graph.pointers()) {
    if (pointer.steps.empty() || pointer.steps[0] != "nodes") continue;
    users_.any_may_be_pointed |= pointer.varying != json::kNoNode;
    if (pointer.way.size() < 2) continue;
    const NodeIndex index = tree.position(pointer.way[1]);
    const std::string member = pointer.steps.size() > 2 ? pointer.steps[2] : std::string();
    const bool of_mesh = member == "weights" || member == "mesh" || member == "skin";
    (of_mesh ? users_.weighted : users_.moved).insert(index);
  }
  for (NodeIndex i = 0; i < nodes.size(); ++i) {
    if (nodes[i] == json::kNoNode) continue;
    for (const graph::Use& use : data_.graph.users(nodes[i])) {
      if (use.kind == graph::UseKind::pointer) continue;
      const json::NodeId list = use.at.element ? use.at.node : tree.parent(use.at.node);
      const json::NodeId owner = tree.root_element(use.at.node);
      const std::string_view name = tree.is_member(list) ? tree.name(list) : std::string_view();
      const json::NodeId table = owner == json::kNoNode ? json::kNoNode : tree.parent(owner);
      const std::string_view of = table == json::kNoNode ? std::string_view() : tree.name(table);
      const bool is_own = tree.parent(list) == owner;
      if (is_own && (name == "children" || name == "nodes")) continue;
      if (of == "skins") {
        users_.joints.insert(i);
      } else if (of != "animations") {
        users_.referred.insert(i);
      }
    }
  }
}

bool MeshPlaces::moves_only_its_mesh(NodeIndex index) const {
  for (const char* member :
       {"boundingVolume", "camera", "children", "extensions", "externalAsset"}) {
    if (data_.document.holds(node(index).object, member)) return false;
  }
  return !users_.moved.contains(index) && !users_.referred.contains(index) &&
         !users_.joints.contains(index);
}

bool MeshPlaces::has_copies(NodeIndex index) const {
  model::MemoryBudget none(0);  // none is read
  return model::read_instancing(data_.asset, data_.views, data_.resources, node(index), none)
      .has_value();
}

std::string MeshPlaces::find_obstacle(NodeIndex index, const MeshNode& place) const {
  if (place.carrier == Carrier::skin) return {};
  if (users_.any_may_be_pointed) return "a JSON pointer may lead to its node at run time";
  if (hierarchy_.on_loop(index)) return "its node is below itself";
  if (place.carrier != Carrier::child) return {};
  if (users_.weighted.contains(index))
    return "needs a node of its own, but an animation changes its weights";
  if (users_.referred.contains(index))
    return "needs a node of its own, but an extension refers to its node";
  return {};
}

void MeshPlaces::add_node(NodeIndex index) {
  const model::Node& drawn = node(index);
  MeshPlace& place = places_[*drawn.mesh];
  MeshNode added{index, moves_only_its_mesh(index) ? Carrier::transform : Carrier::child};
  if (drawn.skin) added.carrier = Carrier::skin;
  const bool is_copied = !drawn.skin && has_copies(index);
  if (is_copied) added.carrier = Carrier::instances;
  place.nodes.push_back(added);
  place.in_scene |= pose_.in_scene[index] != 0;
  if (place.obstacle.empty()) place.obstacle = find_obstacle(index, added);
  const std::size_t first = place.transforms.size();
  if (is_copied) {
    InstancePlaces& copies = instances_[index];
    std::string why = read_instances(data_, roles_, drawn, copy_bytes_, copies);
    if (place.obstacle.empty()) place.obstacle = std::move(why);
    for (const Affine& each : copies.transforms)
      place.transforms.push_back(pose_.world[index] * each);
  } else if (!drawn.skin) {
    place.transforms.push_back(pose_.world[index]);
  } else if (place.skins.insert(*drawn.skin).second) {
    add_skin(*drawn.skin, place);
  }
  for (std::size_t i = first; i < place.transforms.size(); ++i)
    place.scale = std::max(place.scale, model::longest_axis(place.transforms[i]));
}

void MeshPlaces::add_skin(std::uint32_t skin, MeshPlace& place) {
  const auto [known, is_new] = joint_matrices_.try_emplace(skin);
  if (is_new) {
    known->second = model::joint_matrices(data_.asset, data_.views, data_.resources, skin, pose_);
  }
  if (known->second.empty() && place.obstacle.empty()) place.obstacle = "has a skin that is broken";
  if (joints_left_ < known->second.size()) {
    place.obstacle = kTooManyJoints;
    return;
  }
  joints_left_ -= known->second.size();
  for (const Affine& each : known->second)
    place.scale = std::max(place.scale, model::longest_axis(each));
}

std::optional<std::string> MeshPlaces::gridded_matrices(std::uint32_t index,
                                                        const Grid& grid) const {
  const model::Skin skin =
      model::read_skin(data_.asset, data_.asset.elements(model::RootArray::skins)[index]);
  std::optional<model::ElementBlocks> old;
  if (skin.inverse_bind_matrices) {
    auto elements = model::AccessorData::open(data_.asset, data_.views, data_.resources,
                                              data_.views.accessors[*skin.inverse_bind_matrices],
                                              model::Malformed::unusable);
    const bool fits = elements && elements->format().type == model::ElementType::mat4 &&
                      elements->count() == skin.joint_count;
    if (!fits) return std::nullopt;
    old.emplace(*std::move(elements));
  } else if (skin.inverse_bind_matrices_value != json::kNoNode) {
    return std::nullopt;
  }
  std::string bytes;
  model::Vectors<16> element(1);
  for (std::uint64_t i = 0; i < skin.joint_count; ++i) {
    Affine matrix;
    if (old) {
      old->read(i, element);
      matrix = Affine::from_matrix(element[0]);
    }
    const std::array<float, 16> now = matrix_of(matrix * transform_of(grid));
    bytes.append(reinterpret_cast<const char*>(now.data()), sizeof(now));
  }
  return bytes;
}

double MeshPlaces::rounding(std::uint32_t mesh, const Grid& grid, double size) const {
  double farthest = 0;
  const Affine of_grid = transform_of(grid);
  for (const MeshNode& each : places_[mesh].nodes) {
    if (each.carrier == Carrier::instances) {
      const Affine& world = pose_.world[each.node];
      for (const Affine& copy : instances_.at(each.node).transforms) {
        farthest = std::max(farthest, farthest_corner(world * copy * of_grid,
                                                      world * copy_with_grid(copy, grid), size));
      }
    }
    if (each.carrier != Carrier::transform) continue;
    const NodeIndex parent = hierarchy_.parent(each.node);
    const Affine above = parent == model::kNoNodeIndex ? Affine() : pose_.world[parent];
    const Affine now = above * with_grid(data_.asset, node(each.node), grid).affine;
    farthest = std::max(farthest, farthest_corner(pose_.world[each.node] * of_grid, now, size));
  }
  for (const std::uint32_t index : places_[mesh].skins)
    farthest = std::max(farthest, rounding_of_skin(index, grid, size));
  return farthest;
}

double MeshPlaces::rounding_of_skin(std::uint32_t index, const Grid& grid, double size) const {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  const std::vector<Affine>& exact = joint_matrices_.at(index);
  const auto bytes = gridded_matrices(index, grid);
  if (!bytes || exact.size() > joints_left_) return kUnknown;
  joints_left_ -= exact.size();
  const model::Skin skin =
      model::read_skin(data_.asset, data_.asset.elements(model::RootArray::skins)[index]);
  const Affine of_grid = transform_of(grid);
  double farthest = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    std::array<float, 16> matrix{};
    std::memcpy(matrix.data(), bytes->data() + i * sizeof(matrix), sizeof(matrix));
    const Affine now = pose_.world[skin.joint_nodes[i]] * Affine::from_matrix(matrix);
    farthest = std::max(farthest, farthest_corner(exact[i] * of_grid, now, size));
  }
  return farthest;
}

std::size_t MeshPlaces::place(std::uint32_t mesh, const Grid& grid, StepChanges& changes,
                              FormatChanges& formats) const {
  std::size_t added = 0;
  for (const MeshNode& each : places_[mesh].nodes) {
    if (each.carrier == Carrier::transform) change_transform(each.node, grid, changes);
    if (each.carrier == Carrier::instances)
      place_instances(data_, instances_.at(each.node), grid, changes, formats);
    if (each.carrier != Carrier::child) continue;
    add_child(each.node, grid, changes);
    ++added;
  }
  return added;
}

void MeshPlaces::change_transform(NodeIndex index, const Grid& grid, StepChanges& changes) const {
  const json::Document& document = data_.document;
  const json::NodeId object = node(index).object;
  const NewTransform now = with_grid(data_.asset, node(index), grid);
  const auto set = [&](std::string_view name, const std::string& json) {
    set_member(document, changes.editor, object, name, json);
  };
  if (now.matrix) return set("matrix", exact_text(*now.matrix));
  if (now.translation) set("translation", array_text(*now.translation));
  set("scale", exact_text(now.scale));
}

void MeshPlaces::add_child(NodeIndex index, const Grid& grid, StepChanges& changes) const {
  const json::Document& document = data_.document;
  const model::Node& parent = node(index);
  std::string json = fmt::format(R"({{"mesh":{})", *parent.mesh);
  if (parent.weights != json::kNoNode) {
    json += fmt::format(R"(,"weights":{})", document.raw(parent.weights));
    changes.editor.remove(parent.object, parent.weights - 1);
  }
  if (grid.origin != Vector3{}) {
    json += fmt::format(R"(,"translation":{})", array_text(single(grid.origin)));
  }
  const auto step = static_cast<float>(grid.step);
  json += fmt::format(R"(,"scale":{}}})", exact_text(std::array<float, 3>{step, step, step}));
  const std::uint64_t child = changes.additions.add_element("nodes", std::move(json));
  changes.editor.remove(parent.object, parent.mesh_value - 1);
  if (parent.children == json::kNoNode) {
    return changes.editor.append_member(parent.object, "children", fmt::format("[{}]", child));
  }
  std::string_view list = document.raw(parent.children);
  list = list.substr(0, list.find_last_of(']'));
  const bool is_empty = document.array_size(parent.children) == 0;
  changes.editor.replace(parent.object, parent.children,
                         fmt::format("{}{}{}]", list, is_empty ? "" : ",", child));
}

}  // namespace gltfx::steps
