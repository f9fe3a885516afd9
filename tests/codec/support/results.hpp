// SPDX-License-Identifier: Apache-2.0
/// What tests expect of the client's answers.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "codec/client.hpp"

namespace gltfx::test {

/// The value, or an empty one and a failed test with the reason.
template <typename T>
T value_of(std::variant<T, codec::DecodeError> result) {
  if (const auto* error = std::get_if<codec::DecodeError>(&result)) {
    ADD_FAILURE() << error->message;
    return {};
  }
  return std::get<T>(std::move(result));
}

/// The error, or an empty one and a failed test.
template <typename T>
codec::DecodeError error_of(const std::variant<T, codec::DecodeError>& result) {
  if (const auto* error = std::get_if<codec::DecodeError>(&result)) return *error;
  ADD_FAILURE() << "there is a result";
  return {};
}

/// The message of an error of this kind, or "a result".
template <typename T>
std::string refusal_of(const std::variant<T, codec::DecodeError>& result,
                       codec::ErrorKind kind = codec::ErrorKind::malformed) {
  const auto* error = std::get_if<codec::DecodeError>(&result);
  if (error == nullptr) return "a result";
  EXPECT_EQ(error->kind, kind);
  return error->message;
}

/// The bytes of a PNG with such texels.
inline std::vector<std::byte> png_file(const codec::Raster& raster,
                                       std::span<const std::byte> texels) {
  const codec::EncodedImage file = value_of(
      codec::Client::shared().encode_image({codec::EncodedFormat::png, raster, 0, texels}));
  return {file.bytes.begin(), file.bytes.end()};
}

}  // namespace gltfx::test
