// SPDX-License-Identifier: Apache-2.0
#include "prove/lengths.hpp"

#include <algorithm>
#include <cmath>

#include "model/longest_axis.hpp"

namespace gltfx::prove {
namespace {

// Skinned meshes are placed by their joints.
std::vector<double> scales_of(const Content& content, const NodeTree& tree) {
  const auto& views = content.side().views();
  std::vector<double> scales(content.side().asset().count(model::RootArray::materials));
  for (const std::uint32_t node : tree.order()) {
    const model::Node& described = views.nodes[node];
    if (!described.mesh || described.skin) continue;
    const double scale = model::longest_axis(tree.world(node));
    for (const Surface& surface : content.surfaces(*described.mesh)) {
      if (!surface.material || *surface.material >= scales.size()) continue;
      double& greatest = scales[*surface.material];
      greatest = std::max(greatest, scale);
    }
  }
  return scales;
}

}  // namespace

void MaterialLengths::read() {
  if (is_read_) return;
  is_read_ = true;
  here_ = scales_of(all_.ours, all_.our_nodes);
  there_ = scales_of(all_.theirs, all_.their_nodes);
}

std::optional<double> MaterialLengths::apart_in_scene(ItemId ours, double here, ItemId theirs,
                                                      double there) {
  read();
  const double one = here_[ours.index];
  const double other = there_[theirs.index];
  constexpr double kSame = 1e-9;
  if (!(one > 0) || !(other > 0) || std::fabs(one - other) <= kSame * one) return std::nullopt;
  // As single precision stores the numbers.
  constexpr double kRounding = 1e-5;
  const double before = here * one;
  const double after = there * other;
  const double distance = std::fabs(after - before);
  return distance <= kRounding * std::fabs(before) ? 0 : distance;
}

}  // namespace gltfx::prove
