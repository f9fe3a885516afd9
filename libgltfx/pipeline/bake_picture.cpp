// SPDX-License-Identifier: Apache-2.0
#include "pipeline/bake_picture.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <new>
#include <optional>
#include <utility>

#include "preview/lighting.hpp"
#include "preview/overlay.hpp"
#include "render/render.hpp"
#include "render/tone_curve.hpp"
#include "render/tonemap.hpp"

namespace gltfx {
namespace {

// What a quality stands for.
struct QualityLevel {
  std::uint32_t samples, bounces;
  std::uint32_t feature_samples;  // RenderOptions::feature_samples
  double deviation;               // RenderOptions::deviation
  render::Effort effort;
};
const QualityLevel& level_of(BakeQuality quality) {
  static constexpr std::array<QualityLevel, 3> kLevels{{
      {4, 6, 16, 0, {1, 1, 1, true}},
      {44, 6, 256, 0.11, {4, 2, 4, false}},
      {256, 12, 1024, 0, {1, 2, 4, false}},
  }};
  return kLevels[static_cast<std::size_t>(quality)];
}

using BackgroundKind = BakeBackground::Kind;

std::optional<preview::Diagram> diagram_of(const BakeOptions& options) {
  switch (options.overlay) {
    case BakeOverlay::none:
    case BakeOverlay::clay:
    case BakeOverlay::wireframe:
      break;
    case BakeOverlay::uv:
      return preview::Diagram::uv;
    case BakeOverlay::density:
      return preview::Diagram::density;
    case BakeOverlay::facing:
      return preview::Diagram::facing;
  }
  return std::nullopt;
}

// Colors of a diagram are those to be shown.
render::ToneCurve curve_of(const BakeOptions& options) {
  if (diagram_of(options)) return render::ToneCurve::none;
  return static_cast<render::ToneCurve>(options.tone_map);
}

std::optional<render::Background> background_of(const BakeOptions& options) {
  switch (options.background.kind) {
    case BackgroundKind::automatic:
      break;
    case BackgroundKind::studio:
      return render::Background::backdrop;
    case BackgroundKind::environment:
      return render::Background::environment;
    case BackgroundKind::color:  // put behind the picture afterwards
    case BackgroundKind::transparent:
      return render::Background::transparent;
  }
  return std::nullopt;
}

// Whether the studio's backdrop is seen.
bool has_backdrop(const render::Scene& scene, const BakeOptions& options) {
  const BackgroundKind kind = options.background.kind;
  return kind == BackgroundKind::studio ||
         (kind == BackgroundKind::automatic && !scene.environment);
}

render::RenderOptions render_options(const BakeSize& size, const BakeOptions& options) {
  render::RenderOptions result;
  result.width = size.width;
  result.height = size.height;
  const QualityLevel& level = level_of(options.quality);
  result.samples = options.samples.value_or(level.samples);
  if (!options.samples) result.deviation = level.deviation;
  result.feature_samples = options.denoise ? level.feature_samples : 0;
  result.seed = options.seed;
  result.jobs = options.jobs;
  result.seconds = options.seconds;
  result.noise = options.noise;
  return result;
}

}  // namespace

BakeReport unreadable(const std::string& path, std::string why) {
  BakeReport report;
  report.path = path;
  report.validation.path = path;
  report.problem = BakeProblem::unreadable;
  report.error = std::move(why);
  return report;
}

BakeReport guarded(const std::string& path, const std::function<BakeReport()>& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return unreadable(path, "there is not enough memory to draw this file");
  } catch (const std::filesystem::filesystem_error&) {
    return unreadable(path, "the path cannot be looked up");
  }
}

bool needs_dim_backdrop(const BakeScene& loaded, const render::View& view,
                        const BakeOptions& options) {
  constexpr double kLeast = 16;
  constexpr std::uint32_t kSide = 48;
  if (!loaded.subject->flat || !has_backdrop(*loaded.scene, options)) return false;
  BakeOptions small = options;
  small.quality = BakeQuality::draft;
  small.samples.reset();
  small.bounces.reset();
  small.seconds = 0;
  small.noise = 0;
  small.denoise = false;
  const double aspect = view.half_width / view.half_height;
  const auto side = [](double part) {
    return std::max(4U, static_cast<std::uint32_t>(kSide * std::min(part, 1.0)));
  };
  const render::Framebuffer drawn =
      draw_picture(loaded, view, {side(aspect), side(1 / aspect)}, small, {.alpha = true}, {});
  return preview::edge_contrast(drawn, curve_of(options)) < kLeast;
}

bool is_transparent(const BakeOptions& options) {
  return options.background.kind == BackgroundKind::transparent;
}

render::Layers layers_of(const BakeOptions& options) {
  const auto wants = [&options](BakeLayer layer) {
    return std::find(options.layers.begin(), options.layers.end(), layer) != options.layers.end();
  };
  const bool alpha =
      background_of(options) == render::Background::transparent || !options.layers.empty();
  return {alpha, wants(BakeLayer::albedo), wants(BakeLayer::normal), wants(BakeLayer::depth),
          wants(BakeLayer::material)};
}

render::Framebuffer draw_picture(const BakeScene& loaded, const render::View& view,
                                 const BakeSize& size, const BakeOptions& options,
                                 const render::Layers& layers,
                                 std::function<void(double)> progress) {
  preview::LightingOptions lighting;
  lighting.lamps = static_cast<preview::Lamps>(options.lights);
  lighting.background = background_of(options);
  lighting.rotation = options.environment_rotation;
  lighting.exposure = options.exposure;
  lighting.dim_backdrop = loaded.dim_backdrop;
  const std::optional<render::Eye> eye = preview::eye_of(view, *loaded.bvh);
  lighting.enclosed = !eye;
  render::World world = preview::make_world(*loaded.scene, *loaded.subject, view, lighting);
  render::PictureOptions drawing{render_options(size, options), layers, options.denoise};
  drawing.render.progress = std::move(progress);
  const QualityLevel& level = level_of(options.quality);
  if (world.environment) world.sky.emplace(*world.environment, drawing.render.samples);
  world.eye = eye;
  const render::TraceContext paths{
      *loaded.scene,
      *loaded.bvh,
      world,
      static_cast<int>(options.bounces.value_or(level.bounces)),
      loaded.subject->size(),
      options.literal_shader ? ShaderMode::spec : ShaderMode::conserving,
      level.effort};
  if (const auto diagram = diagram_of(options)) {
    return preview::draw_diagram(paths, view, *diagram, drawing);
  }
  render::Framebuffer picture = render::render(paths, view, drawing);
  if (options.overlay == BakeOverlay::wireframe) {
    preview::draw_wireframe(paths, view, options.jobs, picture);
  }
  return picture;
}

preview::Picture finish_picture(const render::Framebuffer& drawn, const BakeOptions& options,
                                preview::PixelType type) {
  preview::Finish finish;
  finish.curve = curve_of(options);
  if (options.background.kind == BackgroundKind::color) {
    Float3& color = finish.color.emplace();
    for (std::size_t c = 0; c < 3; ++c) {
      color[c] = render::srgb_decode_byte(options.background.color[c]);
    }
  }
  return preview::tone_mapped_picture(drawn, is_transparent(options), type, finish);
}

}  // namespace gltfx
