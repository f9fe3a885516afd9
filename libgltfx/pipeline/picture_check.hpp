// SPDX-License-Identifier: Apache-2.0
/// Whether a change of an asset changes its picture.
#pragma once

#include <gltfx/bake.hpp>

#include <memory>
#include <string>
#include <vector>

#include "pipeline/bake_scene.hpp"
#include "preview/framing.hpp"
#include "preview/picture.hpp"
#include "prove/picture.hpp"
#include "render/view.hpp"
#include "rules/validated_asset.hpp"

namespace gltfx {

/// Small pictures of an asset before a change: of its default scene, from two opposite sides.
class PictureCheck {
 public:
  /// Draws. `root` and `schemas` as in BakeOptions; `jobs`: threads.
  PictureCheck(const validate::ValidatedAsset& before, const std::string& root,
               std::shared_ptr<const schema::Set> schemas, unsigned jobs);

  /// Why there are no pictures; empty: there are.
  const std::string& obstacle() const { return obstacle_; }
  /// How the pictures of `after`, with the same seeds and from the same places, differ beyond the
  /// noise, a sentence without stop; empty: they do not. Precondition: there is no obstacle.
  std::string find_difference(const validate::ValidatedAsset& after) const;

 private:
  preview::Picture draw(const BakeScene& scene, const render::View& view, std::uint32_t seed) const;

  BakeOptions options_;
  std::string obstacle_;
  std::optional<preview::Subject> subject_;
  Vec3d origin_;  ///< of the scene
  std::vector<render::View> views_;
  prove::PictureProof proof_;
};

}  // namespace gltfx
