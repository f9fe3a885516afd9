// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_part.hpp"

#include <algorithm>
#include <utility>

#include "codec/client.hpp"
#include "container/opened_files.hpp"
#include "model/keyframes.hpp"
#include "model/light.hpp"
#include "model/texture.hpp"

namespace gltfx {
namespace {

using model::NodeIndex;
using model::RootArray;

// By index: those of textures, and of the light from all around.
std::vector<bool> images_in_use(const model::Asset& asset, const PartChoice& choice,
                                const SceneOptions& options) {
  std::vector<bool> used(asset.count(RootArray::images));
  for (const json::NodeId texture : asset.elements(RootArray::textures)) {
    if (texture == json::kNoNode || !options.textures) continue;
    for (const std::uint32_t image : model::read_texture(asset, texture).images) used[image] = true;
  }
  const auto light = choice.roots.scene && choice.environment
                         ? model::environment_light_of(asset, *choice.roots.scene)
                         : std::nullopt;
  for (std::size_t i = 0; light && i < light->faces.size(); ++i) used[light->faces[i]] = true;
  return used;
}

void load_part(ScenePart& part, const SceneOptions& options) {
  container::OpenedFiles files(part.opened.resolver());
  const std::vector<bool> images = images_in_use(part.asset, part.choice, options);
  model::LoadedResources loaded = model::load_resources(part.opened.container(), files, part.asset,
                                                        part.views, options.jobs, &images);
  for (const model::MissingData& missing : loaded.missing) part.notes.add(missing.sentence());
  part.resources = std::move(loaded.data);
}

void animate(ScenePart& part, double time, const schema::Set& schemas) {
  const auto& animation = part.choice.animation;
  if (!animation || *animation >= part.asset.count(RootArray::animations)) return;
  model::AnimationSample sample =
      model::sample_animation(part.asset, part.views, part.resources, schemas, *animation, time);
  part.animated = std::move(sample.values);
  for (std::string& note : sample.notes) part.notes.add(std::move(note));
}

bool is_drawn(const ScenePart& part, NodeIndex index) {
  if (part.pose.in_scene[index] == 0) return false;
  const model::Node& node = part.views.nodes[index];
  if (node.camera) return true;
  return part.pose.visible[index] != 0 && (node.mesh || model::light_of(part.asset, node));
}

}  // namespace

ScenePart::ScenePart(const model::OpenedAsset& opened_asset, PartChoice part_choice,
                     const SceneOptions& options, const schema::Set& schemas)
    : opened(opened_asset),
      choice(std::move(part_choice)),
      asset(opened.document()),
      views(opened.views()) {
  load_part(*this, options);
  animate(*this, options.time, schemas);
  const model::SceneRoots& roots = choice.roots;
  if (!roots.note.empty() && !views.nodes.empty()) notes.add(roots.note);
  pose = model::compute_pose(asset, views, roots, animated);
  draco.add_all(asset, views, resources);
  draco.decode(codec::Client::shared(), options.jobs);
  for (NodeIndex node = 0; node < views.nodes.size(); ++node) {
    if (is_drawn(*this, node)) drawn.push_back(node);
  }
  places = model::external_places(opened.document(), views);
  std::erase_if(
      places, [this](const model::ExternalPlace& place) { return pose.visible[place.node] == 0; });
}

std::size_t ScenePart::most_materials() const {
  std::size_t primitives = 0;
  for (const model::Mesh& mesh : views.meshes) primitives += mesh.primitives.size();
  return std::min(primitives, asset.count(RootArray::materials)) + 1;
}

}  // namespace gltfx
