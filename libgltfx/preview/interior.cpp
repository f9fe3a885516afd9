// SPDX-License-Identifier: Apache-2.0
#include "preview/interior.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include "base/packed.hpp"
#include "render/surface.hpp"
#include "render/wall.hpp"
#include "shader/directions.hpp"

namespace gltfx::preview {
namespace {

// Rooms, boxes, bottles, houses and vehicles that these numbers distinguish are in
// tests/pipeline/interior_test.cpp.
constexpr double kLeastWidth = 2;     // metres, extent of a room
constexpr double kLeastHeight = 1.8;  // metres
constexpr int kPlaces = 7;            // along each side
constexpr int kRaysAround = 64;       // rays around a place
constexpr int kRaysAcross = 24;       // rays across a picture
constexpr double kWideYfov = 65 * std::numbers::pi / 180;

bool faces(const render::Scene& scene, const render::Hit& hit, const Vec3d& direction) {
  return dot(render::front_normal(scene, hit), direction) < 0;
}

// A place, with the surfaces around it.
struct Place {
  Vec3d point;
  std::vector<render::Hit> hits;
  double nearest = std::numeric_limits<double>::infinity();
  bool indoors = false;
};

Place look_from(const render::Scene& scene, const render::Bvh& bvh, const Vec3d& point,
                double clearance) {
  constexpr double kClosed = 0.8;  // part of all directions: windows and doors may be open
  constexpr double kFronts = 0.85;
  Place place;
  place.point = point;
  int fronts = 0;
  for (int i = 0; i < kRaysAround; ++i) {
    const render::Ray ray{point, shader::even_direction(i, kRaysAround)};
    const auto hit = bvh.intersect(ray, 0, render::Backs::solid);
    if (!hit) continue;
    place.hits.push_back(*hit);
    place.nearest = std::min(place.nearest, hit->distance);
    fronts += faces(scene, *hit, ray.direction) ? 1 : 0;
  }
  const auto found = static_cast<double>(place.hits.size());
  place.indoors =
      found >= kClosed * kRaysAround && fronts >= kFronts * found && place.nearest >= clearance;
  return place;
}

// At eye level in a room, in metres, and lower in larger spaces.
std::vector<Place> places_in(const render::Scene& scene, const Subject& subject,
                             const render::Bvh& bvh) {
  constexpr double kEyeLevel = 1.6;  // metres
  const Vec3d extent = subject.greatest - subject.least;
  const double clearance = 0.04 * std::min({extent.x, extent.y, extent.z});
  const double height = std::min(0.55 * extent.y, std::max(kEyeLevel, 0.35 * extent.y));
  std::vector<Place> places;
  for (int z = 0; z < kPlaces; ++z) {
    for (int x = 0; x < kPlaces; ++x) {
      const Vec3d part((x + 0.5) / kPlaces * extent.x, height, (z + 0.5) / kPlaces * extent.z);
      places.push_back(look_from(scene, bvh, subject.least + part, clearance));
    }
  }
  return places;
}

// Counts of what a camera around a scene sees.
struct Outside {
  int seen = 0;
  int backs = 0;   // of surfaces
  int inside = 0;  // fronts that are visible from the room, too
  int on_box = 0;  // at the sides of the box
  std::set<std::uint64_t> bodies;
  std::set<std::uint32_t> materials;  // at the sides of the box
};

bool is_on_box(const Subject& subject, const Vec3d& point) {
  constexpr double kNear = 0.04;  // of the extent
  const Vec3d extent = subject.greatest - subject.least;
  const auto near = [](double low, double high, double at, double whole) {
    return std::min(std::fabs(at - low), std::fabs(high - at)) <= kNear * whole;
  };
  return near(subject.least.x, subject.greatest.x, point.x, extent.x) ||
         near(subject.least.y, subject.greatest.y, point.y, extent.y) ||
         near(subject.least.z, subject.greatest.z, point.z, extent.z);
}

bool is_seen_from(const std::vector<const Place*>& places, const render::Scene& scene,
                  const render::Bvh& bvh, const render::Hit& hit, const Vec3d& point) {
  const Vec3d normal = render::front_normal(scene, hit);
  return std::any_of(places.begin(), places.end(), [&](const Place* place) {
    const Vec3d way = point - place->point;
    const double distance = length(way);
    if (dot(normal, way) >= 0) return false;
    const auto first = bvh.intersect({place->point, way / distance}, 0, render::Backs::solid);
    return first && first->distance > 0.99 * distance;
  });
}

void look_at(const render::Scene& scene, const Subject& subject, const render::Bvh& bvh,
             const render::View& view, const std::vector<const Place*>& places, Outside& outside) {
  for (int y = 0; y < kRaysAcross; ++y) {
    for (int x = 0; x < kRaysAcross; ++x) {
      const render::Ray ray = view.ray((x + 0.5) / kRaysAcross, (y + 0.5) / kRaysAcross);
      const auto hit = bvh.intersect(ray, 0);
      if (!hit) continue;
      const Vec3d point = ray.origin + ray.direction * hit->distance;
      ++outside.seen;
      const bool front = faces(scene, *hit, ray.direction);
      outside.backs += front ? 0 : 1;
      const bool on_box = is_on_box(subject, point);
      outside.on_box += on_box ? 1 : 0;
      outside.inside += front && is_seen_from(places, scene, bvh, *hit, point) ? 1 : 0;
      outside.bodies.insert(hit->body());
      if (on_box) outside.materials.insert(scene.meshes[hit->mesh].material);
    }
  }
}

std::size_t hidden_bodies(const std::vector<const Place*>& places, const Outside& outside) {
  std::set<std::uint64_t> bodies;
  for (const Place* place : places) {
    for (const render::Hit& hit : place->hits) {
      if (!outside.bodies.contains(hit.body())) bodies.insert(hit.body());
    }
  }
  return bodies.size();
}

// Rows and columns of rays through a picture: many distant objects are better than few near ones.
double worth_of(const render::Bvh& bvh, const render::View& view, double size) {
  constexpr int kWide = 12;
  constexpr int kHigh = 8;
  std::set<std::uint64_t> bodies;
  double sum = 0;  // of reciprocals: objects close to the camera hide much
  for (int y = 0; y < kHigh; ++y) {
    for (int x = 0; x < kWide; ++x) {
      const auto hit = bvh.intersect(view.ray((x + 0.5) / kWide, (y + 0.5) / kHigh), 0);
      sum += 1 / (hit ? std::max(hit->distance, 1e-3 * size) : size);
      if (hit) bodies.insert(hit->body());
    }
  }
  return std::sqrt(1.0 + static_cast<double>(bodies.size())) / sum;
}

}  // namespace

bool is_closed_room(const render::Scene& scene, const Subject& subject, const render::Bvh& bvh) {
  constexpr std::size_t kEnough = 5;  // places
  constexpr double kShown = 0.15;  // part of the picture in which the room is visible from outside
  constexpr double kMostly = 0.6;
  constexpr double kFills = 0.9;
  constexpr std::size_t kMostOutside = 4;  // materials of walls with windows and doors
  constexpr std::size_t kThings = 3;
  const Vec3d extent = subject.greatest - subject.least;
  if (std::min(extent.x, extent.z) < kLeastWidth || extent.y < kLeastHeight) return false;
  const std::vector<Place> places = places_in(scene, subject, bvh);
  std::vector<const Place*> indoors;
  for (const Place& place : places) {
    if (place.indoors) indoors.push_back(&place);
  }
  if (indoors.size() < kEnough) return false;

  Outside outside;
  const Direction usual = usual_direction(subject);
  look_at(scene, subject, bvh, frame(subject, usual, 1), indoors, outside);
  if (outside.seen == 0 || outside.inside > kShown * outside.seen) return false;
  if (outside.backs >= kMostly * outside.seen) return true;
  for (const double turn : {90.0, 180.0, 270.0}) {
    const Direction turned{usual.azimuth + turn, usual.elevation};
    look_at(scene, subject, bvh, frame(subject, turned, 1), indoors, outside);
  }
  const bool plain =
      outside.materials.size() <= kMostOutside && outside.on_box >= kFills * outside.seen;
  return plain && hidden_bodies(indoors, outside) >= kThings;
}

Standpoint find_standpoint(const render::Scene& scene, const Subject& subject,
                           const render::Bvh& bvh, const std::optional<Direction>& direction,
                           double aspect) {
  constexpr int kTurns = 16;
  constexpr double kFromAbove = 8;  // degrees
  std::vector<Place> places = places_in(scene, subject, bvh);
  if (std::any_of(places.begin(), places.end(), [](const Place& each) { return each.indoors; })) {
    std::erase_if(places, [](const Place& each) { return !each.indoors; });
  }
  Standpoint best{subject.middle(), direction.value_or(Direction{})};
  double most = 0;
  for (const Place& place : places) {
    for (int i = 0; i < (direction ? 1 : kTurns); ++i) {
      const Standpoint here{place.point,
                            direction.value_or(Direction{360.0 * i / kTurns, kFromAbove})};
      const double worth = worth_of(bvh, look_around(here, aspect), subject.size());
      if (worth > most) best = here;
      most = std::max(most, worth);
    }
  }
  return best;
}

render::View look_around(const Standpoint& from, double aspect) {
  render::View view = view_from(from.direction);
  view.origin = from.place;
  view.inside = true;
  view.half_height = std::tan(kWideYfov / 2) * (aspect < 1 ? 1 / aspect : 1);
  view.half_width = view.half_height * aspect;
  return view;
}

double shadow_reach(const Subject& subject) {
  constexpr double kPart = 0.3;
  const Vec3d extent = subject.greatest - subject.least;
  return kPart * std::min({extent.x, extent.y, extent.z});
}

}  // namespace gltfx::preview
