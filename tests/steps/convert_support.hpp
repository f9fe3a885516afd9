// SPDX-License-Identifier: Apache-2.0
/// Converts assets to other containers and reads the files.
#pragma once

#include <gltfx/pipeline.hpp>

#include <filesystem>
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/glb_builder.hpp"
#include "container/temp_folder.hpp"

namespace gltfx::test {

using OrderedJson = nlohmann::ordered_json;

/// The parts of a file.
struct StoredAsset {
  explicit StoredAsset(const std::string& bytes)
      : container(container::open_bytes(container::Bytes::from_string(bytes))),
        text(container.json ? std::string(*container.json) : std::string()) {
    text.resize(text.find_last_not_of(" \n") + 1);
    if (container.bin) bin = chunk(*container.bin);
  }
  static StoredAsset at(const std::filesystem::path& path) {
    return StoredAsset(container::test::content_of(path));
  }

  std::string chunk(const container::Chunk& which) const {
    return std::string(container.bytes.text().substr(which.offset, which.length));
  }
  OrderedJson json() const { return OrderedJson::parse(text); }

  container::Container container;
  std::string text;  ///< without padding
  std::string bin;
};

/// A GLB with a text, a BIN chunk (data without padding), and further chunks.
inline std::string glb_of(std::string text, std::string_view bin, std::string_view more = {}) {
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return container::test::glb(container::test::chunk(container::kChunkJson, text) +
                              container::test::bin_chunk(bin) + std::string(more));
}

inline ConvertOptions options_to(const std::filesystem::path& output) {
  ConvertOptions options;
  options.output = output.native();
  return options;
}

/// Converts; expects success.
inline ConvertReport converted(const std::filesystem::path& from,
                               const std::filesystem::path& output) {
  ConvertReport report = convert_file(from.native(), options_to(output));
  EXPECT_TRUE(report.written) << report.error;
  return report;
}

inline constexpr std::string_view kPng("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);

/// Bytes that start like a PNG.
inline std::string picture(std::string_view content) { return std::string(kPng).append(content); }

}  // namespace gltfx::test
