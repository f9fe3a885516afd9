// SPDX-License-Identifier: Apache-2.0
// What scenes draw, as accessors declare it: no vertex is read.
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "base/checked.hpp"
#include "measure/drawn.hpp"
#include "measure/nodes.hpp"
#include "measure/take.hpp"
#include "model/fields.hpp"
#include "model/info.hpp"
#include "model/instancing.hpp"
#include "model/skin.hpp"

namespace gltfx::measure {
namespace {

using model::NodeIndex;
using model::RootArray;

// What nodes of a scene draw together.
struct Drawn {
  std::uint64_t draw_calls = 0, blended = 0, instances = 0, triangles = 0, vertices = 0;
  std::uint64_t slots = 0, skinned = 0, fixed = 0;
  std::set<std::uint32_t> materials;
  bool readable = true;  // whether all copies are known
};

// Sizes and materials of a mesh, made once for all nodes.
struct MeshDraw {
  std::uint64_t triangles = 0, vertices = 0, primitives = 0, blended = 0;
  std::vector<std::uint32_t> materials;  // distinct
  bool plain = false;                    // a primitive has none
};

std::vector<bool> blended_materials(const Source& source) {
  std::vector<bool> blended;
  for (const json::NodeId object : source.asset().elements(RootArray::materials)) {
    blended.push_back(object != json::kNoNode &&
                      model::string_member(source.document(), object, "alphaMode") == "BLEND");
  }
  return blended;
}

std::vector<MeshDraw> mesh_draws(const Source& source) {
  const std::vector<bool> blended = blended_materials(source);
  std::vector<MeshDraw> draws;
  for (const model::Mesh& mesh : source.views().meshes) {
    MeshDraw& draw = draws.emplace_back();
    for (const model::Primitive& primitive : mesh.primitives) {
      const auto [vertices, triangles] = model::primitive_size(source.views(), primitive);
      draw.triangles = saturating_add(draw.triangles, triangles);
      draw.vertices = saturating_add(draw.vertices, vertices);
      ++draw.primitives;
      if (!primitive.material) {
        draw.plain = true;
        continue;
      }
      if (blended[*primitive.material]) ++draw.blended;
      draw.materials.push_back(*primitive.material);
    }
    std::sort(draw.materials.begin(), draw.materials.end());
    draw.materials.erase(std::unique(draw.materials.begin(), draw.materials.end()),
                         draw.materials.end());
  }
  return draws;
}

// The product, or the most that there is.
std::uint64_t times(std::uint64_t a, std::uint64_t b) {
  return checked_mul(a, b).value_or(UINT64_MAX);
}

class SceneTaker {
 public:
  explicit SceneTaker(Taking& taking)
      : taking_(taking), source_(taking.source()), meshes_(mesh_draws(taking.source())) {
    for (const json::NodeId object : source_.asset().elements(RootArray::skins)) {
      if (object == json::kNoNode) continue;
      for (const NodeIndex joint : model::read_skin(source_.asset(), object).joint_nodes) {
        joints_.insert(joint);
      }
    }
  }

  void take(std::uint32_t scene) {
    const SceneNodes& nodes = source_.nodes_of(scene);
    const Drawn drawn = draw(nodes);
    const auto set = [&](Name name, std::uint64_t value) {
      if (Column* column = taking_.column(MeasureScope::scene, name)) column->set(scene, value);
    };
    const auto set_copies = [&](Name name, std::uint64_t value) {
      Column* column = taking_.column(MeasureScope::scene, name);
      if (column == nullptr) return;
      if (drawn.readable) return column->set(scene, value);
      column->could_not_be_taken(scene, kUnreadCopies);
    };
    const auto& depths = nodes.depths;
    const auto deepest = std::max_element(depths.begin(), depths.end());
    set(Name::root_nodes, static_cast<std::uint64_t>(std::count(depths.begin(), depths.end(), 1U)));
    set(Name::depth, deepest == depths.end() ? 0 : *deepest);
    set(Name::empty_nodes, count_empty(nodes));
    set(Name::drawn_meshes, nodes.drawn.size());
    set(Name::draw_calls, drawn.draw_calls);
    set(Name::blended_draw_calls, drawn.blended);
    set(Name::used_materials, drawn.materials.size());
    set(Name::material_slots, drawn.slots);
    set(Name::skinned_meshes, drawn.skinned);
    set(Name::static_meshes, drawn.fixed);
    set_copies(Name::instances, drawn.instances);
    set_copies(Name::drawn_triangles, drawn.triangles);
    set_copies(Name::drawn_vertices, drawn.vertices);
    if (Column* column = taking_.column(MeasureScope::scene, Name::root_transform)) {
      column->set(scene, MeasureValue(roots_are_clean(nodes)));
    }
  }

  void refuse(std::uint32_t scene) {
    for (const Name name :
         {Name::root_nodes, Name::depth, Name::empty_nodes, Name::drawn_meshes, Name::draw_calls,
          Name::blended_draw_calls, Name::used_materials, Name::material_slots,
          Name::skinned_meshes, Name::static_meshes, Name::instances, Name::drawn_triangles,
          Name::drawn_vertices, Name::root_transform}) {
      Column* column = taking_.column(MeasureScope::scene, name);
      if (column != nullptr) column->could_not_be_taken(scene, kTooManyScenes);
    }
  }

 private:
  Drawn draw(const SceneNodes& nodes) const {
    Drawn drawn;
    std::set<std::uint32_t> meshes;
    for (const NodeIndex index : nodes.drawn) {
      const model::Node& node = source_.views().nodes[index];
      const MeshDraw& mesh = meshes_[*node.mesh];
      const auto copies =
          model::count_copies(source_.asset(), source_.views(), source_.resources(), node);
      drawn.readable = drawn.readable && copies;
      drawn.draw_calls = saturating_add(drawn.draw_calls, mesh.primitives);
      drawn.blended = saturating_add(drawn.blended, mesh.blended);
      drawn.slots = saturating_add(drawn.slots, mesh.materials.size() + (mesh.plain ? 1U : 0U));
      drawn.instances = saturating_add(drawn.instances, copies.value_or(0));
      drawn.triangles = saturating_add(drawn.triangles, times(mesh.triangles, copies.value_or(0)));
      drawn.vertices = saturating_add(drawn.vertices, times(mesh.vertices, copies.value_or(0)));
      ++(node.skin ? drawn.skinned : drawn.fixed);
      const bool fresh = meshes.insert(*node.mesh).second;
      if (fresh) drawn.materials.insert(mesh.materials.begin(), mesh.materials.end());
    }
    return drawn;
  }

  std::uint64_t count_empty(const SceneNodes& nodes) const {
    return static_cast<std::uint64_t>(
        std::count_if(nodes.all.begin(), nodes.all.end(), [&](NodeIndex index) {
          const model::Node& node = source_.views().nodes[index];
          return !node.mesh && !node.camera && node.children == json::kNoNode &&
                 node.extensions == json::kNoNode && !joints_.contains(index);
        }));
  }

  bool roots_are_clean(const SceneNodes& nodes) const {
    for (std::size_t i = 0; i < nodes.all.size(); ++i) {
      if (nodes.depths[i] == 1 && !is_identity(stored_transform(source_, nodes.all[i])))
        return false;
    }
    return true;
  }

  Taking& taking_;
  const Source& source_;
  const std::vector<MeshDraw> meshes_;
  std::set<NodeIndex> joints_;
};

}  // namespace

void take_scenes(Taking& taking) {
  SceneTaker taker(taking);
  for (std::uint32_t scene = 0; scene < taking.count(MeasureScope::scene); ++scene) {
    if (is_affordable(taking.source(), scene)) {
      taker.take(scene);
    } else {
      taker.refuse(scene);
    }
  }
}

}  // namespace gltfx::measure
