// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_meshes.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "model/skin.hpp"
#include "model/tangent_space.hpp"
#include "model/variants.hpp"
#include "preview/markers.hpp"
#include "render/texture.hpp"

namespace gltfx {
namespace {

// What a mesh takes beside its vertices, drawn or not: a file may ask for any number of poses.
constexpr std::uint64_t kMeshBytes = 512;
constexpr const char* kTooManyPoses = "has more poses than memory allows";

std::string place_of(std::uint32_t mesh, std::uint32_t primitive) {
  return fmt::format("Primitive {} of mesh {}", primitive, mesh);
}

// A scene has a name less for the same arrays of numbers.
render::Mesh to_mesh(model::Geometry&& geometry, std::uint32_t material) {
  render::Mesh mesh;
  mesh.triangles = std::move(geometry.triangles);
  mesh.positions = std::move(geometry.positions);
  mesh.normals = std::move(geometry.normals);
  mesh.tangents = std::move(geometry.tangents);
  mesh.uvs = std::move(geometry.tex_coords);
  mesh.colors = std::move(geometry.colors);
  mesh.material = material;
  return mesh;
}

}  // namespace

// Whether weights are those of the node and not of its mesh.
bool SceneMeshes::has_own_weights(model::NodeIndex node) const {
  const json::NodeId object = source_.views.nodes[node].object;
  return source_.asset.document().find(object, "weights") != json::kNoNode ||
         model::any_below(moment_.animated, fmt::format("/nodes/{}/weights", node));
}

const std::vector<DrawnMeshes>& SceneMeshes::use(model::NodeIndex node) {
  const model::Node& from = source_.views.nodes[node];
  const std::uint32_t skin = from.skin.value_or(render::kNone);
  const auto& primitives = source_.views.meshes[*from.mesh].primitives;
  const std::uint64_t targets = primitives.empty() ? 0 : primitives.front().targets.size();
  const bool own = targets > 0 && has_own_weights(node);
  const auto usual = usual_.find({*from.mesh, skin});
  if (!own && usual != usual_.end()) return *usual->second;
  if (own && !budget_.take(targets * sizeof(float))) {
    notes_.leave_out(fmt::format("Mesh {}", *from.mesh), kTooManyPoses);
    return nothing_;
  }
  std::vector<float> weights =
      model::morph_weights(source_.asset, source_.views, node, moment_.animated);
  const bool still = std::all_of(weights.begin(), weights.end(), [](float w) { return w == 0; });
  if (still) weights.clear();
  const auto& drawn = use(Key{*from.mesh, skin, std::move(weights)});
  if (!own) usual_.emplace(PlainKey{*from.mesh, skin}, &drawn);
  return drawn;
}

const std::vector<DrawnMeshes>& SceneMeshes::use_mesh(std::uint32_t mesh) {
  return use(Key{mesh, render::kNone, {}});
}

const std::vector<DrawnMeshes>& SceneMeshes::use(Key key) {
  const auto before = known_.find(key);
  if (before != known_.end()) return before->second;
  const auto& [mesh, skin, weights] = key;
  const std::uint64_t primitives = source_.views.meshes[mesh].primitives.size();
  if (!budget_.take(primitives * kMeshBytes + weights.size() * sizeof(float))) {
    notes_.leave_out(fmt::format("Mesh {}", mesh), kTooManyPoses);
    return nothing_;
  }
  const auto known = known_.try_emplace(std::move(key)).first;
  std::vector<bool> bound;
  for (const model::Primitive& primitive :
       source_.views.meshes[std::get<0>(known->first)].primitives) {
    bound.push_back(model::joint_sets(primitive) > 0);
  }
  draw(known->first, bound, false, known->second);
  draw(known->first, bound, true, known->second);
  return known->second;
}

// Of the primitives of a mesh, those that are bound to joints and so moved, or all others: each
// follow each other in the scene, as long as they have the same origin.
void SceneMeshes::draw(const Key& key, const std::vector<bool>& bound, bool moved,
                       std::vector<DrawnMeshes>& drawn) {
  std::size_t group = drawn.size();
  for (std::uint32_t i = 0; i < bound.size(); ++i) {
    if (bound[i] != moved) continue;
    const bool skinned = moved && !joints(std::get<1>(key)).empty();
    const auto origin = draw(key, i, moved);
    if (!origin) continue;
    if (group == drawn.size() || drawn[group].origin != *origin) {
      group = drawn.size();
      drawn.push_back({static_cast<std::uint32_t>(scene_.meshes.size()) - 1, 0, skinned, *origin});
    }
    ++drawn[group].count;
  }
}

const std::vector<model::Affine>& SceneMeshes::joints(std::uint32_t skin) {
  const auto [known, fresh] = joints_.try_emplace(skin);
  if (!fresh || skin == render::kNone) return known->second;
  const model::Skin read =
      model::read_skin(source_.asset, source_.asset.elements(model::RootArray::skins)[skin]);
  if (!budget_.take(checked_mul(read.joint_count, sizeof(model::Affine)))) {
    notes_.add(fmt::format("Skin {}", skin), "asks for more memory than there is for the file");
    return known->second;
  }
  known->second =
      model::joint_matrices(source_.asset, source_.views, source_.resources, skin, moment_.pose);
  for (model::Affine& matrix : known->second) {
    for (std::size_t i = 0; i < 3; ++i) matrix.columns[3][i] -= moment_.origin[i];
  }
  if (known->second.empty()) {
    notes_.add(fmt::format("Skin {}", skin), "has joints that lead nowhere and moves nothing");
  }
  return known->second;
}

std::optional<model::Vector3> SceneMeshes::draw(const Key& key, std::uint32_t index, bool moved) {
  const auto& [mesh, skin, weights] = key;
  const model::Primitive& primitive = source_.views.meshes[mesh].primitives[index];
  const MaterialNeeds& needs =
      materials_.use(model::material_of(source_.asset, primitive, variant_));
  if (!kept_.may_repeat(primitive)) return draw_new(key, index, moved, needs);
  GeometryKey same =
      geometry_key(source_, primitive, {weights, moved ? skin : render::kNone}, needs);
  if (const KeptGeometry::Entry* known = kept_.find(same)) {
    scene_.meshes.push_back(known->mesh);
    scene_.meshes.back().material = needs.material;
    return known->origin;
  }
  const auto origin = draw_new(key, index, moved, needs);
  // The markers of points and lines get their size by instance.
  if (origin && scene_.meshes.back().marker_directions.empty()) {
    kept_.keep(std::move(same), {scene_.meshes.back(), *origin});
  }
  return origin;
}

std::optional<model::Vector3> SceneMeshes::draw_new(const Key& key, std::uint32_t index, bool moved,
                                                    const MaterialNeeds& needs) {
  const auto& [mesh, skin, weights] = key;
  model::GeometryRequest request;
  request.tex_coords = needs.tex_coords;
  request.weights = weights;
  if (moved) request.joints = joints(skin);
  request.near_origin = true;
  model::Geometry geometry;
  const model::GeometryError error = model::read_geometry(
      source_, source_.views.meshes[mesh].primitives[index], request, budget_, geometry);
  if (error != model::GeometryError::none) {
    const std::string why(model::error_text(error));
    if (error == model::GeometryError::empty) {
      notes_.add(place_of(mesh, index), why);
    } else {
      notes_.leave_out(place_of(mesh, index), why);
    }
    return std::nullopt;
  }
  if (geometry.coarse_step > 0) {
    notes_.add(place_of(mesh, index),
               fmt::format("has positions so far from 0 that single precision rounds them to "
                           "steps of {:.3g}",
                           geometry.coarse_step));
  }
  model::Vector3 origin = geometry.origin;
  const bool fixed = moved && !request.joints.empty() && !geometry.skinned;
  for (std::size_t i = 0; fixed && i < 3; ++i) origin[i] -= moment_.origin[i];
  add_tangents(needs, geometry);
  const Marked marked{std::move(geometry.segments), std::move(geometry.points)};
  render::Mesh drawn = to_mesh(std::move(geometry), needs.material);
  if (!add_markers(key, index, marked, drawn)) return std::nullopt;
  scene_.meshes.push_back(std::move(drawn));
  return origin;
}

// Markers in place of the mesh, whose vertices have points or lines. False without memory for them.
bool SceneMeshes::add_markers(const Key& key, std::uint32_t index, const Marked& marked,
                              render::Mesh& drawn) {
  const std::uint32_t mesh = std::get<0>(key);
  const std::size_t markers = marked.segments.size() + marked.points.size();  // one of them is 0
  if (markers > preview::kMostMarkers) {
    notes_.leave_out(
        place_of(mesh, index),
        fmt::format("has more than {} points or lines; some are drawn", preview::kMostMarkers));
  }
  const std::size_t most = std::min(markers, preview::kMostMarkers);
  if (!budget_.take(checked_mul(most, preview::marker_bytes(drawn)))) {
    notes_.leave_out(place_of(mesh, index), "has more points or lines than memory allows");
    return false;
  }
  if (!marked.segments.empty()) drawn = preview::line_markers(drawn, marked.segments);
  if (!marked.points.empty()) drawn = preview::point_markers(drawn, marked.points);
  return true;
}

// Flat triangles need none: each has its own, along its texture coordinates.
void SceneMeshes::add_tangents(const MaterialNeeds& needs, model::Geometry& geometry) {
  if (!needs.tangents || geometry.normals.empty() || !geometry.tangents.empty()) return;
  const std::uint32_t set = needs.tangents->uv_set;
  if (set >= geometry.tex_coords.size() || geometry.tex_coords[set].empty()) return;
  model::Vectors<2> coordinates = geometry.tex_coords[set];
  for (auto& uv : coordinates) uv = render::transform_uv(*needs.tangents, uv);
  if (!model::generate_tangents(geometry, coordinates, budget_)) {
    notes_.add("A mesh", "asks for too much memory for its tangents");
  }
}

}  // namespace gltfx
