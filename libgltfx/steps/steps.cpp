// SPDX-License-Identifier: Apache-2.0
#include "steps/step.hpp"

namespace gltfx::steps {

StepDescription flatten_step();
StepDescription decode_step();
StepDescription older_version_step();
StepDescription scale_step();
StepDescription rebase_step();
StepDescription center_step();
StepDescription instances_step();
StepDescription elements_step();
StepDescription primitives_step();
StepDescription members_step();
StepDescription prune_step();
StepDescription dedup_step();
StepDescription images_step();
StepDescription weld_step();
StepDescription simplify_step();
StepDescription resample_step();
StepDescription quantize_step();
StepDescription reorder_step();
StepDescription meshopt_step();
StepDescription draco_step();
StepDescription compact_step();
StepDescription container_step();

// Steps that remove elements run before equal objects are merged: vertices and keyframes that
// several objects share can only be removed if none of these needs them.
std::vector<StepDescription> steps() {
  return {flatten_step(), decode_step(),    older_version_step(), scale_step(),    rebase_step(),
          center_step(),  instances_step(), primitives_step(),    elements_step(), members_step(),
          prune_step(),   weld_step(),      simplify_step(),      resample_step(), dedup_step(),
          images_step(),  quantize_step(),  reorder_step(),       meshopt_step(),  draco_step(),
          compact_step(), container_step()};
}

}  // namespace gltfx::steps
