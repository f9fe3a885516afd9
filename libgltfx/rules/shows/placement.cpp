// SPDX-License-Identifier: Apache-2.0
// Sizes that suggest other units than meters, and parts or origins in the wrong place.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "model/info.hpp"
#include "model/skin.hpp"
#include "rules/collector.hpp"
#include "rules/finding.hpp"
#include "rules/shows/shows.hpp"

namespace gltfx::validate {
namespace {

using model::RootArray;
using model::Vector3;

// Meters; larger scenes have a finding of their own.
constexpr double kLargestScene = 1e8;

Vector3 middle_of(const BoundsBox& box) {
  Vector3 middle{};
  for (std::size_t k = 0; k < 3; ++k) middle[k] = (box.least[k] + box.most[k]) / 2;
  return middle;
}

BoundsBox box_of_all(const PlacedScene& scene) {
  BoundsBox all;
  for (const Placed& each : scene.parts()) all.include(each.box);
  return all;
}

// A finding about the scene that is drawn; an asset without scenes has it at its root.
void report_on_scene(DataPhase& phase, Code code, std::string message, std::string help) {
  const auto scene = model::choose_scene(phase.context.asset, phase.context.views).scene;
  const json::NodeId object = scene ? phase.context.asset.elements(RootArray::scenes)[*scene]
                                    : phase.context.document.root();
  Finding finding = finding_on(phase.context, object, code, std::move(message), std::move(help));
  report_at(phase.sink, scene ? fmt::format("/scenes/{}", *scene) : std::string(),
            std::move(finding));
}

constexpr std::string_view kScaleHelp =
    "if so, convert the unit in the export, or scale the root nodes";

// --- Units ---

// What a length looks like if a thing is usually from `least` to `most` meters long: the unit that
// makes it closest to one meter.
std::string_view likely_unit(double length, double least, double most) {
  struct Unit {
    double per_meter;
    std::string_view text;
  };
  constexpr std::array<Unit, 4> kUnits = {{{100, "centimeters"},
                                           {1000, "millimeters"},
                                           {0.01, "meters that were divided by 100"},
                                           {0.001, "meters that were divided by 1,000"}}};
  std::string_view best = "other units than meters";
  double distance = std::numeric_limits<double>::infinity();
  for (const Unit& unit : kUnits) {
    const double meters = length / unit.per_meter;
    if (meters < least || meters > most || std::abs(std::log(meters)) >= distance) continue;
    distance = std::abs(std::log(meters));
    best = unit.text;
  }
  return best;
}

// Parts of a human body in names of joints, in the words of the usual rigs.
std::size_t body_parts(const Context& context, const model::Skin& skin) {
  constexpr std::array<std::array<std::string_view, 3>, 8> kParts = {{{"hips", "pelvis", "root"},
                                                                      {"spine", "chest", "torso"},
                                                                      {"neck", "neck", "neck"},
                                                                      {"head", "head", "head"},
                                                                      {"arm", "elbow", "shoulder"},
                                                                      {"hand", "wrist", "hand"},
                                                                      {"leg", "thigh", "knee"},
                                                                      {"foot", "ankle", "toe"}}};
  constexpr std::size_t kMostJoints = 512;
  std::array<bool, kParts.size()> found{};
  for (std::size_t i = 0; i < std::min(kMostJoints, skin.joint_nodes.size()); ++i) {
    const std::string name = lower_case(model::string_member(
        context.document, context.views.nodes[skin.joint_nodes[i]].object, "name"));
    for (std::size_t part = 0; part < kParts.size(); ++part) {
      found[part] = found[part] || std::any_of(kParts[part].begin(), kParts[part].end(),
                                               [&](std::string_view word) {
                                                 return name.find(word) != std::string::npos;
                                               });
    }
  }
  return static_cast<std::size_t>(std::count(found.begin(), found.end(), true));
}

// True if there is a human skeleton: its size tells the units of all.
bool check_humans(DataPhase& phase, const PlacedScene& scene) {
  constexpr double kTallest = 20, kSmallest = 0.05;  // meters
  constexpr double kLeastHuman = 0.3, kMostHuman = 4;
  constexpr std::size_t kLeastParts = 6, kMostSkins = 256;
  const Context& context = phase.context;
  const auto& skins = context.asset.elements(RootArray::skins);
  bool any = false;
  for (std::size_t i = 0; i < std::min(kMostSkins, skins.size()); ++i) {
    const model::Skin skin = model::read_skin(context.asset, skins[i]);
    if (skin.joint_nodes.size() < kLeastParts || body_parts(context, skin) < kLeastParts) continue;
    BoundsBox box;
    for (const model::NodeIndex joint : skin.joint_nodes) {
      const Vector3& place = scene.pose().world[joint].columns[3];
      box.include({place, place});
    }
    any = true;
    const double size = box.width();
    if (!is_sound(box) || !(size > 0) || (size <= kTallest && size >= kSmallest)) continue;
    report_element(phase.sink, context, RootArray::skins, i, Code::UNITS_NOT_METERS,
                   fmt::format("The joints of {} have names of a human body and span {:.3g} m: "
                               "this looks like {}.",
                               object_label(context, RootArray::skins, i), size,
                               likely_unit(size, kLeastHuman, kMostHuman)));
    break;
  }
  return any;
}

// Names of things that may be large.
bool is_large_by_name(const Context& context, const Placed& part) {
  constexpr std::array<std::string_view, 22> kWords = {
      "building", "house",  "tower", "city",   "town",   "terrain", "land",     "map",
      "sky",      "dome",   "world", "planet", "ground", "bridge",  "mountain", "street",
      "stadium",  "island", "ship",  "tile",   "site",   "ocean"};
  for (const json::NodeId object :
       {context.views.nodes[part.node].object, context.views.meshes[part.mesh].node}) {
    const std::string name = lower_case(model::string_member(context.document, object, "name"));
    if (std::any_of(kWords.begin(), kWords.end(),
                    [&](std::string_view word) { return name.find(word) != std::string::npos; })) {
      return true;
    }
  }
  return false;
}

// A single object that is compact, near its origin, and of as few triangles as small things have.
bool is_one_thing(const Context& context, const PlacedScene& scene, const BoundsBox& box) {
  constexpr double kMostAspect = 4;
  constexpr std::uint64_t kMostTriangles = 200'000;
  const auto& parts = scene.parts();
  const auto& nodes = context.views.nodes;
  const bool alone = std::all_of(parts.begin(), parts.end(), [&](const Placed& each) {
    return each.node == parts.front().node;
  });
  const bool seen = std::any_of(nodes.begin(), nodes.end(),
                                [](const model::Node& each) { return each.camera.has_value(); });
  if (!alone || seen || is_large_by_name(context, parts.front())) return false;
  const Vector3 middle = middle_of(box);
  std::uint64_t triangles = 0;
  for (const model::Primitive& each : context.views.meshes[parts.front().mesh].primitives) {
    triangles += model::primitive_size(context.views, each).triangles;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if ((box.most[k] - box.least[k]) * kMostAspect < box.width()) return false;
    if (std::abs(middle[k]) > box.width()) return false;
  }
  return triangles > 0 && triangles <= kMostTriangles;
}

void check_units(DataPhase& phase, const PlacedScene& scene) {
  // Smaller scenes have a finding of their own.
  constexpr double kTiny = 5e-3, kTiniest = 1e-4, kLarge = 80;  // meters
  constexpr double kLeastThing = 0.05, kMostThing = 10;
  if (check_humans(phase, scene) || !scene.complete() || scene.parts().empty()) return;
  const BoundsBox box = box_of_all(scene);
  const double width = box.width();
  const std::string_view unit = likely_unit(width, kLeastThing, kMostThing);
  if (width >= kTiniest && width < kTiny) {
    report_on_scene(
        phase, Code::UNITS_NOT_METERS,
        fmt::format("The scene is {:.3g} mm wide: this looks like {}.", width * 1000, unit),
        std::string(kScaleHelp));
  } else if (width >= kLarge && width <= kLargestScene && is_one_thing(phase.context, scene, box)) {
    report_on_scene(phase, Code::UNITS_NOT_METERS,
                    fmt::format("The scene is one object of {:.3g} x {:.3g} x {:.3g} m: if it is "
                                "no building, this looks like {}.",
                                box.most[0] - box.least[0], box.most[1] - box.least[1],
                                box.most[2] - box.least[2], unit),
                    std::string(kScaleHelp));
  }
}

// --- Places ---

struct FarNode {
  model::NodeIndex node = 0;
  BoundsBox box;
  double distance = 0;  ///< of the middle of the box from that of most
};

// Nothing if no part can be so far away, since none is so small, or if the scene is too large.
std::vector<FarNode> resting_nodes(const PlacedScene& scene, double far) {
  std::vector<FarNode> nodes;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Placed& each : scene.parts()) smallest = std::min(smallest, each.box.width());
  const double width = box_of_all(scene).width();
  if (width <= far * smallest || width > kLargestScene) return nodes;
  for (const Placed& each : scene.parts()) {
    if (scene.moves(each.node)) continue;
    if (nodes.empty() || nodes.back().node != each.node) nodes.push_back({each.node, {}});
    nodes.back().box.include(each.box);
  }
  return nodes;
}

// The middle of most nodes; of two, that of the one nearer to the origin.
Vector3 middle_of_most(const std::vector<FarNode>& nodes) {
  Vector3 middle{};
  if (nodes.size() == 2) {
    const bool first = nodes[0].box.reach() <= nodes[1].box.reach();
    return middle_of(nodes[first ? 0 : 1].box);
  }
  std::vector<double> values(nodes.size());
  for (std::size_t k = 0; k < 3; ++k) {
    std::transform(nodes.begin(), nodes.end(), values.begin(),
                   [k](const FarNode& each) { return middle_of(each.box)[k]; });
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    middle[k] = *half;
  }
  return middle;
}

void check_far_parts(DataPhase& phase, const PlacedScene& scene) {
  constexpr double kFar = 1000;             // in widths
  if (scene.has_external_assets()) return;  // they may lie between
  std::vector<FarNode> nodes = resting_nodes(scene, kFar);
  if (nodes.size() < 2) return;
  const Vector3 middle = middle_of_most(nodes);
  for (FarNode& each : nodes) {
    const Vector3 own = middle_of(each.box);
    for (std::size_t k = 0; k < 3; ++k) {
      each.distance = std::max(each.distance, std::abs(own[k] - middle[k]));
    }
  }
  std::sort(nodes.begin(), nodes.end(), [](const FarNode& a, const FarNode& b) {
    return a.distance != b.distance ? a.distance > b.distance : a.node < b.node;
  });
  const std::size_t most = std::max<std::size_t>(1, nodes.size() / 4);
  // The reach of the nodes from each on, from the middle.
  std::vector<double> reach(nodes.size() + 1, 0);
  for (std::size_t i = nodes.size(); i-- > 0;) {
    reach[i] = std::max(reach[i + 1], nodes[i].distance + nodes[i].box.width() / 2);
  }
  double widest = 0;
  for (std::size_t i = 0; i < most; ++i) {
    widest = std::max(widest, nodes[i].box.width());
    const double width = std::max(2 * reach[i + 1], widest);
    const double gap = nodes[i].distance - nodes[i].box.width() / 2 - reach[i + 1];
    if (!(width > 0) || !(gap > kFar * width)) continue;
    const std::string others =
        i > 0 ? fmt::format(" and {} other{}", i, i == 1 ? "" : "s") : std::string();
    report_element(
        phase.sink, phase.context, RootArray::nodes, nodes.front().node, Code::PART_FAR_AWAY,
        fmt::format("{}{} {} {:.0f} m away from all other parts, which are {:.3g} m wide together: "
                    "a view of the whole scene shows only dots.",
                    object_label(phase.context, RootArray::nodes, nodes.front().node), others,
                    i > 0 ? "lie" : "lies", nodes.front().distance, 2 * reach[i + 1]));
    return;
  }
}

void check_pivot(DataPhase& phase, const PlacedScene& scene) {
  constexpr double kFar = 10;      // in widths
  constexpr double kOnAMap = 1e5;  // meters: coordinates of a map are meant
  if (!is_enabled(phase.context.options, Code::PIVOT_FAR_OUTSIDE)) return;
  if (!scene.complete() || scene.parts().empty() || scene.moves()) return;
  const BoundsBox box = box_of_all(scene);
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double outside = std::max({0.0, box.least[k], -box.most[k]});
    square += outside * outside;
  }
  const double distance = std::sqrt(square);
  if (!(box.width() > 0) || !(distance > kFar * box.width())) return;
  if (distance > kOnAMap) return;
  report_on_scene(phase, Code::PIVOT_FAR_OUTSIDE,
                  fmt::format("All that is drawn is {:.3g} m wide and {:.3g} m from the origin, "
                              "around which the asset is placed and turned.",
                              box.width(), distance),
                  "move the origin to the model in the authoring tool");
}

}  // namespace

void check_placement(DataPhase& phase, const PlacedScene& scene) {
  check_units(phase, scene);
  check_far_parts(phase, scene);
  check_pivot(phase, scene);
}

}  // namespace gltfx::validate
