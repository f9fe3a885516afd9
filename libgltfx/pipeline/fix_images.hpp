// SPDX-License-Identifier: Apache-2.0
/// Fixes that convert images, as `gltfx convert --images legal` does.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "change/change.hpp"
#include "model/opened_asset.hpp"
#include "schema/set.hpp"

namespace gltfx {

/// The outcome for some images.
struct LegalImages {
  change::Change change;                      ///< placed; empty: no image is converted
  std::map<std::uint32_t, std::string> left;  ///< by image: why it stays, half a sentence
  /// Why images that can be converted elsewhere or later were not, half a sentence: a decoder or a
  /// file is missing. Empty: no such reason.
  std::string trouble;
};

/// Converts images, by index, to a format that the asset allows, without loss. New files are named
/// after the old ones and their content; old files stay.
LegalImages make_images_legal(const model::OpenedAsset& asset, const schema::Set& schemas,
                              const std::set<std::uint32_t>& images);

}  // namespace gltfx
