// SPDX-License-Identifier: Apache-2.0
/// Where the picture of each asset goes.
#pragma once

#include <gltfx/pipeline.hpp>

#include <string>
#include <vector>

#include "input_paths.hpp"

namespace gltfx::tool {

struct PicturePlaces {
  std::vector<BakeInput> inputs;
  std::string sheet;  ///< of all pictures; empty: none
};

/// `output` is a folder when it is one already, ends in '/', or more than one asset may come: then
/// pictures are called like the assets, below it as these lie below the folder that was named. Else
/// it is the file. A run that draws one shard of them makes no sheet of its own. The Error says
/// what is in the way.
Result<PicturePlaces> place_pictures(const Inputs& inputs, const BakeRequest& request);

}  // namespace gltfx::tool
