// SPDX-License-Identifier: Apache-2.0
/// Output paths of new bytes and pictures of the inputs.
#pragma once

#include <gltfx/pipeline.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "input_paths.hpp"

namespace gltfx::tool {

/// Whether the name of one output ends as that of its input.
enum class Ending : std::uint8_t {
  stays,  ///< it does, because the container stays
  may_change,
};

/// Each asset once, however often it was named (directly, by a link, with "./" before it), with the
/// file its upgrade is written to; no files when `output` is empty.
///
/// `output` is a folder when it is one already, ends in '/', or there may be more than one file
/// (see Inputs::several). Files found below a folder keep their place below it, with as much of the
/// path before it as distinguishes them from others; files in the output folder of an earlier run
/// are not found. Otherwise `output` is a file; `ending` says whether it has the
/// ending of the input. The Error says what to write instead.
Result<std::vector<EditInput>> place_outputs(const Inputs& inputs, const std::string& output,
                                             Ending ending = Ending::stays);

struct PicturePlaces {
  std::vector<BakeInput> inputs;
  std::string sheet;  ///< of all pictures; empty: none
};

/// `output` is a folder when it is one already, ends in '/', or there may be more than one asset:
/// pictures then have the names of the assets and their places below the named folder, with as much
/// of the path before it as distinguishes them. Otherwise it is the file. A run of one shard makes
/// no contact sheet by default. The Error describes the conflict.
Result<PicturePlaces> place_pictures(const Inputs& inputs, const BakeRequest& request);

/// Why the difference of two pictures cannot be written to the output; nothing: it can, or there is
/// none.
std::optional<Error> check_difference_name(const BakeRequest& request);

}  // namespace gltfx::tool
