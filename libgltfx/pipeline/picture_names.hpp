// SPDX-License-Identifier: Apache-2.0
/// Names of the pictures of one asset: what they have between the name and the ending of the
/// output.
#pragma once

#include <gltfx/bake.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

/// Of one camera in one size: ".front-64x32". `camera`: its part of the name, or empty.
std::string shot_suffix(const BakeOptions& options, const std::string& camera,
                        const BakeSize& size);
/// Of a frame: "-007".
std::string frame_suffix(std::size_t number);
/// Of a layer: "-depth".
std::string layer_suffix(BakeLayer layer);

/// The part of each of BakeOptions::cameras; empty where there is but one.
std::vector<std::string> camera_parts(const BakeOptions& options);

/// How frames become files of a format; `files` where there are none.
BakeLayout layout_of(const BakeOptions& options, bool has_frames, bool webp);

/// All that an asset may get. Which cameras and clips it has is not known.
struct PossibleSuffixes {
  std::vector<std::string> single;
  /// Of frames in files of their own, with "#" for the number.
  std::vector<std::string> numbered;
};
PossibleSuffixes possible_suffixes(const BakeOptions& options, bool webp);

/// `path` with something between its name and its ending.
std::string with_suffix(const std::string& path, std::string_view suffix);

/// A name without its ending, with "#" for the number of a frame: "turn-#-depth" of
/// "turn-007-depth". Other names stay.
std::string with_any_number(std::string name);

}  // namespace gltfx
