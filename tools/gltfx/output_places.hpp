// SPDX-License-Identifier: Apache-2.0
/// Where the new bytes and the picture of each input go.
#pragma once

#include <gltfx/pipeline.hpp>

#include <string>
#include <vector>

#include "input_paths.hpp"

namespace gltfx::tool {

/// Each asset once, however often it was named (directly, by a link, with "./" before it), with the
/// file its upgrade is written to; no files when `output` is empty.
///
/// `output` is a folder when it is one already, ends in '/', or more than one file may come (see
/// Inputs::several). What was found below a folder keeps its place below it, with as much of its
/// path before that as tells it from others; what lies in the output folder of an earlier run is
/// not found. Else `output` is a file whose ending has to be
/// that of the input, because an upgrade keeps the container. The Error says what to write instead.
Result<std::vector<EditInput>> place_outputs(const Inputs& inputs, const std::string& output);

struct PicturePlaces {
  std::vector<BakeInput> inputs;
  std::string sheet;  ///< of all pictures; empty: none
};

/// `output` is a folder when it is one already, ends in '/', or more than one asset may come: then
/// pictures are called like the assets, below it as these lie below the folder that was named, with
/// as much of the path before that as tells them apart. Else it is the file. A run that draws one
/// shard of them makes no sheet of its own. The Error says what is in the way.
Result<PicturePlaces> place_pictures(const Inputs& inputs, const BakeRequest& request);

}  // namespace gltfx::tool
