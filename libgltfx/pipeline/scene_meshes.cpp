// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_meshes.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "bake/texture.hpp"
#include "model/skin.hpp"
#include "model/tangent_space.hpp"
#include "model/variants.hpp"

namespace gltfx {
namespace {

// What a mesh takes beside its vertices, drawn or not: a file may ask for any number of poses.
constexpr std::uint64_t kMeshBytes = 512;

std::string place_of(std::uint32_t mesh, std::uint32_t primitive) {
  return fmt::format("Primitive {} of mesh {}", primitive, mesh);
}

// A scene has a name less for the same arrays of numbers.
bake::Mesh to_mesh(model::Geometry&& geometry, std::uint32_t material) {
  bake::Mesh mesh;
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

const std::vector<DrawnMesh>& SceneMeshes::use(model::NodeIndex node) {
  const model::Node& from = source_.views.nodes[node];
  std::vector<float> weights = model::morph_weights(source_.asset, source_.views, node, animated_);
  const bool still = std::all_of(weights.begin(), weights.end(), [](float w) { return w == 0; });
  if (still) weights.clear();
  return use(Key{*from.mesh, from.skin.value_or(bake::kNone), std::move(weights)});
}

const std::vector<DrawnMesh>& SceneMeshes::use_mesh(std::uint32_t mesh) {
  return use(Key{mesh, bake::kNone, {}});
}

const std::vector<DrawnMesh>& SceneMeshes::use(Key key) {
  const auto before = known_.find(key);
  if (before != known_.end()) return before->second;
  const auto& [mesh, skin, weights] = key;
  const auto& primitives = source_.views.meshes[mesh].primitives;
  const std::uint64_t size = primitives.size() * kMeshBytes + weights.size() * sizeof(float);
  if (!budget_.take(size)) {
    notes_.add(fmt::format("Mesh {}", mesh), "has more poses than memory allows");
    return nothing_;
  }
  const auto known = known_.try_emplace(std::move(key)).first;
  for (std::uint32_t i = 0; i < primitives.size(); ++i) {
    draw(primitives[i], known->first, i, known->second);
  }
  return known->second;
}

const std::vector<model::Affine>& SceneMeshes::joints(std::uint32_t skin) {
  const auto [known, fresh] = joints_.try_emplace(skin);
  if (fresh && skin != bake::kNone) {
    known->second =
        model::joint_matrices(source_.asset, source_.views, source_.resources, skin, pose_);
    if (known->second.empty()) {
      notes_.add(fmt::format("Skin {}", skin), "has joints that lead nowhere and moves nothing");
    }
  }
  return known->second;
}

void SceneMeshes::draw(const model::Primitive& primitive, const Key& key, std::uint32_t index,
                       std::vector<DrawnMesh>& drawn) {
  const auto& [mesh, skin, weights] = key;
  const MaterialNeeds& needs =
      materials_.use(model::material_of(source_.asset, primitive, variant_));
  model::GeometryRequest request;
  request.tex_coords = needs.tex_coords;
  request.weights = weights;
  if (model::joint_sets(primitive) > 0) request.joints = joints(skin);
  model::Geometry geometry;
  const model::GeometryFault fault =
      model::read_geometry(source_, primitive, request, budget_, geometry);
  if (fault != model::GeometryFault::none) {
    notes_.add(place_of(mesh, index), std::string(model::fault_text(fault)));
    return;
  }
  add_tangents(needs, geometry);
  drawn.push_back({static_cast<std::uint32_t>(scene_.meshes.size()), !request.joints.empty()});
  scene_.meshes.push_back(to_mesh(std::move(geometry), needs.material));
}

// Flat triangles need none: each has its own, along its texture coordinates.
void SceneMeshes::add_tangents(const MaterialNeeds& needs, model::Geometry& geometry) {
  if (!needs.tangents || geometry.normals.empty() || !geometry.tangents.empty()) return;
  const std::uint32_t set = needs.tangents->uv_set;
  if (set >= geometry.tex_coords.size() || geometry.tex_coords[set].empty()) return;
  model::Vectors<2> coordinates = geometry.tex_coords[set];
  for (auto& uv : coordinates) uv = bake::transform_uv(*needs.tangents, uv);
  if (!model::generate_tangents(geometry, coordinates, budget_)) {
    notes_.add("A mesh", "asks for too much memory for its tangents");
  }
}

}  // namespace gltfx
