// SPDX-License-Identifier: Apache-2.0
/// Assets in memory and fixtures, converted.
#pragma once

#include <gltfx/tinygltf.hpp>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include "container/container.hpp"

namespace gltfx::test {

inline std::filesystem::path fixture(const std::string& name) {
  return std::filesystem::path(GLTFX_SOURCE_DIR) / "fixtures" / name;
}

inline std::string content(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The JSON text of a .gltf or .glb.
inline nlohmann::json json_of(const std::string& bytes) {
  const auto opened = container::open_bytes(container::Bytes::from_string(bytes));
  return opened.json ? nlohmann::json::parse(*opened.json, nullptr, false) : nlohmann::json();
}

inline std::string pointers(const std::vector<TinygltfNote>& notes, bool lost) {
  std::string text;
  for (const TinygltfNote& note : notes) {
    if (note.lost == lost) text += note.pointer + "\n";
  }
  return text;
}

inline std::string problems(const TinygltfReport& report) {
  std::string text = report.error;
  for (const Diagnostic& each : report.validation.diagnostics) {
    if (each.severity != Severity::error) continue;
    text.append("\n").append(each.code).append(" ").append(each.pointer).append(": ");
    text.append(each.message);
  }
  return text;
}

/// The model of an asset that is expected to become one.
inline tinygltf::Model model_of(const std::filesystem::path& path,
                                const ToTinygltfOptions& options = {}) {
  tinygltf::Model model;
  const TinygltfReport report = to_tinygltf(path.native(), model, options);
  EXPECT_TRUE(report.done) << path << ": " << problems(report);
  return model;
}

/// The component of an accessor's element, by the bytes of the model.
inline double component_at(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                           std::size_t element, std::size_t component) {
  const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  const auto& data = model.buffers.at(static_cast<std::size_t>(view.buffer)).data;
  const auto size = static_cast<std::size_t>(
      tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)));
  const auto stride = static_cast<std::size_t>(accessor.ByteStride(view));
  const std::size_t at =
      view.byteOffset + accessor.byteOffset + element * stride + component * size;
  EXPECT_LE(at + size, data.size());
  const auto read = [&](auto value) {
    std::memcpy(&value, data.data() + at, sizeof(value));
    return static_cast<double>(value);
  };
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return read(std::int8_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return read(std::uint8_t{});
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return read(std::int16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return read(std::uint16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return read(std::uint32_t{});
    default:
      return read(float{});
  }
}

}  // namespace gltfx::test
