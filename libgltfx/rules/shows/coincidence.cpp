// SPDX-License-Identifier: Apache-2.0
// Surfaces in one place: the same triangles twice, and flat surfaces in one plane.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/fields.hpp"
#include "model/info.hpp"
#include "model/material.hpp"
#include "rules/collector.hpp"
#include "rules/finding.hpp"
#include "rules/shows/shows.hpp"
#include "rules/shows/triangle_places.hpp"

namespace gltfx::validate {
namespace {

using model::Affine;
using model::Primitive;
using model::RootArray;
using model::Vector3;

bool is_near(const BoundsBox& a, const BoundsBox& b) {
  const double slack = 1e-4 * a.width() + 1e-6 * a.reach();  // for rounding
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(std::abs(a.least[k] - b.least[k]) <= slack)) return false;
    if (!(std::abs(a.most[k] - b.most[k]) <= slack)) return false;
  }
  return true;
}

bool is_near(const Affine& a, const Affine& b) {
  double size = 0, difference = 0;
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t k = 0; k < 3; ++k) {
      size = std::max(size, std::abs(a.columns[column][k]));
      difference = std::max(difference, std::abs(a.columns[column][k] - b.columns[column][k]));
    }
  }
  return difference <= 1e-6 * size;
}

class Coincidences {
 public:
  Coincidences(DataPhase& phase, PlacedScene& scene)
      : phase_(phase),
        context_(phase.context),
        scene_(scene),
        opaque_(context_.asset.count(RootArray::materials), Answer::unknown) {
    for (const Placed& each : scene_.parts()) {
      if (!is_solid(each)) continue;
      all_.include(each.box);
      solid_.push_back(&each);
    }
  }

  void run() {
    if (!(all_.width() > 0)) return;
    if (solid_.size() > 1) find_doubles();
    if (is_enabled(context_.options, Code::PLANES_OVERLAP)) find_overlaps();
    if (doubles_ == 0) find_repeats();
  }

 private:
  using Pair = std::pair<const Placed*, const Placed*>;
  enum class Answer : std::uint8_t { unknown, yes, no };

  const Primitive& primitive_of(const Placed& placed) const {
    return context_.views.meshes[placed.mesh].primitives[placed.primitive];
  }

  bool is_solid(const Placed& placed) {
    const Primitive& primitive = primitive_of(placed);
    if (!primitive.mode || !model::draws_triangles(*primitive.mode)) return false;
    if (!primitive.targets.empty() || scene_.moves(placed.node)) return false;
    if (!primitive.material) return true;
    Answer& known = opaque_[*primitive.material];
    if (known == Answer::unknown) {
      const std::string mode = model::string_member(
          context_.document, context_.asset.elements(RootArray::materials)[*primitive.material],
          "alphaMode");
      known = mode.empty() || mode == "OPAQUE" ? Answer::yes : Answer::no;
    }
    return known == Answer::yes;
  }

  bool transmits(const Placed& placed) const {
    const Primitive& primitive = primitive_of(placed);
    if (!primitive.material) return false;
    const model::Material material = model::read_material(context_.asset, *primitive.material);
    return material.of(MaterialParameter::transmission)[0] > 0;
  }

  template <typename Item>
  using Keyed = std::vector<std::pair<std::uint64_t, Item>>;

  // Items by a key, each compared with the few before it that have the same one.
  template <typename Item, typename Compare>
  static void for_neighbours(const Keyed<Item>& keyed, Compare compare) {
    constexpr std::size_t kMostBefore = 8;
    constexpr std::uint32_t kNone = UINT32_MAX;
    std::size_t buckets = 2;
    while (buckets < 2 * keyed.size()) buckets *= 2;
    std::vector<std::uint32_t> last(buckets, kNone);  // by the end of the key
    std::vector<std::uint32_t> before(keyed.size(), kNone);
    for (std::uint32_t i = 0; i < keyed.size(); ++i) {
      const auto [key, item] = keyed[i];
      std::uint32_t& bucket = last[key & (buckets - 1)];
      before[i] = std::exchange(bucket, i);
      std::uint32_t other = before[i];
      for (std::size_t step = 0; step < kMostBefore && other != kNone; ++step) {
        if (keyed[other].first == key && compare(keyed[other].second, item)) break;
        other = before[other];
      }
    }
  }

  // --- The same triangles in two primitives ---

  // By two grids: what is at the border of a cell in one of them is not in the other.
  void find_doubles() {
    Pair first{};
    double first_share = 0;
    std::vector<std::uint8_t> doubled(solid_.size(), 0);
    for (const double shift : {0.0, 0.5}) {
      for_neighbours(keyed_by_box(shift), [&](std::size_t before, std::size_t after) {
        if (doubled[after] != 0 || doubles_ == kMostDoubles) return true;
        const Placed &one = *solid_[before], &other = *solid_[after];
        if (!is_near(one.box, other.box) || transmits(one) || transmits(other)) return false;
        const double share = shared_by(one, other);
        if (share < kLeastShare) return false;
        ++doubles_;
        doubled[after] = 1;
        if (first.first == nullptr || other.node < first.second->node) {
          first = {&one, &other};
          first_share = share;
        }
        return true;
      });
    }
    if (doubles_ > 0) report_double(*first.first, *first.second, first_share);
  }

  Keyed<std::size_t> keyed_by_box(double shift) const {
    const double cell = 1e-3 * all_.width();
    Keyed<std::size_t> keyed;
    for (std::size_t i = 0; i < solid_.size(); ++i) {
      const BoundsBox& box = solid_[i]->box;
      std::uint64_t key = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double from = all_.least[k] - shift * cell;
        key = joined_place(joined_place(key, place_cell(box.least[k] - from, cell)),
                           place_cell(box.most[k] - from, cell));
      }
      keyed.emplace_back(key, i);
    }
    return keyed;
  }

  static constexpr double kLeastShare = 0.5;
  static constexpr std::uint64_t kMostDoubles = 64;  // more are not counted

  // Of the triangles of the one with fewer, those that are also in the other.
  double shared_by(const Placed& one, const Placed& other) {
    const Primitive& a = primitive_of(one);
    const Primitive& b = primitive_of(other);
    const auto place = [](const Primitive& primitive) {
      return primitive.find(model::SemanticKind::position)->accessor;
    };
    const bool same = place(a) == place(b) && a.indices == b.indices && a.mode == b.mode;
    if (same && is_near(scene_.pose().world[one.node], scene_.pose().world[other.node])) return 1;
    const auto cell = cell_for(one, other);
    if (!cell) return 0;
    const auto ours = triangles_in(one, one.box, *cell);
    const auto theirs = triangles_in(other, one.box, *cell);
    if (ours.empty() || theirs.empty()) return 0;
    std::vector<std::uint64_t> both;
    std::set_intersection(ours.begin(), ours.end(), theirs.begin(), theirs.end(),
                          std::back_inserter(both));
    return static_cast<double>(both.size()) /
           static_cast<double>(std::min(ours.size(), theirs.size()));
  }

  // The distance from 0 at which numbers were rounded: in the file, and in the scene.
  double rounded_at(const Placed& placed) {
    const Affine& world = scene_.pose().world[placed.node];
    double scale = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      scale = std::max(scale, std::sqrt(model::dot(world.columns[k], world.columns[k])));
    }
    return std::max(placed.box.reach(),
                    scale * phase_.box_of_primitive(primitive_of(placed)).reach());
  }

  // The side of cells in which places are the same; nothing: positions are too coarse for that.
  std::optional<double> cell_for(const Placed& one, const Placed& other) {
    constexpr double kFine = 1e-5, kCoarse = 5e-3;  // of the width
    constexpr double kRounding = 6e-6;              // of the distance from 0
    const double width = one.box.width();
    const double cell =
        std::max(kFine * width, kRounding * std::max(rounded_at(one), rounded_at(other)));
    return cell > 0 && cell <= kCoarse * width ? std::optional(cell) : std::nullopt;
  }

  std::vector<std::uint64_t> triangles_in(const Placed& placed, const BoundsBox& box, double cell) {
    const auto triangles = TriangleReader::open(phase_, primitive_of(placed));
    if (!triangles || !phase_.budget.take(triangles->count(), 12)) return {};
    return places_of_triangles(*triangles, scene_.pose().world[placed.node], box.least, cell);
  }

  void report_double(const Placed& one, const Placed& other, double share) {
    std::string message;
    if (one.node == other.node) {
      message = fmt::format("Primitives {} and {} of {} have", one.primitive, other.primitive,
                            object_label(context_, RootArray::meshes, one.mesh));
    } else {
      message = fmt::format("{} and {} draw", object_label(context_, RootArray::nodes, one.node),
                            object_label(context_, RootArray::nodes, other.node));
    }
    message += share < 1 ? fmt::format(" {:.0f} % of the triangles of the smaller one", 100 * share)
                         : std::string(" the same triangles");
    message += " in the same place: one hides the other, or they flicker";
    if (doubles_ > 1) {
      message +=
          fmt::format("; {}{} other {} the same", doubles_ == kMostDoubles ? "at least " : "",
                      doubles_ - 1, doubles_ == 2 ? "pair does" : "pairs do");
    }
    const bool of_mesh = one.node == other.node;
    const std::string pointer =
        of_mesh ? fmt::format("/meshes/{}/primitives/{}", other.mesh, other.primitive)
                : fmt::format("/nodes/{}", other.node);
    report_at(
        phase_.sink, pointer,
        finding_on(context_,
                   of_mesh ? primitive_of(other).node : context_.views.nodes[other.node].object,
                   Code::TRIANGLES_COINCIDE, message + "."));
  }

  // --- The same triangles in one primitive ---

  void find_repeats() {
    constexpr std::uint64_t kMostTriangles = 2048;
    constexpr std::uint64_t kLeastRepeats = 2, kShare = 4;  // a quarter
    std::uint64_t left = 4 * kMostTriangles;
    std::vector<std::uint8_t> seen(context_.views.meshes.size(), 0);
    for (std::size_t i = 0; i < solid_.size(); ++i) {
      const Placed& part = *solid_[i];
      // The primitives of a mesh follow each other.
      const bool again = i > 0 && solid_[i - 1]->node == part.node;
      if (!again && std::exchange(seen[part.mesh], 1) != 0) continue;
      const std::uint64_t count =
          model::primitive_size(context_.views, primitive_of(part)).triangles;
      if (count > kMostTriangles) continue;
      if (count > left) return;
      left -= count;
      const auto cell = cell_for(part, part);
      if (!cell) continue;
      const auto found = triangles_in(part, part.box, *cell);
      std::uint64_t repeats = 0;
      for (std::size_t k = 1; k < found.size(); ++k) repeats += found[k] == found[k - 1] ? 1U : 0U;
      if (repeats < kLeastRepeats || repeats * kShare < found.size()) continue;
      Finding finding =
          finding_on(context_, primitive_of(part).node, Code::TRIANGLES_COINCIDE,
                     fmt::format("{} of the {} triangles of primitive {} of {} repeat another one.",
                                 repeats, found.size(), part.primitive,
                                 object_label(context_, RootArray::meshes, part.mesh)));
      finding.severity = Severity::info;
      return report_at(phase_.sink,
                       fmt::format("/meshes/{}/primitives/{}", part.mesh, part.primitive),
                       std::move(finding));
    }
  }

  // --- Flat surfaces ---

  struct Flat {
    const Placed* part = nullptr;
    std::size_t axis = 0;  ///< across the plane
    int side = 0;          ///< where the front is; 0: on both sides
  };

  std::optional<Flat> flat_of(const Placed& placed) {
    constexpr double kThin = 1e-6;
    Flat flat{&placed};
    const BoundsBox& box = placed.box;
    for (std::size_t k = 0; k < 3; ++k) {
      if (box.most[k] - box.least[k] < box.most[flat.axis] - box.least[flat.axis]) flat.axis = k;
    }
    const std::size_t u = (flat.axis + 1) % 3, v = (flat.axis + 2) % 3;
    if (box.most[flat.axis] - box.least[flat.axis] > kThin * box.width()) return std::nullopt;
    const double area = (box.most[u] - box.least[u]) * (box.most[v] - box.least[v]);
    if (!(area > 0)) return std::nullopt;
    const double covered = covered_area(placed, flat.axis);
    constexpr double kNearlyAll = 0.99, kMore = 1.01;
    if (std::abs(covered) < kNearlyAll * area || std::abs(covered) > kMore * area) {
      return std::nullopt;
    }
    flat.side = covered < 0 ? -1 : 1;
    const auto& material = primitive_of(placed).material;
    if (material && model::true_member(context_.document,
                                       context_.asset.elements(RootArray::materials)[*material],
                                       "doubleSided")) {
      flat.side = 0;
    }
    return flat;
  }

  // Along an axis; negative if the front is on the other side. 0 if triangles are too many.
  double covered_area(const Placed& placed, std::size_t axis) const {
    constexpr std::uint64_t kMostTriangles = 64;
    const auto triangles = TriangleReader::open(phase_, primitive_of(placed));
    if (!triangles || triangles->count() > kMostTriangles) return 0;
    const Affine& world = scene_.pose().world[placed.node];
    double area = 0;
    for (std::uint64_t i = 0; i < triangles->count(); ++i) {
      const auto corners = triangles->corners(i);
      if (!corners) continue;
      std::array<Vector3, 3> places{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Float3 at = triangles->position((*corners)[k]);
        places[k] = world.point(
            {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
      }
      const auto from_first = [&](std::size_t k) {
        return Vector3{places[k][0] - places[0][0], places[k][1] - places[0][1],
                       places[k][2] - places[0][2]};
      };
      area += model::cross(from_first(1), from_first(2))[axis] / 2;
    }
    return world.determinant() < 0 ? -area : area;
  }

  void find_overlaps() {
    const double cell = 1e-6 * all_.width();
    Keyed<Flat> keyed;
    for (const Placed* each : solid_) {
      const auto flat = flat_of(*each);
      if (!flat) continue;
      const double at = each->box.least[flat->axis] - all_.least[flat->axis];
      const auto axis = static_cast<std::int64_t>(flat->axis);
      keyed.emplace_back(joined_place(joined_place(0, axis), place_cell(at, cell)), *flat);
    }
    bool found = false;
    for_neighbours(keyed, [&](const Flat& one, const Flat& other) {
      if (found || is_near(one.part->box, other.part->box) || one.side * other.side < 0) {
        return false;
      }
      const double share = overlap(one.part->box, other.part->box, one.axis);
      if (share < kLeastOverlap) return false;
      found = true;
      const std::uint32_t node = other.part->node;
      report_element(
          phase_.sink, context_, RootArray::nodes, node, Code::PLANES_OVERLAP,
          fmt::format("{} and {} lie in one plane and share {:.0f} % of the smaller one: "
                      "they flicker.",
                      object_label(context_, RootArray::nodes, one.part->node),
                      object_label(context_, RootArray::nodes, node), 100 * share));
      return true;
    });
  }

  static constexpr double kLeastOverlap = 0.25;

  // What two rectangles share, in parts of the smaller one.
  static double overlap(const BoundsBox& a, const BoundsBox& b, std::size_t axis) {
    double shared = 1, one = 1, other = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      if (k == axis) continue;
      shared *= std::max(0.0, std::min(a.most[k], b.most[k]) - std::max(a.least[k], b.least[k]));
      one *= a.most[k] - a.least[k];
      other *= b.most[k] - b.least[k];
    }
    return shared / std::min(one, other);
  }

  DataPhase& phase_;
  const Context& context_;
  PlacedScene& scene_;
  std::vector<Answer> opaque_;  ///< by material
  std::vector<const Placed*> solid_;
  BoundsBox all_;
  std::uint64_t doubles_ = 0;
};

}  // namespace

void check_coincidence(DataPhase& phase, PlacedScene& scene) { Coincidences(phase, scene).run(); }

}  // namespace gltfx::validate
