// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "codec/client.hpp"
#include "model/camera.hpp"
#include "model/instancing.hpp"
#include "model/light.hpp"
#include "pipeline/scene_environment.hpp"
#include "pipeline/scene_meshes.hpp"
#include "pipeline/scene_origin.hpp"
#include "pipeline/scene_tree.hpp"
#include "render/bvh_groups.hpp"

namespace gltfx {
namespace {

using model::Affine;
using model::NodeIndex;
using model::RootArray;
using model::Vector3;

// What a byte of the asset is worth in memory: triangles as they are mostly stored, with all that
// rays need of them; compressed geometry and images of usual size.
constexpr std::uint64_t kPlainWorth = 16;
constexpr std::uint64_t kPackedWorth = 32;

// Relative to another origin: before anything is rounded.
Affine relative_to(const Vector3& origin, const Affine& world) {
  Affine moved = world;
  for (std::size_t i = 0; i < 3; ++i) moved.columns[3][i] -= origin[i];
  return moved;
}

Float3 narrow(const Vector3& from) {
  return {static_cast<float>(from[0]), static_cast<float>(from[1]), static_cast<float>(from[2])};
}

render::Matrix34 rows_of(const Affine& affine) {
  render::Matrix34 rows{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 4; ++c) rows[r][c] = static_cast<float>(affine.columns[c][r]);
  }
  return rows;
}

bool is_finite(const render::Matrix34& matrix) {
  return std::all_of(matrix.begin(), matrix.end(), [](const Float4& row) {
    return std::all_of(row.begin(), row.end(), [](float value) { return std::isfinite(value); });
  });
}

// Where a camera is and looks, whatever the scale of its node.
Affine without_scale(const Affine& world) {
  Affine frame = world;
  frame.columns[2] = model::unit(world.columns[2]);
  if (frame.columns[2] == Vector3{}) frame.columns[2] = {0, 0, 1};
  frame.columns[0] = model::unit(model::cross(world.columns[1], frame.columns[2]));
  if (frame.columns[0] == Vector3{}) {
    const Vector3 axis = std::abs(frame.columns[2][1]) < 0.9 ? Vector3{0, 1, 0} : Vector3{1, 0, 0};
    frame.columns[0] = model::unit(model::cross(axis, frame.columns[2]));
  }
  frame.columns[1] = model::cross(frame.columns[2], frame.columns[0]);
  return frame;
}

render::Light to_light(const model::Light& from, const Affine& world) {
  render::Light light;
  light.kind = static_cast<render::Light::Kind>(from.type);
  for (std::size_t i = 0; i < 3; ++i) light.intensity[i] = from.color[i] * from.intensity;
  light.position = narrow(world.columns[3]);
  const Vector3 direction = model::unit(world.vector({0, 0, -1}));
  if (direction != Vector3{}) light.direction = narrow(direction);
  light.range = std::isfinite(from.range) ? from.range : 0;
  light.inner_cone = from.inner_cone_angle;
  light.outer_cone = from.outer_cone_angle;
  return light;
}

render::Camera to_camera(const model::Camera& from, const Affine& world) {
  render::Camera camera;
  camera.name = from.name;
  camera.to_world = rows_of(without_scale(world));
  camera.perspective = from.perspective;
  if (from.perspective) camera.yfov = from.y_fov;
  camera.aspect_ratio = from.aspect_ratio;
  if (!from.perspective) camera.xmag = from.x_mag;
  if (!from.perspective) camera.ymag = from.y_mag;
  camera.znear = from.z_near;
  camera.zfar = std::isfinite(from.z_far) ? from.z_far : 0;
  return camera;
}

std::uint64_t image_bytes(const model::ResourceData& resources) {
  std::uint64_t bytes = 0;
  for (const auto& image : resources.images) {
    if (image.bytes) bytes = saturating_add(bytes, image.bytes->size());
  }
  return bytes;
}

std::uint64_t worth(std::uint64_t bytes, std::uint64_t each) {
  return checked_mul(bytes, each).value_or(std::numeric_limits<std::uint64_t>::max());
}

std::uint64_t geometry_budget(const SceneTree& tree, const SceneOptions& options) {
  std::uint64_t budget = options.free_bytes;
  tree.for_each_part([&budget](const ScenePart& part) {
    const std::uint64_t each =
        model::has_compressed_geometry(part.asset.document()) ? kPackedWorth : kPlainWorth;
    budget = saturating_add(budget, worth(part.resources.buffer_bytes(), each));
  });
  return budget;
}

std::uint64_t pixel_budget(const SceneTree& tree, const SceneOptions& options) {
  std::uint64_t budget = options.free_pixel_bytes;
  tree.for_each_part([&budget](const ScenePart& part) {
    const std::uint64_t bytes =
        saturating_add(part.resources.buffer_bytes(), image_bytes(part.resources));
    budget = saturating_add(budget, worth(bytes, kPackedWorth));
  });
  return budget;
}

/// What is drawn of a part, the same at all its places.
struct PartDrawing {
  PartDrawing(ScenePart& from, const Vector3& origin, const SceneOptions& options,
              SceneTextures& textures, model::MemoryBudget& budget, render::Scene& scene)
      : part(from),
        source(from.source()),
        geometry(from.geometry()),
        materials(source, textures, scene, options.uvs),
        meshes(geometry, {from.pose, from.animated, origin}, from.choice.variant, materials, budget,
               from.notes, scene),
        lights(model::read_lights(from.asset, &from.animated)) {}
  PartDrawing(const PartDrawing&) = delete;
  PartDrawing& operator=(const PartDrawing&) = delete;

  ScenePart& part;
  const SceneSource source;
  const model::GeometrySource geometry;
  SceneMaterials materials;
  SceneMeshes meshes;
  const std::vector<std::optional<model::Light>> lights;
};

/// One scene on its way.
class SceneBuilder {
 public:
  SceneBuilder(const SceneTree& tree, const SceneOptions& options)
      : tree_(tree),
        options_(options),
        geometry_budget_(geometry_budget(tree, options)),
        pixel_budget_(pixel_budget(tree, options)) {}

  BuiltScene run() {
    origin_ = options_.origin ? Vector3{options_.origin->x, options_.origin->y, options_.origin->z}
                              : find_origin(tree_);
    SceneTextures textures(scene_);
    // A scene's material is large: the vector is not to be copied while it grows.
    std::size_t materials = 0;
    tree_.for_each_part([&](const ScenePart& part) { materials += part.most_materials(); });
    scene_.materials.reserve(materials);
    std::map<const ScenePart*, std::unique_ptr<PartDrawing>> drawings;
    for (const PlacedPart& placed : tree_.placed()) {
      std::unique_ptr<PartDrawing>& drawing = drawings[placed.part];
      if (!drawing) {
        drawing =
            std::make_unique<PartDrawing>(*placed.part, placed.depth == 0 ? origin_ : Vector3{},
                                          options_, textures, geometry_budget_, scene_);
      }
      place_all(placed, *drawing);
    }
    std::optional<preview::Subject> subject = preview::find_subject(scene_);
    if (options_.textures) {
      textures.decode(codec::Client::shared(), options_.jobs, pixel_budget_, pixel_size(subject));
    }
    if (options_.environment) light(tree_.root());
    return {std::move(scene_), std::move(subject), {origin_[0], origin_[1], origin_[2]}, true};
  }

 private:
  // Side of a pixel of the picture; 0: not known.
  double pixel_size(const std::optional<preview::Subject>& subject) const {
    if (!subject || options_.picture_side == 0) return 0;
    const double shown = options_.shown_size > 0 ? options_.shown_size : subject->size();
    return shown / options_.picture_side;
  }

  void light(ScenePart& part) {
    if (!part.choice.roots.scene) return;
    const auto light =
        model::environment_light_of(part.asset, *part.choice.roots.scene, &part.animated);
    if (!light) return;
    scene_.environment = std::make_shared<const render::EnvironmentImage>(
        environment_of(*light, part.resources, pixel_budget_, part.notes));
  }

  void place_all(const PlacedPart& placed, PartDrawing& drawing) {
    const ScenePart& part = drawing.part;
    for (const NodeIndex node : part.drawn) {
      const Affine world = relative_to(origin_, placed.world(node));
      place_camera(part, node, world);
      if (part.pose.visible[node] == 0) continue;
      const auto light = model::light_of(part.asset, part.views.nodes[node]);
      if (light && *light < drawing.lights.size() && drawing.lights[*light]) {
        scene_.lights.push_back(to_light(*drawing.lights[*light], world));
      }
      const std::size_t before = scene_.instances.size();
      if (part.views.nodes[node].mesh) place_mesh(placed, node, world, drawing);
      if (tree_.frames(placed, node)) frame_from(before);
    }
    if (placed.depth == 0 && part.views.nodes.empty()) place_library(drawing);
  }

  void frame_from(std::size_t first) {
    for (std::size_t i = first; i < scene_.instances.size(); ++i) {
      scene_.framed.push_back(static_cast<std::uint32_t>(i));
    }
  }

  // A file that only brings meshes for others to use shows all of them, in one place.
  void place_library(PartDrawing& drawing) {
    const std::size_t count = drawing.part.views.meshes.size();
    if (count == 0) return;
    SceneNotes& notes = drawing.part.notes;
    notes.add("The file has no nodes; its meshes are drawn where they are.");
    for (std::uint32_t mesh = 0; mesh < count; ++mesh) {
      for (const DrawnMeshes& drawn : drawing.meshes.use_mesh(mesh)) place(drawn, Affine(), notes);
    }
  }

  void place_camera(const ScenePart& part, NodeIndex node, const Affine& world) {
    if (!part.views.nodes[node].camera) return;
    auto camera = model::read_camera(part.asset, *part.views.nodes[node].camera, &part.animated);
    if (!camera) return;
    if (camera->name.empty()) camera->name = part.asset.name(part.views.nodes[node].object);
    if (is_finite(rows_of(world))) scene_.cameras.push_back(to_camera(*camera, world));
  }

  void place_mesh(const PlacedPart& placed, NodeIndex node, const Affine& world,
                  PartDrawing& drawing) {
    ScenePart& part = drawing.part;
    const auto copies = model::read_instancing(part.asset, part.views, part.resources,
                                               part.views.nodes[node], geometry_budget_);
    if (copies && !copies->readable) {
      part.notes.leave_out(fmt::format("Node {}", node),
                           "has copies that cannot be read or that ask for too much memory");
      return;
    }
    // Skinned meshes of the asset itself are where they are drawn already.
    const Affine bound = placed.depth == 0 ? Affine() : relative_to(origin_, placed.to_scene);
    for (const DrawnMeshes& drawn : drawing.meshes.use(node)) {
      if (drawn.skinned) {
        place(drawn, bound, part.notes);
      } else if (!copies) {
        place(drawn, world, part.notes);
      } else {
        for (const Affine& copy : copies->transforms) place(drawn, world * copy, part.notes);
      }
    }
  }

  void place(const DrawnMeshes& drawn, const Affine& world, SceneNotes& notes) {
    Affine placed = world;
    placed.columns[3] = world.point(drawn.origin);
    const render::Matrix34 to_world = rows_of(placed);
    if (!is_finite(to_world)) {
      notes.leave_out("A mesh", "lies at infinity");
    } else if (!geometry_budget_.take(cost_of(drawn))) {
      notes.leave_out("A mesh", "is drawn more often than memory allows");
    } else {
      ++placed_[shape_of(drawn)].count;
      scene_.instances.push_back({drawn.mesh, to_world, drawn.count});
    }
  }

  std::uint32_t shape_of(const DrawnMeshes& drawn) {
    return shapes_.of(scene_, {drawn.mesh, render::kIdentity, drawn.count});
  }

  // Of one more instance, with all that rays need of it.
  std::uint64_t cost_of(const DrawnMeshes& drawn) {
    constexpr std::uint64_t kBytes = 96;  // of the instance itself, by all who keep count of it
    const auto [known, fresh] = placed_.try_emplace(shape_of(drawn));
    Placed& placed = known->second;
    for (std::uint32_t i = 0; fresh && i < drawn.count; ++i) {
      placed.size.triangles += scene_.meshes[drawn.mesh + i].triangles.size();
      placed.size.vertices += scene_.meshes[drawn.mesh + i].positions.size();
    }
    return kBytes + render::hierarchy_bytes(placed.size, placed.count + 1) -
           render::hierarchy_bytes(placed.size, placed.count);
  }

  struct Placed {
    render::ShapeSize size;
    std::uint64_t count = 0;
  };

  const SceneTree& tree_;
  const SceneOptions& options_;
  model::MemoryBudget geometry_budget_;
  model::MemoryBudget pixel_budget_;
  Vector3 origin_{};
  render::Shapes shapes_;
  std::unordered_map<std::uint32_t, Placed> placed_;  // by shape
  render::Scene scene_;
};

}  // namespace

BuiltScene build_scene(const validate::ValidatedAsset& validated, const schema::Set& schemas,
                       const SceneOptions& options) {
  SceneTree tree(validated.asset(), options, schemas);
  BuiltScene built = SceneBuilder(tree, options).run();
  SceneNotes notes = tree.take_notes();
  built.complete = notes.complete();
  built.scene.notes = notes.take();
  return built;
}

}  // namespace gltfx
