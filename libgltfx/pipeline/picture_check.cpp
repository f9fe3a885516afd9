// SPDX-License-Identifier: Apache-2.0
#include "pipeline/picture_check.hpp"

#include <utility>

#include "pipeline/bake_picture.hpp"
#include "pipeline/bake_views.hpp"

namespace gltfx {
namespace {

constexpr std::uint32_t kSide = 64;  // pixels
constexpr std::uint32_t kSamples = 24;
constexpr std::uint32_t kViews = 2;

}  // namespace

PictureCheck::PictureCheck(const validate::ValidatedAsset& before, const std::string& root,
                           std::shared_ptr<const schema::Set> schemas, unsigned jobs) {
  options_.sizes = {{kSide, kSide}};
  options_.turntable = kViews;
  options_.samples = kSamples;
  options_.denoise = false;  // noise is to be measured
  options_.root = root;
  options_.schemas = std::move(schemas);
  options_.jobs = jobs;
  const BakeScene scene = load_bake_scene_of(before, options_);
  if (!scene.ready()) {
    obstacle_ = scene.report.error;
    return;
  }
  views_ = *choose_views(scene, options_, 1);
  for (const render::View& view : views_) proof_.add(draw(scene, view, 0), draw(scene, view, 1));
  subject_ = scene.subject;
  subject_->forget_faces();
  origin_ = scene.origin;
}

std::string PictureCheck::find_difference(const validate::ValidatedAsset& after) const {
  BakeScene scene = load_bake_scene_of(after, options_);
  if (!scene.ready()) return "the new asset cannot be drawn: " + scene.report.error;
  scene.follow(*subject_, origin_);
  std::vector<preview::Picture> now;
  for (const render::View& view : views_) {
    now.push_back(draw(scene, moved(view, origin_, scene.origin), 0));
  }
  return proof_.find_difference(now);
}

preview::Picture PictureCheck::draw(const BakeScene& scene, const render::View& view,
                                    std::uint32_t seed) const {
  BakeOptions options = options_;
  options.seed = seed;
  return preview::tone_mapped_picture(
      draw_picture(scene, view, options_.sizes.front(), options, {}, {}), false,
      preview::PixelType::bytes);
}

}  // namespace gltfx
