// SPDX-License-Identifier: Apache-2.0
/// Parts of an asset that a user names.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "model/asset.hpp"

namespace gltfx {

/// Which of `names` a word means: one by its name, else by its index. An empty word means nothing.
/// `kind` stands in the Error: "camera".
Result<std::optional<std::uint32_t>> find_named(std::string_view kind, const std::string& word,
                                                const std::vector<std::string>& names);

/// The same for a node, which a JSON pointer may name too: "/nodes/3".
Result<std::optional<std::uint32_t>> find_node(const std::string& word,
                                               const std::vector<std::string>& names);

/// Whether an asset may lack a part that a user names. A missing part is noted if there are others.
struct Presence {
  bool optional = false;
  std::vector<std::string>& notes;
};
/// As find_named(), but a missing part that is optional is nothing and not an Error.
Result<std::optional<std::uint32_t>> find_part(std::string_view kind, const std::string& word,
                                               const std::vector<std::string>& names,
                                               const Presence& presence);

/// The names of all elements of a root array; of those without one empty.
std::vector<std::string> names_in(const model::Asset& asset, model::RootArray array);

/// "12.5,-3": both numbers, or nothing.
std::optional<std::pair<double, double>> parse_angles(const std::string& word);

/// A view that goes for any asset: "front", "back", "left", "right" (the asset's own), "top",
/// "bottom" or "iso", as azimuth and elevation in degrees; or nothing.
std::optional<std::pair<double, double>> find_preset(std::string_view word);

/// Whether a camera is one of these.
bool is_for_any_asset(const std::string& camera);

/// The part of the names of files that stands for each camera: letters of ASCII, digits, '-', '_'
/// and ',' of its word, '_' for all else, and another '_' at the end where two would be the same.
std::vector<std::string> camera_file_parts(const std::vector<std::string>& cameras);

}  // namespace gltfx
