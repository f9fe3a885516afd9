// SPDX-License-Identifier: Apache-2.0
#include "preview/framing_surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/packed.hpp"
#include "preview/framing_faces.hpp"

namespace gltfx::preview {
namespace {

// Scenes that these numbers distinguish are in tests/preview/surroundings_test.cpp.
constexpr double kSheetFactor = 4;  // extent of a sheet, in sizes of what is on it
constexpr double kSkyFactor = 8;    // so that the camera is within: 2.1 sizes from the middle
constexpr std::size_t kMostLayers = 4;

// A mesh of an instance.
struct Body {
  FaceBox box;
  std::uint32_t number = 0;
  bool clear = false;
  double level = 0, upward = 0;  // area seen from above and below, and its part from above
};

// The largest first.
std::vector<Body> bodies_of(const Subject& subject) {
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < subject.faces.size(); ++i) {
    const std::uint32_t number = subject.faces[i].body;
    if (bodies.empty() || bodies.back().number != number) bodies.emplace_back().number = number;
    Body& body = bodies.back();
    body.clear = body.clear || subject.faces[i].clear;
    const double above = area_vector(subject, i).y;
    body.level += std::fabs(above);
    body.upward += std::max(above, 0.0);
    for (std::size_t k = 0; k < 3; ++k) body.box.add(to_vec(subject.points[3 * i + k]));
  }
  std::stable_sort(bodies.begin(), bodies.end(),
                   [](const Body& a, const Body& b) { return a.box.size() > b.box.size(); });
  return bodies;
}

// Whether a body is a level sheet below things that rise from it.
bool is_sea(const Body& body, const FaceBox& rest) {
  constexpr double kOneWay = 0.95;  // part of the area that faces up, or down
  const Vec3d extent = body.box.extent();
  const Vec3d things = rest.extent();
  const bool sheet =
      body.upward >= kOneWay * body.level || body.upward <= (1 - kOneWay) * body.level;
  const bool rises = things.y > 3 * extent.y && things.y > 0.3 * std::max(things.x, things.z);
  const double below = body.box.greatest.y - rest.least.y;
  return sheet && rises && below < 0.5 * things.y &&
         std::min(extent.x, extent.z) > kSheetFactor * rest.size();
}

// Whether a body is a sphere, half a sphere or a cube around the others, as seen from there.
bool is_sky(const Subject& subject, const Body& body, const FaceBox& rest) {
  constexpr double kFronts = 0.9;
  const Vec3d extent = body.box.extent();
  const double wide = std::max(extent.x, extent.z);
  const bool round = std::min(extent.x, extent.z) > 0.8 * wide && extent.y > 0.4 * wide;
  if (body.clear || !round || body.box.size() < kSkyFactor * rest.size()) return false;
  const Vec3d middle = (rest.least + rest.greatest) * 0.5;
  double all = 0, seen = 0;
  for (std::size_t i = 0; i < subject.faces.size(); ++i) {
    if (subject.faces[i].body != body.number) continue;
    const Vec3d way = to_vec(subject.points[3 * i]) - middle;
    if (length(way) < 2 * rest.size()) return false;
    const double towards = -dot(area_vector(subject, i), way / length(way));
    all += std::fabs(towards);
    seen += subject.faces[i].culled ? std::max(towards, 0.0) : std::fabs(towards);
  }
  const bool around = body.box.least.x < middle.x && middle.x < body.box.greatest.x &&
                      body.box.least.z < middle.z && middle.z < body.box.greatest.z &&
                      middle.y < body.box.greatest.y;
  return around && seen >= kFronts * all;
}

}  // namespace

void drop_surroundings(Subject& subject) {
  const std::vector<Body> bodies = bodies_of(subject);
  if (bodies.size() < 2) return;
  std::vector<FaceBox> rests(bodies.size());  // of all bodies from one on
  for (std::size_t i = bodies.size(); i-- > 0;) {
    rests[i] = bodies[i].box;
    if (i + 1 < bodies.size()) rests[i].add(rests[i + 1]);
  }
  // The largest ones, down to the last that is far larger than what follows.
  for (std::size_t count = std::min(kMostLayers, bodies.size() - 1); count > 0; --count) {
    const FaceBox& rest = rests[count];
    bool sky = false;
    const bool all = std::all_of(
        bodies.begin(), bodies.begin() + static_cast<std::ptrdiff_t>(count), [&](const Body& body) {
          const bool above = is_sky(subject, body, rest);
          sky = sky || above;
          return above || is_sea(body, rest);
        });
    if (!all) continue;
    subject.enclosed = sky;
    keep_faces(subject, [&](std::size_t i) {
      return std::none_of(bodies.begin(), bodies.begin() + static_cast<std::ptrdiff_t>(count),
                          [&](const Body& body) { return body.number == subject.faces[i].body; });
    });
    return;
  }
}

}  // namespace gltfx::preview
