// SPDX-License-Identifier: Apache-2.0
/// Where simplified surfaces are drawn: how large an error is there, and what they touch.
#pragma once

#include <vector>

#include "base/result.hpp"
#include "steps/simplify_search.hpp"
#include "steps/step_data.hpp"

namespace gltfx::steps {

struct SimplifyPlaces {
  /// By job: the diagonal that percents are of, that of the default scene or of a mesh outside.
  std::vector<double> diagonals;
};

/// Sets the scale of each job, and locks the borders that touch others in the default scene, or in
/// their own mesh; all borders with `lock_all`. Returns an Error (half a sentence) if the size of
/// the scene is not known.
Result<SimplifyPlaces> find_simplify_places(const StepData& data, std::vector<SimplifyJob>& jobs,
                                            bool lock_all);

}  // namespace gltfx::steps
