// SPDX-License-Identifier: Apache-2.0
#include "model/scene_extent.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/pose.hpp"
#include "rules/finding.hpp"
#include "rules/payload/phases.hpp"

namespace gltfx::validate {
namespace {

// Meters. Below the first, no shape is visible; above the second, eight times the width of the
// Earth, neighboring 32-bit positions are eight meters apart.
constexpr double kSmallestScene = 1e-4;
constexpr double kLargestScene = 1e8;
// Larger scenes would take more time and memory than all other rules.
constexpr std::uint64_t kMostParts = std::uint64_t{1} << 16U;
constexpr std::uint64_t kInstanceTransforms = std::uint64_t{1} << 24U;

bool is_measured(const Context& context) {
  std::uint64_t parts = context.views.nodes.size() + context.views.meshes.size();
  for (const json::NodeId skin : context.asset.elements(model::RootArray::skins)) {
    if (skin == json::kNoNode) continue;
    const json::NodeId joints = context.document.find(skin, "joints");
    if (joints != json::kNoNode && context.document.is_array(joints)) {
      parts += context.document.array_size(joints);
    }
  }
  return parts <= kMostParts;
}

double width_of(const SceneBounds& bounds) {
  double width = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    width = std::max(width, bounds.greatest[i] - bounds.least[i]);
  }
  return width;
}

std::string length_text(double metres) {
  return metres < 1 ? fmt::format("{:.3g} mm", metres * 1000)
                    : fmt::format("{:.3g} km", metres / 1000);
}

}  // namespace

const model::Pose& DataPhase::pose() {
  if (!made_pose) {
    made_pose = std::make_unique<const model::Pose>(model::compute_pose(
        context.asset, context.views, model::choose_scene(context.asset, context.views)));
  }
  return *made_pose;
}

const BoundsBox& DataPhase::box_of(std::uint32_t accessor) {
  made_boxes.resize(context.views.accessors.size());
  std::optional<BoundsBox>& box = made_boxes[accessor];
  if (!box) {
    box = stated_box(context.document, context.views.accessors[accessor]).value_or(BoundsBox());
  }
  return *box;
}

BoundsBox DataPhase::box_of_primitive(const model::Primitive& primitive) {
  const model::Attribute* positions = primitive.find(model::SemanticKind::position);
  return positions == nullptr || !positions->accessor ? BoundsBox() : box_of(*positions->accessor);
}

BoundsBox DataPhase::box_of_mesh(std::uint32_t mesh) {
  BoundsBox box;
  for (const model::Primitive& primitive : context.views.meshes[mesh].primitives) {
    box.include(box_of_primitive(primitive));
  }
  return box;
}

void check_scene_extent(DataPhase& phase) {
  if (!is_measured(phase.context)) return;
  const model::SceneExtent extent =
      model::scene_extent(phase.context.asset, phase.context.views, phase.resources, {},
                          kInstanceTransforms, phase.pose());
  if (!extent.bounds) return;
  const double width = width_of(*extent.bounds);
  // A single point has no width.
  if (width == 0 || (width >= kSmallestScene && width <= kLargestScene)) return;
  const bool large = width > kLargestScene;
  const std::string cause =
      large ? " because of " + object_label(phase.context, model::RootArray::nodes, extent.farthest)
            : "";
  std::string message = fmt::format("The scene is {} wide{}; 0.1 mm to 100,000 km is expected.",
                                    length_text(width), cause);
  const auto scene = model::choose_scene(phase.context.asset, phase.context.views).scene;
  if (scene) {
    report_element(phase.sink, phase.context, model::RootArray::scenes, *scene, Code::UNUSUAL_SCALE,
                   std::move(message));
    return;
  }
  phase.sink.report(Path(), finding_on(phase.context, phase.context.document.root(),
                                       Code::UNUSUAL_SCALE, std::move(message)));
}

}  // namespace gltfx::validate
