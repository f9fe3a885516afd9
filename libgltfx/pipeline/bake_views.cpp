// SPDX-License-Identifier: Apache-2.0
#include "pipeline/bake_views.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "pipeline/bake_names.hpp"
#include "pipeline/picture_names.hpp"
#include "preview/framing.hpp"
#include "preview/interior.hpp"
#include "preview/view_choice.hpp"

namespace gltfx {
namespace {

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

render::View moved(render::View view, const Vec3d& from_origin, const Vec3d& to_origin) {
  view.origin = view.origin + (from_origin - to_origin);
  return view;
}

std::vector<NamedCamera> named_cameras(const BakeScene& loaded, const BakeOptions& options,
                                       std::vector<std::string>& notes) {
  std::vector<NamedCamera> cameras;
  const std::vector<std::string> parts = camera_parts(options);
  for (std::size_t i = 0; i < options.cameras.size(); ++i) {
    const std::string& word = options.cameras[i];
    if (options.if_present) {
      const auto choice = choose_camera(loaded, word);
      if (!choice && !loaded.scene->cameras.empty()) notes.push_back(choice.error().message);
      if (!choice) continue;
    }
    cameras.push_back({word, parts[i]});
  }
  if (cameras.empty()) cameras.emplace_back();
  return cameras;
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
