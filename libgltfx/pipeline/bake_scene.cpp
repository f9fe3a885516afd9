// SPDX-License-Identifier: Apache-2.0
#include "pipeline/bake_scene.hpp"

#include <gltfx/validate.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/pages.hpp"
#include "base/text.hpp"
#include "codec/client.hpp"
#include "model/asset.hpp"
#include "model/external_places.hpp"
#include "model/variants.hpp"
#include "pipeline/bake_clip.hpp"
#include "pipeline/bake_names.hpp"
#include "pipeline/bake_refusal.hpp"
#include "pipeline/environment_file.hpp"
#include "pipeline/open_asset.hpp"
#include "pipeline/scene_builder.hpp"
#include "pipeline/scene_pose.hpp"
#include "pipeline/scene_tree.hpp"
#include "preview/markers.hpp"
#include "preview/overlay.hpp"
#include "rules/shows/shows.hpp"
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

// What validation says of a scene that shows nothing, as a half sentence; or empty.
std::string find_unseen(const FileReport& report) {
  constexpr std::string_view kBegin = validate::kNothingIsVisible;
  for (const Diagnostic& each : report.diagnostics) {
    if (each.code == "NOTHING_VISIBLE" && each.message.starts_with(kBegin)) {
      return std::string(without_stop(std::string_view(each.message).substr(kBegin.size())));
    }
  }
  return {};
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

// Whether an asset below this one has an animation of that name.
bool is_animation_below(const model::OpenedAsset& opened, const std::string& name) {
  bool found = false;
  model::for_each_external_asset(opened, [&](const model::OpenedAsset& asset) {
    const auto names = names_in(model::Asset(asset.document()), model::RootArray::animations);
    found = found || std::find(names.begin(), names.end(), name) != names.end();
  });
  return found;
}

std::optional<Error> choose_animation(const model::OpenedAsset& opened, const BakeOptions& options,
                                      BakeNotes& notes, SceneOptions& wanted) {
  const model::Asset asset(opened.document());
  const auto names = names_in(asset, model::RootArray::animations);
  const bool named = std::find(names.begin(), names.end(), options.animation) != names.end();
  if (!named && !options.animation.empty() && is_animation_below(opened, options.animation)) {
    wanted.external.pose = false;
    wanted.external.animation = options.animation;
    return std::nullopt;
  }
  if (options.animation == "none" && !named) return std::nullopt;
  const auto found = find_part("animation", options.animation, names, {options.if_present, notes});
  if (!found) return found.error();
  wanted.external.pose = !*found;
  if (*found) wanted.external.animation = names[**found];
  wanted.animation = *found ? *found : find_pose(asset, opened.views());
  return std::nullopt;
}

std::optional<Error> choose_variant(const model::OpenedAsset& opened, const BakeOptions& options,
                                    BakeNotes& notes, SceneOptions& wanted) {
  auto names = model::variant_names(model::Asset(opened.document()));
  const std::size_t own = names.size();
  if (!options.variant.empty()) {
    for (std::string& name : variant_names_below(opened)) {
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(std::move(name));
      }
    }
  }
  const auto found = find_part("variant", options.variant, names, {options.if_present, notes});
  if (!found) return found.error();
  if (!*found) return std::nullopt;
  if (**found < own) wanted.variant = *found;
  wanted.external.variant = names[**found];
  return std::nullopt;
}

bool is_clay(const BakeOptions& options) {
  return options.overlay == BakeOverlay::clay || options.overlay == BakeOverlay::wireframe;
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
  auto problem = choose_animation(opened, options, notes, wanted);
  if (!problem) problem = choose_variant(opened, options, notes, wanted);
  if (problem) return *std::move(problem);
  const auto frame = find_node(options.frame, names_in(asset, model::RootArray::nodes));
  if (!frame) return frame.error();
  wanted.frame = *frame;
  wanted.scene = *scene;
  return wanted;
}

Result<BuiltScene> build(const validate::ValidatedAsset& asset, const BakeOptions& options,
                         const std::optional<Vec3d>& origin, double shown_size, bool outline,
                         BakeNotes& notes) {
  auto wanted = scene_options(asset.asset(), options, notes);
  if (!wanted) return wanted.error();
  wanted->origin = origin;
  wanted->shown_size = shown_size;
  wanted->textures = !outline && !is_clay(options);
  // Another one takes its place.
  wanted->environment =
      !outline && options.environment.empty() && options.lights != BakeLights::studio;
  const auto schemas = options.schemas ? options.schemas : schema::builtin_set();
  return build_scene(asset, *schemas, *wanted);
}

std::optional<Error> light(render::Scene& scene, const BakeOptions& options) {
  if (!options.environment.empty()) {
    auto environment = read_environment(options.environment);
    if (!environment) return environment.error();
    scene.environment = *std::move(environment);
  }
  if (is_clay(options)) preview::make_clay(scene);
  // Other lights follow when it is known what they shine on.
  for (render::SceneMaterial& each : scene.materials) {
    each.factors.emissive *= std::exp2(options.exposure);
  }
  return std::nullopt;
}

// Points and lines are to be seen in a picture of all that is there.
void give_markers_size(BuiltScene& built, const BakeSize& size) {
  render::Scene& scene = built.scene;
  if (!preview::has_markers(scene)) return;
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

}  // namespace

BakeScene failed_scene(const std::string& path, BakeProblem problem, std::string error) {
  return failed(empty_scene(path), problem, std::move(error));
}

void BakeScene::follow(const preview::Subject& other, const Vec3d& other_origin) {
  subject = other;
  subject->forget_faces();
  subject->least = other.least + other_origin - origin;
  subject->greatest = other.greatest + other_origin - origin;
}

validate::ValidatedAsset validate_to_bake(model::OpenedAsset asset, const BakeOptions& options) {
  ValidateOptions wanted;
  wanted.root = options.root;
  wanted.jobs = options.jobs;
  wanted.schemas = options.schemas;
  return {std::move(asset), wanted};
}

BakeScene begin_bake_scene(const validate::ValidatedAsset& asset, FileReport report,
                           const BakeOptions& options) {
  BakeScene result = empty_scene(asset.asset().name());
  if (options.scene.empty()) result.unseen = find_unseen(report);
  result.report.validation = errors_of(std::move(report));
  const std::uint64_t errors = result.report.validation.counts.errors;
  if (errors > 0 && (options.strict || forbids_picture(result.report.validation))) {
    return failed(std::move(result), BakeProblem::invalid, "it has errors");
  }
  return result;
}

Result<BuiltScene> build_outline(const validate::ValidatedAsset& asset, const BakeOptions& options,
                                 const std::optional<Vec3d>& origin) {
  BakeNotes notes;  // are those of the scene itself
  return build(asset, options, origin, 0, true, notes);
}

BakeScene build_bake_scene(const validate::ValidatedAsset& asset, FileReport report,
                           const BakeOptions& options, const ClipStage* stage) {
  BakeScene result = begin_bake_scene(asset, std::move(report), options);
  if (result.report.problem != BakeProblem::none) return result;
  BakeNotes notes;
  auto made = stage ? build(asset, options, stage->origin, stage->size, false, notes)
                    : build(asset, options, std::nullopt, 0, false, notes);
  if (!made) return failed(std::move(result), BakeProblem::refused, made.error().message);
  if (auto trouble = light(made->scene, options)) {
    return failed(std::move(result), BakeProblem::unreadable, std::move(trouble->message));
  }
  if (stage != nullptr) {
    preview::give_markers_size(made->scene, stage->marker_radius);
  } else {
    give_markers_size(*made, options.sizes.front());
  }
  result.report.notes = std::move(notes);
  result.report.notes.insert(result.report.notes.end(), made->scene.notes.begin(),
                             made->scene.notes.end());
  if (const std::uint64_t errors = result.report.validation.counts.errors; errors > 0) {
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
  // Overlays show surfaces that are transparent, and another variant may have another alpha.
  const bool plain = options.overlay == BakeOverlay::none && options.variant.empty();
  if (!result.subject || (plain && !result.unseen.empty())) {
    std::string error = "nothing in it is visible";
    if (!result.unseen.empty()) error += ": " + result.unseen;
    return failed(std::move(result), BakeProblem::nothing_to_see, std::move(error));
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

namespace {

BakeScene load_checked(validate::ValidatedAsset asset, const BakeOptions& options) {
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

}  // namespace

BakeScene load_bake_scene(validate::ValidatedAsset asset, const BakeOptions& options) {
  if (auto refusal = find_refusal(options)) {
    return failed_scene(asset.asset().name(), BakeProblem::refused, *std::move(refusal));
  }
  return load_checked(std::move(asset), options);
}

BakeScene load_bake_scene_of(const validate::ValidatedAsset& asset, const BakeOptions& options) {
  if (auto refusal = find_refusal(options)) {
    return failed_scene(asset.asset().name(), BakeProblem::refused, *std::move(refusal));
  }
  return prepare_bake_scene(build_bake_scene(asset, asset.report(), options), options);
}

BakeScene load_bake_scene(const std::string& path, const BakeOptions& options) {
  if (auto refusal = find_refusal(options)) {
    return failed_scene(path, BakeProblem::refused, *std::move(refusal));
  }
  auto asset = open_document(path, AssetBounds::of(options));
  if (!asset) return failed_scene(path, BakeProblem::unreadable, asset.error().message);
  codec::Client::shared().prepare_images();  // for textures, and the picture itself
  return load_checked(validate_to_bake(*std::move(asset), options), options);
}

}  // namespace gltfx
