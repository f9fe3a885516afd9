// SPDX-License-Identifier: Apache-2.0
#include "pipeline/bake_scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/pages.hpp"
#include "codec/client.hpp"
#include "model/asset.hpp"
#include "model/variants.hpp"
#include "pipeline/bake_names.hpp"
#include "pipeline/environment_file.hpp"
#include "pipeline/scene_builder.hpp"
#include "schema/compile.hpp"
#include "validate/validator.hpp"

namespace gltfx {
namespace {

class Loader {
 public:
  Loader(const std::string& path, const BakeOptions& options)
      : path_(path),
        options_(options),
        schemas_(options.schemas ? options.schemas : schema::builtin_set()) {
    result_.report.path = path;
    result_.report.validation.path = path;
  }

  BakeScene run() {
    if (check() && open() && validate() && build()) prepare();
    return std::move(result_);
  }

  BakeScene run(OpenedAsset asset) {
    asset_ = std::move(asset);
    if (check() && validate() && build()) prepare();
    return std::move(result_);
  }

 private:
  bool fail(BakeProblem problem, std::string error) {
    result_.report.problem = problem;
    result_.report.error = std::move(error);
    return false;
  }

  // What a program would not let through, from callers that are none.
  bool check() {
    constexpr std::uint32_t kMostPixels = 16384;          // along a side
    constexpr std::uint64_t kMostInAll = 8192ULL * 8192;  // of some hundred bytes each
    constexpr double kMostStops = 64;
    const auto is_fine = [](const BakeSize& size) {
      return std::min(size.width, size.height) > 0 &&
             std::max(size.width, size.height) <= kMostPixels &&
             std::uint64_t{size.width} * size.height <= kMostInAll;
    };
    if (options_.sizes.empty() ||
        !std::all_of(options_.sizes.begin(), options_.sizes.end(), is_fine)) {
      return fail(
          BakeProblem::refused,
          fmt::format("each size needs sides from 1 to {} pixels, and {} pixels in all at most",
                      kMostPixels, kMostInAll));
    }
    if (options_.samples == 0 || options_.samples > kMostBakeSamples) {
      return fail(BakeProblem::refused,
                  fmt::format("samples: not from 1 to {} a pixel", kMostBakeSamples));
    }
    if (!(std::fabs(options_.exposure) <= kMostStops)) {
      return fail(BakeProblem::refused,
                  fmt::format("exposure: not from -{0} to {0} stops", kMostStops));
    }
    return true;
  }

  bool open() {
    auto opened = open_asset(path_, options_.root);
    if (!opened) return fail(BakeProblem::unreadable, opened.error().message);
    asset_ = *std::move(opened);
    codec::Client::shared().prepare_images();  // for textures, and the picture itself
    return true;
  }

  bool validate() {
    ValidateOptions options;
    options.root = options_.root;
    options.jobs = options_.jobs;
    options.schemas = schemas_;
    FileReport report = validate::validate(asset_.container, path_, asset_.resolver, options);
    std::erase_if(report.diagnostics,
                  [](const Diagnostic& each) { return each.severity != Severity::error; });
    report.repeats.clear();
    const std::uint64_t errors = report.counts.errors;
    report.counts = Counts{};
    report.counts.errors = errors;
    result_.report.validation = std::move(report);
    if (errors == 0 || options_.force) return true;
    return fail(BakeProblem::invalid, "it is not valid (--force draws it all the same)");
  }

  bool build() {
    const model::Asset asset(asset_.parsed.document);
    SceneOptions wanted;
    wanted.time = options_.time;
    wanted.jobs = options_.jobs;
    const bool found =
        set(wanted.scene,
            find_named("scene", options_.scene, names_in(asset, model::RootArray::scenes))) &&
        set(wanted.animation, find_named("animation", options_.animation,
                                         names_in(asset, model::RootArray::animations))) &&
        set(wanted.variant, find_named("variant", options_.variant, model::variant_names(asset)));
    if (!found) return false;
    auto scene = std::make_unique<bake::Scene>(
        build_scene(asset_.container, asset_.resolver, asset_.parsed.document, *schemas_, wanted));
    if (!options_.environment.empty()) {
      auto environment = read_environment(options_.environment);
      if (!environment) return fail(BakeProblem::unreadable, environment.error().message);
      scene->environment = *std::move(environment);
    }
    // Other lights follow when it is known what they shine on.
    for (bake::SceneMaterial& each : scene->materials) {
      each.factors.emissive *= std::exp2(options_.exposure);
    }
    result_.report.notes = scene->notes;
    result_.scene = std::move(scene);
    asset_ = {};  // its bytes are in the scene by now
    give_back_memory();
    return true;
  }

  bool set(std::optional<std::uint32_t>& wanted, Result<std::optional<std::uint32_t>> found) {
    if (!found) return fail(BakeProblem::refused, found.error().message);
    wanted = *found;
    return true;
  }

  void prepare() {
    auto subject = bake::find_subject(*result_.scene);
    if (!subject) {
      fail(BakeProblem::nothing_to_see, "it has no visible triangles");
      return;
    }
    auto bvh = bake::Bvh::build(*result_.scene);
    if (!bvh) {
      // What a machine with more memory draws is not refused.
      fail(BakeProblem::unreadable, bvh.error().message);
      return;
    }
    result_.bvh.emplace(*std::move(bvh));
    result_.subject = std::move(subject);
  }

  const std::string& path_;
  const BakeOptions& options_;
  const std::shared_ptr<const schema::Set> schemas_;
  OpenedAsset asset_;
  BakeScene result_;
};

std::vector<std::string> camera_names(const bake::Scene& scene) {
  std::vector<std::string> names;
  for (const bake::Camera& camera : scene.cameras) names.push_back(camera.name);
  return names;
}

}  // namespace

BakeScene load_bake_scene(const std::string& path, const BakeOptions& options) {
  return Loader(path, options).run();
}

BakeScene load_bake_scene(const std::string& path, OpenedAsset asset, const BakeOptions& options) {
  return Loader(path, options).run(std::move(asset));
}

Result<std::vector<bake::View>> choose_views(const bake::Scene& scene, const bake::Subject& subject,
                                             const BakeOptions& options, double aspect) {
  bake::Direction direction = bake::usual_direction(subject);
  if (const auto angles = parse_angles(options.camera)) {
    direction = {angles->first, angles->second};
  } else {
    const auto named = find_named("camera", options.camera, camera_names(scene));
    if (!named) {
      return Error{named.error().message + "; AZIMUTH,ELEVATION in degrees goes for any asset"};
    }
    if (*named && options.turntable > 0) {
      return Error{"a turntable goes around the asset, not through a camera of its own"};
    }
    if (*named) return std::vector<bake::View>{bake::view_of(scene.cameras[**named], aspect)};
  }
  std::vector<bake::View> views;
  const std::uint32_t count = std::max(options.turntable, 1U);
  for (std::uint32_t i = 0; i < count; ++i) {
    const bake::Direction turned{direction.azimuth + 360.0 * i / count, direction.elevation};
    views.push_back(bake::frame(subject, turned, aspect));
  }
  return views;
}

}  // namespace gltfx
