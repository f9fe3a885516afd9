// SPDX-License-Identifier: Apache-2.0
/// KTX2 files as tests read them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image/ktx2.hpp"
#include "image/ktx2_builder.hpp"

namespace gltfx::test {

inline image::Ktx2 read_ktx2_text(const std::string& bytes) {
  return image::read_ktx2(std::as_bytes(std::span(bytes.data(), bytes.size())));
}

/// The codes of all errors.
inline std::vector<std::string> codes(const std::string& bytes) {
  std::vector<std::string> found;
  for (const image::Ktx2Error& error : read_ktx2_text(bytes).errors)
    found.emplace_back(code_name(error.code));
  return found;
}

/// The sentences of one code, with '!' in front of those that readers pass over.
inline std::vector<std::string> problems(const std::string& bytes, std::string_view code) {
  std::vector<std::string> found;
  for (const image::Ktx2Error& error : read_ktx2_text(bytes).errors) {
    if (code_name(error.code) == code)
      found.push_back((error.tolerated ? "!" : "") + error.problem);
  }
  return found;
}

}  // namespace gltfx::test
