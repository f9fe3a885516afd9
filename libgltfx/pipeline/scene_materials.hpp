// SPDX-License-Identifier: Apache-2.0
/// Materials and textures of an asset as those of a scene: images are decoded, each once. What a
/// user is told of things that are not drawn.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
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
  /// Adds those on another asset, which is named.
  void add_all(SceneNotes& others, const std::string& name);
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

/// An asset that a scene is made of. All references must outlive what is made of it.
struct SceneSource {
  const model::Asset& asset;
  const model::ResourceData& resources;
  const model::AnimatedValues& animated;
  SceneNotes& notes;
};

/// Textures are noted while materials are read, and decoded together in the end. The scene must
/// outlive it.
class SceneTextures {
 public:
  explicit SceneTextures(render::Scene& scene) : scene_(scene) {}

  /// The index in the scene of a texture of the asset.
  std::uint32_t use(const SceneSource& source, std::uint32_t texture);

  /// Decodes the images of all textures in use, on up to `jobs` threads. What cannot be had becomes
  /// a texture that is marked as missing, with a note. `pixel`: see find_halvings(); large images
  /// get no more texels than show.
  void decode(codec::Client& client, unsigned jobs, model::MemoryBudget& budget, double pixel);

 private:
  /// A texture or an image of an asset.
  using Place = std::pair<const SceneSource*, std::uint32_t>;
  struct Used {
    Place place;
    model::Texture texture;
  };
  struct Job {
    Place place;
    std::uint32_t halvings = 0;
    codec::ImageResult result{};
  };

  void plan(model::MemoryBudget& budget);
  void choose_detail(double pixel);
  void finish(std::uint32_t index);

  render::Scene& scene_;
  std::map<Place, std::uint32_t> known_;
  std::vector<Used> used_;  ///< as in the scene
  std::vector<Job> jobs_;
  std::uint64_t pixels_ = 0;             ///< of all jobs, by headers
  std::map<Place, std::size_t> job_of_;  ///< by image
};

/// What meshes need to know of their material.
struct MaterialNeeds {
  std::uint32_t material = render::kNone;  ///< index in the scene
  /// The n of each TEXCOORD_n that is read. The material's uses count along this list.
  std::vector<std::uint32_t> tex_coords;
  /// What tangents are needed for, if any: its set is in the list above.
  std::optional<render::TextureUse> tangents;
};

/// Translates each material that is used once. The source, the scene and the textures must outlive
/// it.
class SceneMaterials {
 public:
  /// `uvs`: a material without textures needs the first set of texture coordinates.
  SceneMaterials(const SceneSource& source, SceneTextures& textures, render::Scene& scene,
                 bool uvs = false)
      : source_(source), textures_(textures), scene_(scene), uvs_(uvs) {
    if (uvs) default_.tex_coords = {0};
  }

  /// Of a material of the asset; nothing: the default material.
  const MaterialNeeds& use(const std::optional<std::uint32_t>& material);

 private:
  MaterialNeeds translate(const model::Material& material);

  const SceneSource& source_;
  SceneTextures& textures_;
  render::Scene& scene_;
  const bool uvs_;
  std::unordered_map<std::uint32_t, MaterialNeeds> known_;
  MaterialNeeds default_;
};

}  // namespace gltfx
