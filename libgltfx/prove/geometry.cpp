// SPDX-License-Identifier: Apache-2.0
#include "prove/geometry.hpp"

#include <limits>
#include <numbers>

#include <fmt/format.h>

namespace gltfx::prove {
namespace {

using model::SemanticKind;

/// Corresponding corners of both primitives. The lists may differ in length.
struct Sequences {
  std::vector<std::uint32_t> ours, theirs;
};

// If only one of them is a strip or fan, both are turned into lists.
Sequences sequences_of(const PrimitivePair& pair) {
  if (pair.ours.mode == pair.theirs.mode) return {pair.ours.indices, pair.theirs.indices};
  return {pair.ours.assembled(), pair.theirs.assembled()};
}

Metric metric_of(const Stream& stream) {
  const bool direction =
      stream.kind == SemanticKind::normal || stream.kind == SemanticKind::tangent;
  if (stream.components() < 3) return Metric::component;
  if (direction && !stream.of_target) return Metric::direction;
  return direction || stream.kind == SemanticKind::position ? Metric::euclidean : Metric::component;
}

double tolerance_of(const Stream& stream, const Tolerance& tolerance) {
  switch (stream.kind) {
    case SemanticKind::position:
      return tolerance.position;
    case SemanticKind::normal:
    case SemanticKind::tangent:  // the length of an added vector limits the angle, in radians
      return stream.of_target ? tolerance.direction * std::numbers::pi / 180 : tolerance.direction;
    case SemanticKind::texcoord:
      return tolerance.texcoord;
    case SemanticKind::color:
      return tolerance.color;
    case SemanticKind::weights:
      return tolerance.weight;
    default:
      return 0;
  }
}

// `apart` takes two vertices. An unreadable vertex of `after` differs from each readable one.
template <class Apart>
Farthest farthest_corner(const PrimitivePair& pair, const Sequences& corners, const Apart& apart) {
  Farthest found;
  for (std::size_t i = 0; i < corners.ours.size(); ++i) {
    const std::uint32_t here = corners.ours[i];
    const std::uint32_t there = corners.theirs[i];
    const bool reads_here = here < pair.ours.vertices;
    const bool reads_there = there < pair.theirs.vertices;
    if (!reads_here && !reads_there) continue;
    const double away =
        reads_here && reads_there ? apart(here, there) : std::numeric_limits<double>::infinity();
    if (away > found.distance) found = {away, i};
  }
  return found;
}

Farthest compare_stream(const PrimitivePair& pair, const Sequences& corners, bool same_corners,
                        const Stream& stream) {
  const Metric metric = metric_of(stream);
  // Comparing all vertices in order is faster, and in most cases there is no difference. Many
  // primitives may share the vertices: then the time would grow with the square of their number.
  constexpr std::uint64_t kMostVerticesOfACorner = 8;
  const bool in_step = same_corners && stream.ours.count() == stream.theirs.count() &&
                       stream.ours.count() / kMostVerticesOfACorner <= corners.ours.size();
  if (in_step && farthest(metric, stream.ours, stream.theirs).distance == 0) return {};
  return farthest_corner(pair, corners, [&](std::uint32_t here, std::uint32_t there) {
    return distance(metric, stream.ours.at(here), stream.theirs.at(there),
                    stream.ours.components());
  });
}

void compare_in_order(const Side& before, const PrimitivePair& pair, const std::string& place,
                      const MeaningRequest& request, bool positions, Differences& found) {
  const Sequences corners = sequences_of(pair);
  if (corners.ours.size() != corners.theirs.size()) {
    return found.add(place, fmt::format("has {} corners in place of {}", corners.theirs.size(),
                                        corners.ours.size()));
  }
  const bool same_corners = corners.ours == corners.theirs;
  for (const Stream& stream : pair.streams) {
    if (!positions && stream.kind == SemanticKind::position) continue;
    const Farthest far = compare_stream(pair, corners, same_corners, stream);
    const std::string pointer = before.pointer(stream.value);
    found.measure(stream.quantity(), far.distance, pointer);
    if (far.distance <= tolerance_of(stream, request.tolerance)) continue;
    found.add(pointer,
              fmt::format("{} of corner {} is {:.6g} away", stream.name, far.at, far.distance),
              far.distance);
  }
}

Element placed(const model::Affine& world, const Element& at, bool of_target) {
  const model::Vector3 local{at[0], at[1], at[2]};
  const model::Vector3 there = of_target ? world.vector(local) : world.point(local);
  return {there[0], there[1], there[2]};
}

}  // namespace

void compare_primitives(const Side& before, const Side& after, json::NodeId ours,
                        json::NodeId theirs, const MeaningRequest& request, bool positions,
                        Differences& found) {
  const auto pair = open_pair(before, after, ours, theirs, found);
  if (!pair) return;
  const std::string place = before.pointer(ours);
  if (pair->ours.arity() != pair->theirs.arity()) {
    return found.add(
        place, fmt::format("has the mode {} in place of {}", model::mode_name(pair->theirs.mode),
                           model::mode_name(pair->ours.mode)));
  }
  if (request.order == VertexOrder::free) return compare_as_sets(*pair, place, found);
  compare_in_order(before, *pair, place, request, positions, found);
}

void compare_placed(const Side& before, const Side& after, const Placed& ours, const Placed& theirs,
                    json::NodeId node, const MeaningRequest& request, Differences& found) {
  Differences told(0);  // already reported by compare_primitives()
  const auto pair = open_pair(before, after, ours.primitive, theirs.primitive, told);
  if (!pair) return;
  const Sequences corners = sequences_of(*pair);
  if (corners.ours.size() != corners.theirs.size()) return;
  const std::string place = before.pointer(node);
  for (const Stream& stream : pair->streams) {
    if (stream.kind != SemanticKind::position || stream.components() != 3) continue;
    const Farthest far =
        farthest_corner(*pair, corners, [&](std::uint32_t here, std::uint32_t there) {
          return distance(Metric::euclidean,
                          placed(ours.world, stream.ours.at(here), stream.of_target),
                          placed(theirs.world, stream.theirs.at(there), stream.of_target), 3);
        });
    found.measure(stream.quantity(), far.distance, place);
    if (far.distance <= request.tolerance.position) continue;
    found.add(place,
              fmt::format("{} of corner {} of {} is {:.6g} away", stream.name, far.at,
                          before.pointer(ours.primitive), far.distance),
              far.distance);
  }
}

}  // namespace gltfx::prove
