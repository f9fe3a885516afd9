// SPDX-License-Identifier: Apache-2.0
/// Bytes of buffers for tests.
#pragma once

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <vector>

namespace gltfx::test {

/// Numbers one after the other, little-endian.
template <typename T>
std::string packed(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}
template <typename T>
std::string packed(std::initializer_list<T> values) {
  return packed(std::vector<T>(values));
}
inline std::string floats(std::initializer_list<float> values) { return packed<float>(values); }

inline std::string base64(const std::string& bytes) {
  static constexpr char kLetters[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto byte = i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U;
      group = group << 8U | byte;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool there = i + k <= bytes.size();
      text += there ? kLetters[group >> (18U - 6U * k) & 63U] : '=';
    }
  }
  return text;
}

inline std::string buffer_uri(const std::string& bytes) {
  return "data:application/octet-stream;base64," + base64(bytes);
}

}  // namespace gltfx::test
