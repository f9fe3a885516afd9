// SPDX-License-Identifier: Apache-2.0
#include "model/volume_contents.hpp"

#include <algorithm>
#include <utility>

#include "model/volume_search.hpp"
#include "model/volume_watchers.hpp"

namespace gltfx::model {

double tolerance_of(const BoundingVolume& volume, const VolumeMiss& miss) {
  constexpr double kOfSize = 1e-5, kOfReach = 1.0 / (1U << 22U);
  return kOfSize * volume.size() + kOfReach * miss.reach;
}

VolumeContents::VolumeContents(const GeometrySource& source, const schema::Set& schemas,
                               MorePoints* more)
    : source_(source),
      schemas_(schemas),
      more_(more),
      volumes_(read_bounding_volumes(source.asset, source.views.nodes)) {}

VolumeContents::~VolumeContents() = default;

VolumeScopes& VolumeContents::scopes() {
  if (!scopes_) scopes_ = std::make_unique<VolumeScopes>(source_, schemas_, more_);
  return *scopes_;
}

std::vector<VolumeVerdict> VolumeContents::judge() {
  const bool any = std::any_of(volumes_.begin(), volumes_.end(),
                               [](const auto& each) { return each.has_value(); });
  if (!any) return {};
  VolumeSearch search(scopes());
  for (NodeIndex i = 0; i < volumes_.size(); ++i) {
    if (volumes_[i]) search.add(i, *volumes_[i]);
  }
  search.judge();
  return std::move(search.verdicts());
}

std::optional<FittedVolume> VolumeContents::fit(NodeIndex node, bool poses) {
  constexpr int kTries = 8;
  constexpr double kMore = 1.5;
  BoundingVolume volume = *volumes_[node];
  volume.center = {};
  volume.half = {};
  VolumeSearch extents(scopes());
  extents.add(node, volume);
  if (!poses && extents.moves()) return std::nullopt;
  ExtentWatcher box;
  if (!extents.show(box, poses) || box.all().empty()) return std::nullopt;
  const Affine from_frame = Affine::from_parts({}, volume.rotation, {1, 1, 1});
  const Vector3 middle = box.all().center();
  volume.center = from_frame.vector(middle);
  for (std::size_t k = 0; k < 3; ++k) volume.half[k] = box.all().greatest[k] - middle[k];
  // A box is done; a sphere has a radius from its center, and moments between others may be worse.
  for (int i = 0; i < kTries; ++i) {
    if (!volume.is_box && i == 0) volume.half = {};
    VolumeSearch search(scopes());
    search.add(node, volume);
    search.judge();
    const VolumeVerdict& verdict = search.verdicts().front();
    if (!verdict.complete) return std::nullopt;
    const VolumeMiss& miss = poses ? verdict.greatest : verdict.at_rest;
    const bool first_radius = !volume.is_box && i == 0;
    if (!first_radius && miss.distance <= tolerance_of(volume, miss)) {
      return FittedVolume{volume.half, volume.center};
    }
    // Where one moment between those that were sampled is worse, others may be, too.
    const double by = first_radius ? 1 : kMore;
    for (double& each : volume.half) each += by * std::max(miss.distance, 0.0);
  }
  return std::nullopt;
}

}  // namespace gltfx::model
