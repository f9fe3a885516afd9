// SPDX-License-Identifier: Apache-2.0
/// Published limits of platforms and guidelines: the files of schema/presets.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "measure/limit.hpp"

namespace gltfx::tool {

/// A file of schema/presets, as the build puts it into the program.
struct EmbeddedPreset {
  std::string_view id;  ///< "khronos-3d-commerce/mobile-ar"
  std::string_view text;
};

/// All of them, sorted by id.
std::span<const EmbeddedPreset> embedded_presets();

struct Preset {
  std::string id;
  std::string title;
  std::string source;    ///< URL
  std::string dated;     ///< version or date that the source states, else "undated"
  std::string read;      ///< day on which the limits were read there
  std::string evidence;  ///< "page" or "repository": what was read
  std::vector<measure::LimitChange> limits;

  /// "preset khronos-3d-commerce/mobile-ar, 1.0.0, 2020-10-20, read 2026-11-28".
  std::string origin() const;
};

/// The text of a preset. The Error has a line for each mistake.
Result<Preset> parse_preset(std::string_view id, std::string_view text);

/// The preset of that id. The Error has the nearest one.
Result<Preset> read_preset(std::string_view id);

}  // namespace gltfx::tool
