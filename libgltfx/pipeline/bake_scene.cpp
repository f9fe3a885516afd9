// SPDX-License-Identifier: Apache-2.0
#include "pipeline/bake_scene.hpp"

#include <gltfx/validate.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/pages.hpp"
#include "base/text.hpp"
#include "codec/client.hpp"
#include "model/asset.hpp"
#include "model/variants.hpp"
#include "pipeline/bake_clip.hpp"
#include "pipeline/bake_names.hpp"
#include "pipeline/bake_refusal.hpp"
#include "pipeline/environment_file.hpp"
#include "pipeline/open_asset.hpp"
#include "pipeline/scene_builder.hpp"
#include "pipeline/scene_pose.hpp"
#include "preview/interior.hpp"
#include "preview/markers.hpp"
#include "preview/overlay.hpp"
#include "preview/view_choice.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

using BakeNotes = std::vector<std::string>;

BakeScene failed(BakeScene result, BakeProblem problem, std::string error) {
  result.report.problem = problem;
  result.report.error = std::move(error);
  return result;
}

// Whether an error of the report leaves nothing to draw.
bool forbids_picture(const FileReport& report) {
  return std::any_of(report.diagnostics.begin(), report.diagnostics.end(),
                     [](const Diagnostic& each) {
                       const RuleDescription* rule = find_rule(each.code);
                       return each.severity == Severity::error && rule != nullptr && !rule->picture;
                     });
}

FileReport errors_of(FileReport report) {
  std::erase_if(report.diagnostics,
                [](const Diagnostic& each) { return each.severity != Severity::error; });
  report.repeats.clear();
  const std::uint64_t errors = report.counts.errors;
  report.counts = Counts{};
  report.counts.errors = errors;
  return report;
}

// The longer side of pictures that have the whole scene in them; 0: the camera may be nearer.
std::uint32_t side_of_whole(const BakeOptions& options) {
  if (!options.frame.empty() || options.interior == BakeInterior::on) return 0;
  if (options.overlay == BakeOverlay::density) return 0;  // it counts texels
  for (const std::string& camera : options.cameras) {
    if (!parse_angles(camera)) return 0;
  }
  std::uint32_t side = 0;
  for (const BakeSize& size : options.sizes) side = std::max({side, size.width, size.height});
  return side;
}

Result<std::optional<std::uint32_t>> choose_animation(const model::Asset& asset,
                                                      const model::Views& views,
                                                      const BakeOptions& options,
                                                      BakeNotes& notes) {
  const auto names = names_in(asset, model::RootArray::animations);
  const bool named = std::find(names.begin(), names.end(), options.animation) != names.end();
  if (options.animation == "none" && !named) return std::optional<std::uint32_t>();
  auto found = find_part("animation", options.animation, names, {options.if_present, notes});
  if (!found || *found) return found;
  return find_pose(asset, views);
}

Result<SceneOptions> scene_options(const model::OpenedAsset& opened, const BakeOptions& options,
                                   BakeNotes& notes) {
  const model::Asset asset(opened.document());
  SceneOptions wanted;
  wanted.time = options.time;
  wanted.jobs = options.jobs;
  wanted.picture_side = side_of_whole(options);
  wanted.uvs = options.overlay == BakeOverlay::uv;
  const auto scene = find_part("scene", options.scene, names_in(asset, model::RootArray::scenes),
                               {options.if_present, notes});
  if (!scene) return scene.error();
  const auto animation = choose_animation(asset, opened.views(), options, notes);
  if (!animation) return animation.error();
  const auto variant = find_part("variant", options.variant, model::variant_names(asset),
                                 {options.if_present, notes});
  if (!variant) return variant.error();
  const auto frame = find_node(options.frame, names_in(asset, model::RootArray::nodes));
  if (!frame) return frame.error();
  wanted.frame = *frame;
  wanted.scene = *scene;
  wanted.animation = *animation;
  wanted.variant = *variant;
  return wanted;
}

Result<BuiltScene> build(const validate::ValidatedAsset& asset, const BakeOptions& options,
                         const std::optional<Vec3d>& origin, BakeNotes& notes) {
  auto wanted = scene_options(asset.asset(), options, notes);
  if (!wanted) return wanted.error();
  wanted->origin = origin;
  const auto schemas = options.schemas ? options.schemas : schema::builtin_set();
  return build_scene(asset, *schemas, *wanted);
}

std::optional<Error> light(render::Scene& scene, const BakeOptions& options) {
  if (options.lights == BakeLights::studio) scene.environment.reset();
  if (!options.environment.empty()) {
    auto environment = read_environment(options.environment);
    if (!environment) return environment.error();
    scene.environment = *std::move(environment);
  }
  const bool clay =
      options.overlay == BakeOverlay::clay || options.overlay == BakeOverlay::wireframe;
  if (clay) preview::make_clay(scene);
  // Other lights follow when it is known what they shine on.
  for (render::SceneMaterial& each : scene.materials) {
    each.factors.emissive *= std::exp2(options.exposure);
  }
  return std::nullopt;
}

// Points and lines are to be seen in a picture of all that is there.
void give_markers_size(BuiltScene& built, const BakeSize& size) {
  render::Scene& scene = built.scene;
  const bool any = std::any_of(scene.meshes.begin(), scene.meshes.end(),
                               [](const auto& mesh) { return !mesh.marker_directions.empty(); });
  if (!any) return;
  const auto subject = preview::find_subject(scene, preview::Which::framed);
  if (!subject) return;
  preview::give_markers_size(scene,
                             preview::marker_radius(*subject, std::max(size.width, size.height)));
  built.subject = preview::find_subject(scene);
}

BakeScene empty_scene(const std::string& path) {
  BakeScene scene;
  scene.report.path = path;
  scene.report.validation.path = path;
  return scene;
}

// A side of the asset, or a camera of its own.
using CameraChoice = std::variant<preview::Direction, const render::Camera*>;

std::vector<std::string> camera_names(const render::Scene& scene) {
  std::vector<std::string> names;
  for (const render::Camera& camera : scene.cameras) names.push_back(camera.name);
  return names;
}

// What is framed alone has other things around it.
preview::Direction direction_of(const BakeScene& loaded) {
  if (loaded.framed) return preview::usual_direction(*loaded.framed);
  return preview::best_direction(*loaded.scene, *loaded.subject, *loaded.bvh);
}

Result<CameraChoice> choose_camera(const BakeScene& loaded, const std::string& camera) {
  const render::Scene& scene = *loaded.scene;
  if (const auto angles = parse_angles(camera)) {
    return CameraChoice(preview::Direction{angles->first, angles->second});
  }
  const auto named = find_named("camera", camera, camera_names(scene));
  if (named && *named) return CameraChoice(&scene.cameras[**named]);
  if (named) return CameraChoice(direction_of(loaded));
  if (const auto preset = find_preset(camera)) {
    return CameraChoice(preview::Direction{preset->first, preset->second});
  }
  return Error{named.error().message +
               "; front, back, left, right, top, bottom, iso and AZIMUTH,ELEVATION in degrees "
               "work for any asset"};
}

// What a camera of the asset cannot do.
std::optional<Error> find_conflict(const render::Camera& camera, const BakeOptions& options) {
  if (options.turntable > 0) {
    return Error{"a turntable goes around the asset, not through a camera of its own"};
  }
  if (!options.frame.empty()) {
    return Error{"a camera of the asset has a fixed place; use another camera to frame a node"};
  }
  if (camera.perspective && options.projection != BakeProjection::perspective) {
    return Error{"a camera of the asset has its own projection"};
  }
  return std::nullopt;
}

bool stands_inside(const BakeScene& loaded, const BakeOptions& options, bool usual_camera) {
  if (options.interior != BakeInterior::automatic) return options.interior == BakeInterior::on;
  const bool usual = usual_camera && options.turntable == 0 && options.frame.empty() &&
                     options.projection == BakeProjection::perspective;
  return usual && preview::is_closed_room(*loaded.scene, *loaded.subject, *loaded.bvh);
}

// A turntable turns the camera in its place.
std::vector<render::View> views_inside(const BakeScene& loaded, const BakeOptions& options,
                                       const std::optional<preview::Direction>& wanted,
                                       double aspect) {
  preview::Standpoint from =
      preview::find_standpoint(*loaded.scene, *loaded.subject, *loaded.bvh, wanted, aspect);
  std::vector<render::View> views;
  const std::uint32_t count = std::max(options.turntable, 1U);
  for (std::uint32_t i = 0; i < count; ++i) {
    views.push_back(preview::look_around(from, aspect));
    from.direction.azimuth += 360.0 / count;
  }
  return views;
}

}  // namespace

void BakeScene::follow(const preview::Subject& other, const Vec3d& other_origin) {
  subject = other;
  subject->forget_faces();
  subject->least = other.least + other_origin - origin;
  subject->greatest = other.greatest + other_origin - origin;
}

render::View moved(render::View view, const Vec3d& from_origin, const Vec3d& to_origin) {
  view.origin = view.origin + (from_origin - to_origin);
  return view;
}

validate::ValidatedAsset validate_to_bake(model::OpenedAsset asset, const BakeOptions& options) {
  ValidateOptions wanted;
  wanted.root = options.root;
  wanted.jobs = options.jobs;
  wanted.schemas = options.schemas;
  return {std::move(asset), wanted};
}

BakeScene build_bake_scene(const validate::ValidatedAsset& asset, FileReport report,
                           const BakeOptions& options, const std::optional<Vec3d>& origin) {
  BakeScene result = empty_scene(asset.asset().name());
  if (auto refusal = find_refusal(options)) {
    return failed(std::move(result), BakeProblem::refused, *std::move(refusal));
  }
  result.report.validation = errors_of(std::move(report));
  const std::uint64_t errors = result.report.validation.counts.errors;
  if (errors > 0 && (options.strict || forbids_picture(result.report.validation))) {
    return failed(std::move(result), BakeProblem::invalid, "it has errors");
  }
  BakeNotes notes;
  auto made = build(asset, options, origin, notes);
  if (!made) return failed(std::move(result), BakeProblem::refused, made.error().message);
  if (auto trouble = light(made->scene, options)) {
    return failed(std::move(result), BakeProblem::unreadable, std::move(trouble->message));
  }
  give_markers_size(*made, options.sizes.front());
  result.report.notes = std::move(notes);
  result.report.notes.insert(result.report.notes.end(), made->scene.notes.begin(),
                             made->scene.notes.end());
  if (errors > 0) {
    result.report.notes.push_back(
        fmt::format("it has {} error{}, which gltfx validate names; what can be drawn is drawn",
                    errors, errors == 1 ? "" : "s"));
  }
  if (options.strict && !made->complete) {
    return failed(std::move(result), BakeProblem::invalid, "parts of it would be left out");
  }
  result.scene = std::make_unique<const render::Scene>(std::move(made->scene));
  result.subject = std::move(made->subject);
  result.origin = made->origin;
  return result;
}

BakeScene prepare_bake_scene(BakeScene result, const BakeOptions& options) {
  if (!result.scene) return result;
  if (!result.subject) {
    return failed(std::move(result), BakeProblem::nothing_to_see, "nothing in it is visible");
  }
  if (!options.frame.empty() && !result.framed) {
    if (!result.scene->framed.empty()) {
      result.framed = preview::find_subject(*result.scene, preview::Which::framed);
    }
    if (!result.framed) {
      return failed(std::move(result), BakeProblem::nothing_to_see,
                    fmt::format("nothing of node {} and its children is visible in the scene",
                                quoted(options.frame, 60)));
    }
  }
  const bool draft = options.quality == BakeQuality::draft;
  auto bvh =
      render::Bvh::build(*result.scene, draft ? render::BvhMethod::morton : render::BvhMethod::sah);
  // What a machine with more memory draws is not refused.
  if (!bvh) return failed(std::move(result), BakeProblem::unreadable, bvh.error().message);
  result.bvh.emplace(*std::move(bvh));
  return result;
}

BakeScene load_bake_scene(validate::ValidatedAsset asset, const BakeOptions& options) {
  if (auto refusal = find_refusal(options)) {
    return failed(empty_scene(asset.asset().name()), BakeProblem::refused, *std::move(refusal));
  }
  if (!options.clip.empty()) return load_clip(std::move(asset), options);
  BakeScene result;
  {
    // Closed at the end: its bytes are in the scene by then.
    validate::ValidatedAsset closing = std::move(asset);
    FileReport report = closing.take_report();
    result = build_bake_scene(closing, std::move(report), options);
  }
  give_back_memory();
  return prepare_bake_scene(std::move(result), options);
}

BakeScene load_bake_scene_of(const validate::ValidatedAsset& asset, const BakeOptions& options) {
  return prepare_bake_scene(build_bake_scene(asset, asset.report(), options), options);
}

BakeScene load_bake_scene(const std::string& path, const BakeOptions& options) {
  if (auto refusal = find_refusal(options)) {
    return failed(empty_scene(path), BakeProblem::refused, *std::move(refusal));
  }
  auto asset = open_document(path, AssetBounds::of(options));
  if (!asset) return failed(empty_scene(path), BakeProblem::unreadable, asset.error().message);
  codec::Client::shared().prepare_images();  // for textures, and the picture itself
  return load_bake_scene(validate_to_bake(*std::move(asset), options), options);
}

std::optional<Error> find_camera_error(const BakeScene& loaded, const std::string& camera) {
  const auto choice = choose_camera(loaded, camera);
  return choice ? std::nullopt : std::optional(choice.error());
}

Result<std::vector<render::View>> choose_views(const BakeScene& loaded, const BakeOptions& options,
                                               double aspect, const std::string& camera) {
  const preview::Subject& subject = loaded.framed ? *loaded.framed : *loaded.subject;
  const auto choice = choose_camera(loaded, camera);
  if (!choice) return choice.error();
  if (const auto* own = std::get_if<const render::Camera*>(&*choice)) {
    if (auto trouble = find_conflict(**own, options)) return *std::move(trouble);
    render::View view = render::view_of(**own, aspect);
    view.inside = options.interior == BakeInterior::on;
    return std::vector<render::View>{view};
  }
  const auto& side = std::get<preview::Direction>(*choice);
  if (stands_inside(loaded, options, camera.empty())) {
    const auto wanted = camera.empty() ? std::nullopt : std::optional(side);
    return views_inside(loaded, options, wanted, aspect);
  }
  std::vector<render::View> views;
  const std::uint32_t count = std::max(options.turntable, 1U);
  for (std::uint32_t i = 0; i < count; ++i) {
    const preview::Direction turned{side.azimuth + 360.0 * i / count, side.elevation};
    views.push_back(options.projection == BakeProjection::perspective
                        ? preview::frame(subject, turned, aspect)
                        : preview::frame_orthographic(subject, turned, aspect, *loaded.subject));
  }
  return views;
}

}  // namespace gltfx
