// SPDX-License-Identifier: Apache-2.0
/// Assets with a factor map of the first translucency, upgraded on the disk and read again.
#pragma once

#include <gltfx/pipeline.hpp>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "codec/client.hpp"
#include "container/base64.hpp"
#include "container/container.hpp"
#include "container/temp_folder.hpp"
#include "image/header.hpp"
#include "model/image_codec.hpp"

namespace gltfx::test {

using Json = nlohmann::ordered_json;
using container::test::TempFolder;

inline std::string content(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// An image with its pixels; a failed test and an empty one when it cannot be decoded.
inline codec::Image decoded(const std::string& file) {
  codec::ImageRequest request;
  request.bytes = bytes_of(file);
  const image::Sniffed sniffed = image::sniff(request.bytes);
  request.format = model::codec_format(sniffed.format);
  request.pixels = true;
  codec::ImageResult result = codec::Client::shared().decode_image(request);
  if (const auto* error = std::get_if<codec::DecodeError>(&result)) {
    ADD_FAILURE() << error->message;
    return {};
  }
  return std::get<codec::Image>(std::move(result));
}

/// One channel of all texels, by its position among those that are stored.
inline std::vector<unsigned> channel(const codec::Image& image, std::size_t place) {
  std::vector<unsigned> values;
  const std::size_t size = image.bits / 8;
  for (std::size_t at = place * size; at < image.pixels.size(); at += image.channels * size) {
    std::uint16_t value = 0;
    std::memcpy(&value, image.pixels.data() + at, size);
    values.push_back(value);
  }
  return values;
}

/// A document whose materials have `extension` as their legacy extension, with those images and a
/// texture of each.
inline Json document(const std::vector<Json>& extensions, const Json& images) {
  Json document = {{"asset", {{"version", "2.0"}}},
                   {"extensionsUsed", {"KHR_materials_translucency"}},
                   {"materials", Json::array()},
                   {"textures", Json::array()},
                   {"images", images}};
  for (const Json& extension : extensions) {
    document["materials"].push_back({{"extensions", {{"KHR_materials_translucency", extension}}}});
  }
  for (std::size_t i = 0; i < images.size(); ++i) document["textures"].push_back({{"source", i}});
  return document;
}

inline Json mapped(double factor = 1, int texture = 0) {
  return {{"translucencyFactor", factor}, {"translucencyTexture", {{"index", texture}}}};
}

/// The new extension of a material.
inline Json upgraded_extension(const Json& document, std::size_t material = 0) {
  return document["materials"][material]["extensions"]["KHR_materials_diffuse_transmission"];
}

inline UpgradeOptions in_place() {
  UpgradeOptions options;
  options.in_place = true;
  return options;
}

/// The bytes of an image of an asset in `folder`: a file, a data URI or a buffer view of `bin`.
inline std::string image_bytes(const Json& document, std::size_t index,
                               const std::filesystem::path& folder, std::string_view bin = {}) {
  const Json& image = document["images"][index];
  if (image.contains("bufferView")) {
    const Json& view = document["bufferViews"][image["bufferView"].get<std::size_t>()];
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0U);
    return std::string(bin.substr(view["byteOffset"], view["byteLength"]));
  }
  const std::string uri = image["uri"];
  constexpr std::string_view kData = "data:image/png;base64,";
  if (!uri.starts_with(kData)) return content(folder / uri);
  const auto bytes = container::decode_base64(std::string_view(uri).substr(kData.size()));
  return bytes ? *bytes : std::string();
}

}  // namespace gltfx::test
