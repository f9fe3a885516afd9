// SPDX-License-Identifier: Apache-2.0
/// From a file to a scene that rays can be sent into.
#pragma once

#include <gltfx/bake.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "preview/framing.hpp"
#include "render/bvh.hpp"
#include "render/scene.hpp"
#include "render/view.hpp"
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
  bool dim_backdrop = false;                ///< see choose_backdrop()
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

/// The view in another scene, whose origin may differ.
render::View moved(render::View view, const Vec3d& from_origin, const Vec3d& to_origin);

/// Validates as baking does.
validate::ValidatedAsset validate_to_bake(model::OpenedAsset asset, const BakeOptions& options);

/// The two steps of it: all but the hierarchy, and that. Where `subject` is set in between, it and
/// `framed` stay. `origin`: that of the scene, see BuiltScene; nothing: one that suits it.
BakeScene build_bake_scene(const validate::ValidatedAsset& asset, FileReport report,
                           const BakeOptions& options, const std::optional<Vec3d>& origin = {});
BakeScene prepare_bake_scene(BakeScene built, const BakeOptions& options);

/// Why there is no such camera; nothing where there is. Precondition: the scene is ready.
std::optional<Error> find_camera_error(const BakeScene& loaded, const std::string& camera);

/// The views of one of the cameras that the options may name, "" for the usual one: one, or all of
/// a turntable. An Error when there is no such camera, or it cannot do what is asked for.
/// Precondition: the scene is ready.
Result<std::vector<render::View>> choose_views(const BakeScene& loaded, const BakeOptions& options,
                                               double aspect, const std::string& camera = {});

}  // namespace gltfx
