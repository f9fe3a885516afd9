// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "codec/client.hpp"
#include "model/camera.hpp"
#include "model/elements.hpp"
#include "model/instancing.hpp"
#include "model/keyframes.hpp"
#include "model/light.hpp"
#include "model/resource_data.hpp"
#include "model/texture.hpp"
#include "pipeline/scene_environment.hpp"
#include "pipeline/scene_meshes.hpp"
#include "pipeline/scene_origin.hpp"
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

std::uint64_t geometry_budget(const model::Asset& asset, const model::ResourceData& resources,
                              const SceneOptions& options) {
  const std::uint64_t each =
      model::has_compressed_geometry(asset.document()) ? kPackedWorth : kPlainWorth;
  return saturating_add(options.free_bytes, worth(resources.buffer_bytes(), each));
}

std::uint64_t pixel_budget(const model::ResourceData& resources, const SceneOptions& options) {
  const std::uint64_t bytes = saturating_add(resources.buffer_bytes(), image_bytes(resources));
  return saturating_add(options.free_pixel_bytes, worth(bytes, kPackedWorth));
}

/// One scene on its way.
class SceneBuilder {
 public:
  SceneBuilder(const model::Asset& asset, const model::Views& views,
               const model::ResourceData& resources, const schema::Set& schemas,
               const SceneOptions& options, SceneNotes& notes)
      : asset_(asset),
        views_(views),
        resources_(resources),
        options_(options),
        notes_(notes),
        geometry_budget_(geometry_budget(asset, resources, options)),
        pixel_budget_(pixel_budget(resources, options)) {
    animate(schemas);
  }

  BuiltScene run(const model::SceneRoots& roots) {
    if (!roots.note.empty() && !views_.nodes.empty()) notes_.add(roots.note);
    const model::Pose pose = model::compute_pose(asset_, views_, roots, animated_);
    model::DracoMeshes draco;
    draco.add_all(asset_, views_, resources_);
    draco.decode(codec::Client::shared(), options_.jobs);
    const model::GeometrySource source{asset_, views_, resources_, draco};
    const std::vector<std::uint8_t> framed = framed_nodes();
    origin_ = options_.origin ? Vector3{options_.origin->x, options_.origin->y, options_.origin->z}
                              : find_origin(asset_, views_, resources_, pose, framed);
    SceneTextures textures(asset_, resources_, notes_, scene_);
    // A scene's material is large: the vector is not to be copied while it grows.
    scene_.materials.reserve(most_materials());
    SceneMaterials materials(asset_, animated_, textures, notes_, scene_, options_.uvs);
    SceneMeshes meshes(source, {pose, animated_, origin_}, options_.variant, materials,
                       geometry_budget_, notes_, scene_);
    place_all(pose, framed, meshes);
    std::optional<preview::Subject> subject = preview::find_subject(scene_);
    if (options_.textures) {
      textures.decode(codec::Client::shared(), options_.jobs, pixel_budget_, pixel_size(subject));
    }
    if (options_.environment) light(roots);
    return {std::move(scene_), std::move(subject), {origin_[0], origin_[1], origin_[2]}, true};
  }

 private:
  // Each primitive shows one, or the default material; variants only choose among them.
  std::size_t most_materials() const {
    std::size_t primitives = 0;
    for (const model::Mesh& mesh : views_.meshes) primitives += mesh.primitives.size();
    return std::min(primitives, asset_.count(RootArray::materials)) + 1;
  }

  // Side of a pixel of the picture; 0: not known.
  double pixel_size(const std::optional<preview::Subject>& subject) const {
    if (!subject || options_.picture_side == 0) return 0;
    const double shown = options_.shown_size > 0 ? options_.shown_size : subject->size();
    return shown / options_.picture_side;
  }

  void light(const model::SceneRoots& roots) {
    if (!roots.scene) return;
    const auto light = model::environment_light_of(asset_, *roots.scene, &animated_);
    if (!light) return;
    scene_.environment = std::make_shared<const render::EnvironmentImage>(
        environment_of(*light, resources_, pixel_budget_, notes_));
  }

  void animate(const schema::Set& schemas) {
    if (!options_.animation || *options_.animation >= asset_.count(RootArray::animations)) return;
    model::AnimationSample sample = model::sample_animation(asset_, views_, resources_, schemas,
                                                            *options_.animation, options_.time);
    animated_ = std::move(sample.values);
    for (std::string& note : sample.notes) notes_.add(std::move(note));
  }

  void place_all(const model::Pose& pose, const std::vector<std::uint8_t>& framed,
                 SceneMeshes& meshes) {
    const auto lights = model::read_lights(asset_, &animated_);
    for (NodeIndex node = 0; node < views_.nodes.size(); ++node) {
      const Affine world = relative_to(origin_, pose.world[node]);
      if (pose.in_scene[node] != 0) place_camera(node, world);
      if (pose.visible[node] == 0) continue;
      const auto light = model::light_of(asset_, views_.nodes[node]);
      if (light && *light < lights.size() && lights[*light]) {
        scene_.lights.push_back(to_light(*lights[*light], world));
      }
      const std::size_t before = scene_.instances.size();
      if (views_.nodes[node].mesh) place_mesh(node, world, meshes);
      if (!framed.empty() && framed[node] != 0) frame_from(before);
    }
    if (views_.nodes.empty()) place_library(meshes);
  }

  // By node; empty: the picture is of all.
  std::vector<std::uint8_t> framed_nodes() const {
    if (!options_.frame || *options_.frame >= views_.nodes.size()) return {};
    std::vector<std::uint8_t> framed(views_.nodes.size(), 0);
    std::vector<NodeIndex> open{*options_.frame};
    while (!open.empty()) {
      const NodeIndex node = open.back();
      open.pop_back();
      if (framed[node] != 0) continue;
      framed[node] = 1;
      model::for_each_index(asset_, views_.nodes[node].children, RootArray::nodes,
                            [&](std::uint64_t, std::optional<std::uint32_t> child, Span) {
                              if (child) open.push_back(*child);
                            });
    }
    return framed;
  }

  void frame_from(std::size_t first) {
    for (std::size_t i = first; i < scene_.instances.size(); ++i) {
      scene_.framed.push_back(static_cast<std::uint32_t>(i));
    }
  }

  // A file that only brings meshes for others to use shows all of them, in one place.
  void place_library(SceneMeshes& meshes) {
    if (views_.meshes.empty()) return;
    notes_.add("The file has no nodes; its meshes are drawn where they are.");
    for (std::uint32_t mesh = 0; mesh < views_.meshes.size(); ++mesh) {
      for (const DrawnMeshes& drawn : meshes.use_mesh(mesh)) place(drawn, Affine());
    }
  }

  void place_camera(NodeIndex node, const Affine& world) {
    if (!views_.nodes[node].camera) return;
    auto camera = model::read_camera(asset_, *views_.nodes[node].camera, &animated_);
    if (!camera) return;
    if (camera->name.empty()) camera->name = asset_.name(views_.nodes[node].object);
    if (is_finite(rows_of(world))) scene_.cameras.push_back(to_camera(*camera, world));
  }

  void place_mesh(NodeIndex node, const Affine& world, SceneMeshes& meshes) {
    const auto copies =
        model::read_instancing(asset_, views_, resources_, views_.nodes[node], geometry_budget_);
    if (copies && !copies->readable) {
      notes_.leave_out(fmt::format("Node {}", node),
                       "has copies that cannot be read or that ask for too much memory");
      return;
    }
    for (const DrawnMeshes& drawn : meshes.use(node)) {
      if (drawn.skinned) {
        place(drawn, Affine());
      } else if (!copies) {
        place(drawn, world);
      } else {
        for (const Affine& copy : copies->transforms) place(drawn, world * copy);
      }
    }
  }

  void place(const DrawnMeshes& drawn, const Affine& world) {
    Affine placed = world;
    placed.columns[3] = world.point(drawn.origin);
    const render::Matrix34 to_world = rows_of(placed);
    if (!is_finite(to_world)) {
      notes_.leave_out("A mesh", "lies at infinity");
    } else if (!geometry_budget_.take(cost_of(drawn))) {
      notes_.leave_out("A mesh", "is drawn more often than memory allows");
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

  const model::Asset& asset_;
  const model::Views& views_;
  const model::ResourceData& resources_;
  const SceneOptions& options_;
  SceneNotes& notes_;
  model::MemoryBudget geometry_budget_;
  model::MemoryBudget pixel_budget_;
  model::AnimatedValues animated_;
  Vector3 origin_{};
  render::Shapes shapes_;
  std::unordered_map<std::uint32_t, Placed> placed_;  // by shape
  render::Scene scene_;
};

// By index: those of textures, and of the light from all around.
std::vector<bool> images_in_use(const model::Asset& asset, std::optional<std::uint32_t> scene,
                                const SceneOptions& options) {
  std::vector<bool> used(asset.count(RootArray::images));
  for (const json::NodeId texture : asset.elements(RootArray::textures)) {
    if (texture == json::kNoNode || !options.textures) continue;
    for (const std::uint32_t image : model::read_texture(asset, texture).images) used[image] = true;
  }
  const auto light =
      scene && options.environment ? model::environment_light_of(asset, *scene) : std::nullopt;
  for (std::size_t i = 0; light && i < light->faces.size(); ++i) used[light->faces[i]] = true;
  return used;
}

}  // namespace

BuiltScene build_scene(const validate::ValidatedAsset& validated, const schema::Set& schemas,
                       const SceneOptions& options) {
  SceneNotes notes;
  const model::OpenedAsset& opened = validated.asset();
  const model::Asset asset(opened.document());
  const model::Views& views = opened.views();
  container::OpenedFiles files(opened.resolver());
  const model::SceneRoots roots = model::choose_scene(asset, views, options.scene);
  const std::vector<bool> images = images_in_use(asset, roots.scene, options);
  model::LoadedResources loaded =
      model::load_resources(opened.container(), files, asset, views, options.jobs, &images);
  for (const model::MissingData& missing : loaded.missing) notes.add(missing.sentence());
  BuiltScene built = SceneBuilder(asset, views, loaded.data, schemas, options, notes).run(roots);
  built.complete = notes.complete();
  built.scene.notes = notes.take();
  return built;
}

}  // namespace gltfx
