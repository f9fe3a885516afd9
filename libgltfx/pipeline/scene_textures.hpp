// SPDX-License-Identifier: Apache-2.0
/// Textures of an asset as those of a scene: their images decoded, each once.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "bake/scene.hpp"
#include "codec/client.hpp"
#include "model/asset.hpp"
#include "model/memory_budget.hpp"
#include "model/resource_data.hpp"
#include "model/texture.hpp"
#include "pipeline/scene_notes.hpp"

namespace gltfx {

/// Textures are noted while materials are read, and decoded together in the end. All references
/// must outlive it.
class SceneTextures {
 public:
  SceneTextures(const model::Asset& asset, const model::ResourceData& resources, SceneNotes& notes,
                bake::Scene& scene)
      : asset_(asset), resources_(resources), notes_(notes), scene_(scene) {}

  /// The index in the scene of a texture of the asset.
  std::uint32_t use(std::uint32_t texture);

  /// Decodes the images of all textures in use, on up to `jobs` threads. What cannot be had becomes
  /// a texture that is marked as missing, with a note.
  void decode(codec::Client& client, unsigned jobs, model::MemoryBudget& budget);

 private:
  struct Job {
    std::uint32_t image = 0;
    codec::ImageResult result{};
  };

  /// Why an image is not even tried, or empty.
  std::string obstacle(std::uint32_t image) const;
  void plan(model::MemoryBudget& budget);
  void finish(std::uint32_t index);

  const model::Asset& asset_;
  const model::ResourceData& resources_;
  SceneNotes& notes_;
  bake::Scene& scene_;
  std::unordered_map<std::uint32_t, std::uint32_t> known_;  ///< by texture of the asset
  std::vector<std::uint32_t> used_;                         ///< the other way round
  std::vector<model::Texture> textures_;                    ///< likewise
  std::vector<Job> jobs_;
  std::uint64_t pixels_ = 0;                               ///< of all jobs, by headers
  std::unordered_map<std::uint32_t, std::size_t> job_of_;  ///< by image
};

}  // namespace gltfx
