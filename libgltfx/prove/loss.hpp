// SPDX-License-Identifier: Apache-2.0
/// Measures what a change of vertices lost.
#pragma once

#include <gltfx/convert.hpp>

#include <string>
#include <vector>

#include "model/opened_asset.hpp"
#include "schema/set.hpp"

namespace gltfx::prove {

/// A quantity of LossBounds and its greatest loss.
struct MeasuredLoss {
  std::optional<double> LossBounds::*quantity;
  double measured = 0;  ///< in the unit of the member; 0: it is exact
};

struct LossProof {
  /// The first difference that is no loss within LossBounds, half a sentence with a pointer; empty:
  /// none.
  std::string difference;
  std::vector<MeasuredLoss> losses;  ///< of all quantities
};

/// Measures the loss between two assets that differ only in the numbers of vertices, in what places
/// them (MeaningRequest::regridded), and in keyframes, at all corners of all meshes.
LossProof measure_loss(const model::OpenedAsset& before, const model::OpenedAsset& after,
                       const schema::Set& schemas, unsigned jobs);

/// The loss for a report, such as "positions" 0.006 of 0.01 "%".
ConvertLoss report_loss(const MeasuredLoss& loss, double bound);

}  // namespace gltfx::prove
