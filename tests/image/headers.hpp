// SPDX-License-Identifier: Apache-2.0
/// Headers of images for tests.
#pragma once

#include <span>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "image/header.hpp"
#include "image/png_builder.hpp"

namespace gltfx::test {

inline image::HeaderResult read(const std::string& bytes) {
  return image::read_header(std::as_bytes(std::span(bytes.data(), bytes.size())));
}

inline image::Header header(const std::string& bytes) {
  const image::HeaderResult result = read(bytes);
  const auto* found = std::get_if<image::Header>(&result);
  EXPECT_NE(found, nullptr);
  return found != nullptr ? *found : image::Header{};
}

inline image::HeaderError::Kind error(const std::string& bytes) {
  const image::HeaderResult result = read(bytes);
  const auto* found = std::get_if<image::HeaderError>(&result);
  EXPECT_NE(found, nullptr);
  return found != nullptr ? found->kind : image::HeaderError::Kind::unrecognized;
}

/// What makes readers refuse an image that has a header.
inline std::string doubt(const std::string& bytes) { return header(bytes).doubt; }

/// The remark on an image that readers show, preceded by '!' if they differ.
inline std::string remark(const std::string& bytes) {
  const image::Header found = header(bytes);
  EXPECT_EQ(found.doubt, "");
  return (found.readers_differ ? "!" : "") + found.remark;
}

}  // namespace gltfx::test
