// SPDX-License-Identifier: Apache-2.0
#include "pipeline/compare_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <new>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/json_pointer.hpp"
#include "base/parallel.hpp"
#include "codec/client.hpp"
#include "pipeline/bake_picture.hpp"
#include "pipeline/bake_scene.hpp"
#include "pipeline/bake_views.hpp"
#include "preview/interior.hpp"
#include "prove/picture.hpp"
#include "render/light.hpp"

namespace gltfx {
namespace {

constexpr std::size_t kMostRegions = 2000;
constexpr double kWholePart = 0.7;    // of the scene, from which a change needs no view of its own
constexpr double kLeastPart = 0.02;   // of the scene, which a view of a change shows at least
constexpr double kMarginPart = 0.15;  // around a changed object, of its size

BakeOptions drawing_options(const CompareOptions& compare) {
  BakeOptions options;
  options.sizes = {{compare.picture_size, compare.picture_size}};
  options.quality = BakeQuality::draft;
  options.animation = "none";
  options.root = compare.root;
  options.searched = compare.searched;
  options.schemas = compare.schemas;
  options.jobs = compare.jobs;
  return options;
}

// The index of the animation that a change is in.
std::string animation_of(const std::optional<std::string>& pointer) {
  const auto steps = pointer ? split_pointer(*pointer) : std::nullopt;
  return steps && steps->size() > 1 && steps->front() == "animations" ? (*steps)[1] : "none";
}

// Both assets at the moment at which a clip differs most.
void pose_at_change(const CompareReport& report, BakeOptions& ours, BakeOptions& theirs) {
  const Change* greatest = prove::change_of_moment(report);
  if (greatest == nullptr) return;
  ours.animation = animation_of(greatest->old_pointer);
  theirs.animation = animation_of(greatest->new_pointer);
  ours.time = theirs.time = *greatest->time;
}

preview::Subject joined(const preview::Subject& a, const preview::Subject& b, const Vec3d& shift) {
  preview::Subject both = a;
  both.points.reserve(a.points.size() + b.points.size());
  for (const Float3& point : b.points) both.points.push_back(to_float3(to_vec(point) + shift));
  both.faces.insert(both.faces.end(), b.faces.begin(), b.faces.end());
  both.flat = a.flat && b.flat;
  for (const auto axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
    both.least.*axis = std::min(a.least.*axis, b.least.*axis + shift.*axis);
    both.greatest.*axis = std::max(a.greatest.*axis, b.greatest.*axis + shift.*axis);
  }
  return both;
}

model::Box joined(const prove::ChangedBoxes& boxes) {
  model::Box both = boxes.ours;
  if (!boxes.theirs.empty()) {
    both.add(boxes.theirs.least);
    both.add(boxes.theirs.greatest);
  }
  return both;
}

Vec3d corner_of(const model::Box& box, unsigned i) {
  const auto at = [&](unsigned axis) {
    return (i >> axis & 1U) != 0 ? box.greatest[axis] : box.least[axis];
  };
  return {at(0), at(1), at(2)};
}

// What is to be framed of a box: all of it, and a little around it.
preview::Subject subject_of(const model::Box& box, const Vec3d& origin, double least_size) {
  const double margin = std::max(box.diagonal() * kMarginPart, least_size / 2);
  preview::Subject subject;
  model::Box grown = box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grown.least[axis] -= margin;
    grown.greatest[axis] += margin;
  }
  for (unsigned i = 0; i < 8; ++i) {
    subject.points.push_back(to_float3(corner_of(grown, i) - origin));
  }
  subject.least = corner_of(grown, 0) - origin;
  subject.greatest = corner_of(grown, 7) - origin;
  return subject;
}

// Nothing: it is outside of the picture, or partly behind the camera.
std::optional<PictureRegion> region_of(const model::Box& box, const render::View& view,
                                       const Vec3d& origin) {
  if (box.empty()) return std::nullopt;
  PictureRegion region;
  region.left = region.top = 1;
  region.right = region.bottom = 0;
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3d at = corner_of(box, i) - origin - view.origin;
    const double depth = -dot(at, view.backward);
    if (view.perspective && !(depth > 0)) return std::nullopt;
    const double scale = view.perspective ? depth : 1;
    const double x = 0.5 + dot(at, view.right) / scale / view.half_width / 2;
    const double y = 0.5 - dot(at, view.up) / scale / view.half_height / 2;
    region.left = std::min(region.left, x);
    region.right = std::max(region.right, x);
    region.top = std::min(region.top, y);
    region.bottom = std::max(region.bottom, y);
  }
  for (double* each : {&region.left, &region.top, &region.right, &region.bottom}) {
    *each = std::clamp(*each, 0.0, 1.0);
  }
  if (!(region.left < region.right && region.top < region.bottom)) return std::nullopt;
  return region;
}

// Whether the order of lights, triangles and meshes decides which of them a random number chooses.
bool order_matters(const render::Scene& scene) {
  const auto random = [](const render::SceneMaterial& material) {
    return render::is_emissive(material) || material.alpha_mode != render::AlphaMode::opaque;
  };
  return scene.lights.size() > 1 ||
         std::any_of(scene.materials.begin(), scene.materials.end(), random);
}

/// Two scenes, or one, in front of one camera.
class ComparedScenes {
 public:
  ComparedScenes(const std::vector<prove::ChangedBoxes>& boxes, const CompareOptions& options,
                 CompareReport& report)
      : boxes_(boxes), options_(drawing_options(options)), report_(report) {}

  void draw(std::optional<model::OpenedAsset> before, std::optional<model::OpenedAsset> after) {
    load(std::move(before), std::move(after));
    if (!ours_ && !theirs_) return;
    BakeScene& first = ours_ ? *ours_ : *theirs_;
    const bool both = ours_ && theirs_;
    BakeOptions sides = options_;
    sides.turntable = both ? 2 : 0;
    const bool inside = preview::is_closed_room(*first.scene, *first.subject, *first.bvh);
    sides.interior = inside ? BakeInterior::on : BakeInterior::off;
    if (both) {
      first.subject = joined(*first.subject, *theirs_->subject, theirs_->origin - first.origin);
    }
    const auto views = choose_views(first, sides, 1);
    if (!views) return add_problem(views.error().message);
    first.dim_backdrop = needs_dim_backdrop(first, views->front(), options_);
    const double size = first.subject->size();
    first.forget_faces();
    if (both) {
      theirs_->follow(*first.subject, first.origin);
      theirs_->dim_backdrop = first.dim_backdrop;
    }
    add("usual", views->front());
    if (!both) return;
    add("opposite", views->back());
    if (!inside) add_change(*views, size);
  }

 private:
  void load(std::optional<model::OpenedAsset> before, std::optional<model::OpenedAsset> after) {
    codec::Client::shared().prepare_images();
    BakeOptions one = options_;
    BakeOptions other = options_;
    pose_at_change(report_, one, other);
    const auto open = [](std::optional<model::OpenedAsset>& asset, const BakeOptions& options,
                         std::optional<BakeScene>& scene) {
      if (asset) scene = load_bake_scene(validate_to_bake(*std::move(asset), options), options);
    };
    run_both(
        options_.jobs, [&] { open(before, one, ours_); }, [&] { open(after, other, theirs_); });
    check("old", ours_);
    check("new", theirs_);
  }

  void check(std::string_view which, std::optional<BakeScene>& scene) {
    if (!scene || scene->ready()) return;
    add_problem(fmt::format("the {} asset cannot be drawn: {}", which, scene->report.error));
    scene.reset();
  }

  void add_problem(const std::string& text) {
    if (!report_.picture_problem.empty()) report_.picture_problem += "; ";
    report_.picture_problem += text;
  }

  const Vec3d& origin() const { return ours_ ? ours_->origin : theirs_->origin; }

  preview::Picture drawn(const BakeScene& scene, const render::View& view, std::uint32_t seed) {
    BakeOptions options = options_;
    options.seed = seed;
    const render::View here = moved(view, origin(), scene.origin);
    return finish_picture(draw_picture(scene, here, options.sizes.front(), options, {}, {}),
                          options, preview::PixelType::bytes);
  }

  static BakedPixels pixels_of(preview::Picture picture) {
    return {picture.width, picture.height, picture.channels, std::move(picture.bytes)};
  }

  void add(std::string_view name, const render::View& view) {
    ComparePicture& picture = report_.pictures.emplace_back();
    picture.view = name;
    std::optional<preview::Picture> before, after;
    if (ours_) before = drawn(*ours_, view, 0);
    if (theirs_) after = drawn(*theirs_, view, 0);
    if (before && after) {
      prove::SquareDifference found = prove::greatest_difference(*before, *after);
      if (found.visible() && (order_matters(*ours_->scene) || order_matters(*theirs_->scene))) {
        found = prove::greatest_difference(*before, *after, drawn(*ours_, view, 1));
      }
      picture.distance = found.distance;
      picture.limit = found.limit;
      picture.difference = pixels_of(prove::marked_difference(*before, *after));
    }
    if (before) picture.old_pixels = pixels_of(*std::move(before));
    if (after) picture.new_pixels = pixels_of(*std::move(after));
    add_regions(view, picture);
  }

  void add_regions(const render::View& view, ComparePicture& picture) const {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      for (const bool is_old : {true, false}) {
        auto region = region_of(is_old ? boxes_[i].ours : boxes_[i].theirs, view, origin());
        if (!region || picture.regions.size() >= kMostRegions) continue;
        region->change = i;
        region->is_old = is_old;
        picture.regions.push_back(*region);
      }
    }
  }

  // From the side on which more has changed.
  void add_change(const std::vector<render::View>& views, double whole) {
    std::optional<std::size_t> greatest;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (joined(boxes_[i]).empty()) continue;
      if (!greatest || prove::is_greater(report_.changes[i], report_.changes[*greatest]))
        greatest = i;
    }
    if (!greatest) return;
    const model::Box box = joined(boxes_[*greatest]);
    if (!(box.diagonal() < kWholePart * whole)) return;
    const bool behind = report_.pictures[1].distance > report_.pictures[0].distance;
    const Vec3d& back = views[behind ? 1 : 0].backward;
    constexpr double kDegrees = 180 / std::numbers::pi;
    const preview::Direction side{std::atan2(back.x, back.z) * kDegrees,
                                  std::asin(std::clamp(back.y, -1.0, 1.0)) * kDegrees};
    const preview::Subject subject = subject_of(box, origin(), kLeastPart * whole);
    add("change", preview::frame(subject, side, 1));
    report_.pictures.back().change = greatest;
  }

  const std::vector<prove::ChangedBoxes>& boxes_;
  const BakeOptions options_;
  CompareReport& report_;
  std::optional<BakeScene> ours_, theirs_;
};

}  // namespace

void draw_compared(std::optional<model::OpenedAsset> before,
                   std::optional<model::OpenedAsset> after,
                   const std::vector<prove::ChangedBoxes>& boxes, const CompareOptions& options,
                   CompareReport& report) {
  try {
    ComparedScenes(boxes, options, report).draw(std::move(before), std::move(after));
  } catch (const std::bad_alloc&) {
    report.pictures.clear();
    report.picture_problem = "there is not enough memory to draw the assets";
  } catch (const std::filesystem::filesystem_error&) {
    report.pictures.clear();
    report.picture_problem = "a path cannot be looked up";
  }
}

}  // namespace gltfx
