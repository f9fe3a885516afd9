// SPDX-License-Identifier: Apache-2.0
/// The findings on an asset with metadata, without those on unused objects.
#pragma once

#include <string>

#include "rules/part.hpp"

namespace gltfx::test {

inline Lines metadata_findings(const std::string& text, PixelLevel pixels = PixelLevel::headers) {
  ValidateOptions options;
  options.pixels = pixels;
  Lines lines;
  for (const std::string& line : verdict(text, options)) {
    if (line.find("UNUSED") == std::string::npos) lines.push_back(line);
  }
  return lines;
}

}  // namespace gltfx::test
