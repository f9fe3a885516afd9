// SPDX-License-Identifier: Apache-2.0
/// From a file to a scene that rays can be sent into.
#pragma once

#include <gltfx/bake.hpp>

#include <memory>
#include <optional>
#include <string>

#include "base/result.hpp"
#include "pipeline/scene_builder.hpp"
#include "preview/framing.hpp"
#include "render/bvh.hpp"
#include "render/scene.hpp"
#include "rules/validated_asset.hpp"

namespace gltfx {

class Clip;

/// What is to be drawn of one file, or a report that says why nothing is. The scene stays where it
/// is when this is moved.
struct BakeScene {
  BakeReport report;  ///< with notes of the scene
  std::unique_ptr<const render::Scene> scene;
  std::optional<render::Bvh> bvh;
  std::optional<preview::Subject> subject;  ///< all that is drawn
  std::optional<preview::Subject> framed;   ///< what the picture is of; nothing: the subject
  Vec3d origin;                             ///< see BuiltScene
  std::string unseen = {};                  ///< why nothing in it is visible, if a rule says so
  bool dim_backdrop = false;                ///< see needs_dim_backdrop()
  std::shared_ptr<const Clip> clip;         ///< of a scene that is its first frame; else null

  /// What framing needs of the subjects, after it.
  void forget_faces() {
    if (subject) subject->forget_faces();
    framed.reset();
  }
  bool ready() const { return bvh.has_value(); }
  /// Lit and framed as another scene was; only the box of its subject is needed.
  void follow(const preview::Subject& other, const Vec3d& other_origin);
};

/// Opens, validates, reads and poses. Nothing is written.
BakeScene load_bake_scene(const std::string& path, const BakeOptions& options);
/// The same for what was opened and validated already. With `strict`, errors of its report refuse
/// it. Precondition: the asset has a document.
BakeScene load_bake_scene(validate::ValidatedAsset asset, const BakeOptions& options);
/// The same for an asset that is needed further on.
BakeScene load_bake_scene_of(const validate::ValidatedAsset& asset, const BakeOptions& options);

/// Validates as baking does.
validate::ValidatedAsset validate_to_bake(model::OpenedAsset asset, const BakeOptions& options);

/// No scene, and why.
BakeScene failed_scene(const std::string& path, BakeProblem problem, std::string error);

/// The scene as far as framing needs it; markers have no size.
Result<BuiltScene> build_outline(const validate::ValidatedAsset& asset, const BakeOptions& options,
                                 const std::optional<Vec3d>& origin);

/// What all scenes of a clip have in common.
struct ClipStage {
  Vec3d origin;              ///< see BuiltScene
  double marker_radius = 0;  ///< see preview::give_markers_size()
  double size = 0;           ///< of what is visible in the clip
};

/// The steps of it: what the report forbids; all but the hierarchy, and that. Where `subject` is
/// set before the last one, it and `framed` stay. `stage`: of a clip; null: one that suits the
/// scene.
BakeScene begin_bake_scene(const validate::ValidatedAsset& asset, FileReport report,
                           const BakeOptions& options);
BakeScene build_bake_scene(const validate::ValidatedAsset& asset, FileReport report,
                           const BakeOptions& options, const ClipStage* stage = nullptr);
BakeScene prepare_bake_scene(BakeScene built, const BakeOptions& options);

}  // namespace gltfx
