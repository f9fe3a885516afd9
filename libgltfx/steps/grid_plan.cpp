// SPDX-License-Identifier: Apache-2.0
#include "steps/grid_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/draco.hpp"
#include "model/elements.hpp"
#include "model/scene_box.hpp"
#include "model/scene_diagonal.hpp"

namespace gltfx::steps {
namespace {

using model::Attribute;
using model::SemanticKind;
using model::Vector3;

constexpr int kMostHalvings = 6;
constexpr double kMostSteps = 65535;
// Numbers that are compared with those of a grid, for all primitives.
constexpr std::uint64_t kMostWork = std::uint64_t{1} << 28U;
// Half the diagonal of a cell, in steps.
const double kCellRadius = std::sqrt(3.0) / 2;
// Weights of joints are rounded, too, and move vertices.
constexpr double kShareOfSkins = 0.75;

// Distances between numbers of single precision near `size`: multiples of it up to that size are
// exact.
double spacing_near(double size) {
  return size > 0 ? std::ldexp(1.0, std::max(std::ilogb(size) - 22, -120)) : 0;
}

template <class Key>
void join_by(std::map<Key, std::uint32_t>& first, const Key& key, std::uint32_t thing,
             DisjointSets& sets) {
  const auto [known, is_new] = first.try_emplace(key, thing);
  if (!is_new) sets.join(thing, known->second);
}

const Attribute* find_positions(const std::vector<Attribute>& attributes) {
  for (const Attribute& each : attributes) {
    if (each.semantic.kind == SemanticKind::position) return &each;
  }
  return nullptr;
}

}  // namespace

GridPlan::GridPlan(const StepData& data, const AttributeRoles& roles, const MeshPlaces& places,
                   const VolumeMaterials& volumes, double bound)
    : data_(data),
      roles_(roles),
      places_(places),
      volumes_(volumes),
      meshes_(data.views.meshes.size()),
      bonds_(data.views.meshes.size()) {
  const model::DracoMeshes none;
  const double scene =
      model::scene_diagonal({data.asset, data.views, data.resources, none}, places.pose());
  for (std::uint32_t i = 0; i < meshes_.size(); ++i) {
    read(i);
    measure(i, bound, scene);
  }
  join_meshes();
  for (const auto& group : group_units(make_units())) choose(group);
}

void GridPlan::read(std::uint32_t index) {
  MeshGrid& mesh = meshes_[index];
  mesh.obstacle = places_.of(index).obstacle;
  for (const model::Primitive& primitive : data_.views.meshes[index].primitives) {
    if (primitive.node != json::kNoNode) read_primitive(primitive, mesh);
  }
  std::sort(mesh.positions.begin(), mesh.positions.end());
  mesh.positions.erase(std::unique(mesh.positions.begin(), mesh.positions.end()),
                       mesh.positions.end());
  std::string unknown = roles_.find_unknown(index);
  if (mesh.obstacle.empty() && !unknown.empty()) {
    mesh.obstacle = std::move(unknown);
    mesh.is_refused = true;
  }
}

void GridPlan::read_primitive(const model::Primitive& primitive, MeshGrid& mesh) {
  const auto leave = [&mesh](std::string why) {
    if (mesh.obstacle.empty()) mesh.obstacle = std::move(why);
  };
  for (const std::uint32_t material : volumes_.of(primitive)) {
    mesh.volumes.push_back(material);
    if (volumes_.is_pointed(material)) leave("has a material whose thickness an animation changes");
  }
  const AttributeLists lists = attribute_lists(data_.asset, primitive);
  const Attribute* const own = find_positions(lists.own);
  if (own == nullptr) return;
  if (!own->accessor || primitive.targets_are_broken)
    return leave("has members that cannot be read");
  PositionLists positions{*own->accessor, {}};
  leave(open(positions.own, mesh));
  for (const auto& target : lists.targets) {
    const Attribute* const moves = find_positions(target);
    if (moves == nullptr) continue;
    if (!moves->accessor) return leave("has members that cannot be read");
    // Zeros stay zeros.
    if (data_.document.find(data_.views.accessors[*moves->accessor].node, "bufferView") ==
            json::kNoNode &&
        data_.views.accessors[*moves->accessor].sparse == json::kNoNode)
      continue;
    leave(open(*moves->accessor, mesh));
    positions.targets.push_back(*moves->accessor);
  }
  if (!mesh.obstacle.empty() || mesh.has_integers) return;
  const std::size_t size = elements_.at(positions.own).values.size();
  work_ += size * (1 + positions.targets.size());
  if (work_ > kMostWork) return leave("shares its positions with too many others");
  for (const std::uint32_t target : positions.targets) {
    if (elements_.at(target).values.size() != size) leave("has attributes of different lengths");
  }
  mesh.positions.push_back(std::move(positions));
}

// Why an accessor of positions stays.
std::string GridPlan::open(std::uint32_t accessor, MeshGrid& mesh) {
  if (std::string why = roles_.find_obstacle(accessor); !why.empty()) return why;
  if (std::string why = roles_.find_unknown(accessor); !why.empty()) {
    mesh.is_refused |= mesh.obstacle.empty();
    return why;
  }
  if (elements_.contains(accessor)) return {};
  if (!roles_.is_float(accessor)) {
    mesh.has_integers = true;
    return {};
  }
  std::optional<model::AccessorData> data;
  if (std::string why = data_.open(accessor, data); !why.empty()) return why;
  if (data->components() != 3) return "has positions that are not vectors";
  FloatElements elements{{}, 3};
  elements.values.reserve(static_cast<std::size_t>(data->count()) * 3);
  bool finite = true;
  model::for_each_component(*data, static_cast<std::size_t>(data->count()),
                            [&](std::size_t, unsigned, float value) {
                              finite = finite && std::isfinite(value);
                              elements.values.push_back(value);
                            });
  if (!finite) return "has positions that are not finite";
  elements_.emplace(accessor, std::move(elements));
  return {};
}

void GridPlan::measure(std::uint32_t index, double bound, double scene) {
  MeshGrid& mesh = meshes_[index];
  if (!mesh.obstacle.empty() || mesh.positions.empty() || mesh.has_integers) return;
  const MeshPlace& place = places_.of(index);
  mesh.scale = place.scale;
  model::Box box;
  for (const PositionLists& lists : mesh.positions) {
    const std::vector<float>& values = elements_.at(lists.own).values;
    for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
      box.add({static_cast<double>(values[i]), static_cast<double>(values[i + 1]),
               static_cast<double>(values[i + 2])});
    }
  }
  mesh.least = box.least;
  mesh.greatest = box.greatest;
  // Outside of the scene, lengths are those of the mesh.
  if (!place.in_scene) mesh.scale = 1;
  mesh.permitted = bound * (place.in_scene ? scene : box.diagonal());
  if (!place.skins.empty()) mesh.permitted *= kShareOfSkins;
  if (!(mesh.permitted > 0) || !std::isfinite(mesh.permitted)) {
    mesh.obstacle = "has no size";
  } else if (!(mesh.scale > 0) || !std::isfinite(mesh.scale)) {
    mesh.obstacle = "has a transform without size";
  }
}

// Meshes with common positions, skins or lengths of materials have one grid.
void GridPlan::join_meshes() {
  std::map<std::uint32_t, std::uint32_t> by_accessor, by_skin, by_material;
  for (std::uint32_t i = 0; i < meshes_.size(); ++i) {
    for (const model::Primitive& primitive : data_.views.meshes[i].primitives) {
      if (primitive.node == json::kNoNode) continue;
      const AttributeLists lists = attribute_lists(data_.asset, primitive);
      const auto join = [&](const std::vector<Attribute>& attributes) {
        const Attribute* const found = find_positions(attributes);
        if (found != nullptr && found->accessor) join_by(by_accessor, *found->accessor, i, bonds_);
      };
      join(lists.own);
      std::for_each(lists.targets.begin(), lists.targets.end(), join);
    }
    for (const std::uint32_t skin : places_.of(i).skins) join_by(by_skin, skin, i, bonds_);
    for (const std::uint32_t material : meshes_[i].volumes)
      join_by(by_material, material, i, bonds_);
  }
}

// Units whose meshes all have positions and no obstacle.
std::vector<GridPlan::Unit> GridPlan::make_units() {
  std::map<std::uint32_t, Unit> by_root;
  for (std::uint32_t i = 0; i < meshes_.size(); ++i) by_root[bonds_.find(i)].push_back(i);
  std::vector<Unit> units;
  for (auto& [root, unit] : by_root) {
    const bool is_free = std::all_of(unit.begin(), unit.end(), [this](std::uint32_t i) {
      const MeshGrid& mesh = meshes_[i];
      return mesh.obstacle.empty() && !mesh.has_integers && !mesh.positions.empty();
    });
    if (is_free) {
      units.push_back(std::move(unit));
      continue;
    }
    for (const std::uint32_t i : unit) {
      MeshGrid& mesh = meshes_[i];
      if (mesh.obstacle.empty() && !mesh.has_integers && !mesh.positions.empty())
        mesh.obstacle = "shares positions, a skin or a material with a mesh that stays";
    }
  }
  return units;
}

// Units that are drawn with the same transform may touch.
std::vector<std::vector<GridPlan::Unit>> GridPlan::group_units(std::vector<Unit> units) const {
  DisjointSets groups(units.size());
  std::map<std::array<Vector3, 4>, std::uint32_t> by_transform;
  for (std::uint32_t u = 0; u < units.size(); ++u) {
    for (const std::uint32_t mesh : units[u]) {
      for (const model::Affine& each : places_.of(mesh).transforms)
        join_by(by_transform, each.columns, u, groups);
    }
  }
  std::map<std::uint32_t, std::vector<Unit>> by_root;
  for (std::uint32_t u = 0; u < units.size(); ++u)
    by_root[groups.find(u)].push_back(std::move(units[u]));
  std::vector<std::vector<Unit>> all;
  for (auto& [root, group] : by_root) all.push_back(std::move(group));
  return all;
}

double GridPlan::first_step(const std::vector<Unit>& group) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Unit& unit : group) {
    for (const std::uint32_t mesh : unit)
      least = std::min(least, meshes_[mesh].permitted / meshes_[mesh].scale);
  }
  return std::ldexp(1.0, std::ilogb(least / kCellRadius));
}

Grid GridPlan::grid_of(const std::vector<Unit>& units, double step) const {
  Grid grid{step, {}};
  model::Box box;
  for (const Unit& unit : units) {
    for (const std::uint32_t mesh : unit) {
      box.add(meshes_[mesh].least);
      box.add(meshes_[mesh].greatest);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double size = std::max(std::abs(box.least[i]), std::abs(box.greatest[i]));
    const double unit = std::max(step, spacing_near(size));
    grid.origin[i] = std::floor(box.least[i] / unit) * unit + 0.0;
  }
  return grid;
}

double GridPlan::farthest(const PositionLists& lists, const Grid& grid) const {
  const std::vector<float>& own = elements_.at(lists.own).values;
  std::vector<const std::vector<float>*> targets;
  for (const std::uint32_t target : lists.targets) targets.push_back(&elements_.at(target).values);
  const auto error = [&](float value, double origin) {
    const double exact = static_cast<double>(value) - origin;
    return std::round(exact / grid.step) * grid.step - exact;
  };
  double greatest = 0;
  for (std::size_t at = 0; at + 2 < own.size(); at += 3) {
    Vector3 rest{}, moved{};
    for (std::size_t k = 0; k < 3; ++k) {
      rest[k] = moved[k] = error(own[at + k], grid.origin[k]);
      for (const auto* target : targets) moved[k] += error((*target)[at + k], 0);
    }
    greatest = std::max({greatest, model::dot(rest, rest), model::dot(moved, moved)});
  }
  return std::sqrt(greatest);
}

bool GridPlan::fits(std::uint32_t index, const Grid& grid, bool& too_far) const {
  const MeshGrid& mesh = meshes_[index];
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i)
    size = std::max(size, (mesh.greatest[i] - grid.origin[i]) / grid.step);
  too_far |= std::round(size) > kMostSteps;
  if (too_far) return false;
  double error = 0;
  for (const PositionLists& lists : mesh.positions) {
    for (const std::uint32_t target : lists.targets)
      too_far |= !quantize_moves(elements_.at(target), grid.step);
    error = std::max(error, farthest(lists, grid));
  }
  return !too_far && error * mesh.scale + places_.rounding(index, grid, size) <= mesh.permitted;
}

bool GridPlan::try_step(const std::vector<Unit>& group, double step, bool shared, bool& too_far) {
  const Grid common = grid_of(group, step);
  for (const Unit& unit : group) {
    const Grid grid = shared ? common : grid_of({unit}, step);
    for (const std::uint32_t mesh : unit) {
      if (!fits(mesh, grid, too_far)) return false;
    }
  }
  for (const Unit& unit : group) {
    const Grid grid = shared ? common : grid_of({unit}, step);
    for (const std::uint32_t mesh : unit) meshes_[mesh].grid = grid;
  }
  return true;
}

void GridPlan::choose(const std::vector<Unit>& group) {
  double step = first_step(group);
  bool is_far_apart = false, is_too_large = false;
  for (int i = 0; i < kMostHalvings && !is_too_large && step >= std::ldexp(1.0, -120); ++i) {
    if (!is_far_apart && try_step(group, step, true, is_far_apart)) return;
    if (group.size() > 1 && try_step(group, step, false, is_too_large)) return;
    if (group.size() == 1) is_too_large = is_far_apart;
    step /= 2;
  }
  if (group.size() > 1) {
    for (const Unit& unit : group) choose({unit});
    return;
  }
  for (const std::uint32_t mesh : group.front()) {
    meshes_[mesh].obstacle = is_too_large ? "needs more than 16 bits for its positions"
                                          : "is too far from its origin for the bound";
  }
}

}  // namespace gltfx::steps
