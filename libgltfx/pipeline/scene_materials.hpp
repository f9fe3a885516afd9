// SPDX-License-Identifier: Apache-2.0
/// Materials and textures of an asset as those of a scene: images are decoded, each once. What a
/// user is told of things that are not drawn.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "codec/client.hpp"
#include "model/asset.hpp"
#include "model/material.hpp"
#include "model/memory_budget.hpp"
#include "model/resource_data.hpp"
#include "model/texture.hpp"
#include "render/scene.hpp"

namespace gltfx {

class SceneNotes {
 public:
  /// A sentence of its own.
  void add(std::string sentence);
  /// Something with a place that shares its outcome with others: "Image 3", "is not there".
  void add(const std::string& place, const std::string& outcome);
  /// The same for something that is not drawn, or not all of it.
  void leave_out(const std::string& place, const std::string& outcome);

  /// Whether nothing was left out.
  bool complete() const { return complete_; }
  /// All of them, first what was left out; those beyond a few dozen are counted.
  std::vector<std::string> take();

 private:
  struct Kind {
    std::string first;
    std::uint64_t count = 0;
    bool left_out = false;
  };
  bool complete_ = true;
  std::vector<std::string> sentences_;
  std::uint64_t more_ = 0;
  std::map<std::string, Kind> kinds_;
};

/// Textures are noted while materials are read, and decoded together in the end. All references
/// must outlive it.
class SceneTextures {
 public:
  SceneTextures(const model::Asset& asset, const model::ResourceData& resources, SceneNotes& notes,
                render::Scene& scene)
      : asset_(asset), resources_(resources), notes_(notes), scene_(scene) {}

  /// The index in the scene of a texture of the asset.
  std::uint32_t use(std::uint32_t texture);

  /// Decodes the images of all textures in use, on up to `jobs` threads. What cannot be had becomes
  /// a texture that is marked as missing, with a note. `pixel`: see find_halvings(); large images
  /// get no more texels than show.
  void decode(codec::Client& client, unsigned jobs, model::MemoryBudget& budget, double pixel);

 private:
  struct Job {
    std::uint32_t image = 0;
    std::uint32_t halvings = 0;
    codec::ImageResult result{};
  };

  /// Why an image is not even tried, or empty.
  std::string obstacle(std::uint32_t image) const;
  void plan(model::MemoryBudget& budget);
  void choose_detail(double pixel);
  void finish(std::uint32_t index);

  const model::Asset& asset_;
  const model::ResourceData& resources_;
  SceneNotes& notes_;
  render::Scene& scene_;
  std::unordered_map<std::uint32_t, std::uint32_t> known_;  ///< by texture of the asset
  std::vector<std::uint32_t> used_;                         ///< the other way round
  std::vector<model::Texture> textures_;                    ///< likewise
  std::vector<Job> jobs_;
  std::uint64_t pixels_ = 0;                               ///< of all jobs, by headers
  std::unordered_map<std::uint32_t, std::size_t> job_of_;  ///< by image
};

/// What meshes need to know of their material.
struct MaterialNeeds {
  std::uint32_t material = render::kNone;  ///< index in the scene
  /// The n of each TEXCOORD_n that is read. The material's uses count along this list.
  std::vector<std::uint32_t> tex_coords;
  /// What tangents are needed for, if any: its set is in the list above.
  std::optional<render::TextureUse> tangents;
};

/// Translates each material that is used once. The asset, the scene and the textures must outlive
/// it.
class SceneMaterials {
 public:
  /// `uvs`: a material without textures needs the first set of texture coordinates.
  SceneMaterials(const model::Asset& asset, const model::AnimatedValues& animated,
                 SceneTextures& textures, SceneNotes& notes, render::Scene& scene, bool uvs = false)
      : asset_(asset),
        animated_(animated),
        textures_(textures),
        notes_(notes),
        scene_(scene),
        uvs_(uvs) {
    if (uvs) default_.tex_coords = {0};
  }

  /// Of a material of the asset; nothing: the default material.
  const MaterialNeeds& use(const std::optional<std::uint32_t>& material);

 private:
  MaterialNeeds translate(const model::Material& material);

  const model::Asset& asset_;
  const model::AnimatedValues& animated_;
  SceneTextures& textures_;
  SceneNotes& notes_;
  render::Scene& scene_;
  const bool uvs_;
  std::unordered_map<std::uint32_t, MaterialNeeds> known_;
  MaterialNeeds default_;
};

}  // namespace gltfx
