// SPDX-License-Identifier: Apache-2.0
/// Image files and assets with images for tests of conversions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <gmock/gmock.h>

#include "codec/client.hpp"
#include "container/base64.hpp"
#include "convert_support.hpp"
#include "image/header.hpp"
#include "model/image_codec.hpp"

namespace gltfx::test {

using Texels = std::vector<std::byte>;

/// Smooth colors with some noise. Alpha is 255 everywhere if `opaque`, otherwise 0 in parts.
inline Texels texels_of(const codec::Raster& raster, bool opaque = false) {
  std::mt19937 random(raster.width * 31 + raster.channels);
  Texels texels;
  for (std::uint32_t y = 0; y < raster.height; ++y) {
    for (std::uint32_t x = 0; x < raster.width; ++x) {
      for (std::uint32_t c = 0; c < raster.channels; ++c) {
        const bool alpha = c + 1 == raster.channels && raster.channels % 2 == 0;
        const std::uint32_t plain = (x * 3 + y * 2 + c * 40 + random() % 4) % 256;
        const std::uint32_t value = alpha ? (opaque ? 255 : x % 8 < 4 ? 0 : plain) : plain;
        if (raster.bits == 16) texels.push_back(static_cast<std::byte>(random() % 256));
        texels.push_back(static_cast<std::byte>(value));
      }
    }
  }
  return texels;
}

inline std::string image_file(codec::EncodedFormat format, const codec::Raster& raster,
                              const Texels& texels, std::uint32_t quality = 0) {
  codec::EncodeRequest request;
  request.format = format;
  request.raster = raster;
  request.quality = quality;
  request.pixels = texels;
  const codec::EncodeResult result = codec::Client::shared().encode_image(request);
  const auto* image = std::get_if<codec::EncodedImage>(&result);
  EXPECT_NE(image, nullptr) << std::get<codec::DecodeError>(result).message;
  if (image == nullptr) return {};
  return {reinterpret_cast<const char*>(image->bytes.data()), image->bytes.size()};
}

inline std::string png_file(const codec::Raster& raster, bool opaque = false) {
  return image_file(codec::EncodedFormat::png, raster, texels_of(raster, opaque));
}
inline std::string jpeg_file(const codec::Raster& raster, std::uint32_t quality = 90) {
  return image_file(codec::EncodedFormat::jpeg, raster, texels_of(raster), quality);
}
inline std::string webp_file(const codec::Raster& raster, std::uint32_t quality = 0) {
  return image_file(codec::EncodedFormat::webp, raster, texels_of(raster), quality);
}

inline image::Header header_of(const std::string& file) {
  const image::HeaderResult result =
      image::read_header(std::as_bytes(std::span(file.data(), file.size())));
  const auto* header = std::get_if<image::Header>(&result);
  EXPECT_NE(header, nullptr);
  return header == nullptr ? image::Header() : *header;
}

/// RGBA, 8 bits per channel.
inline Texels decoded(const std::string& file, codec::ImageFormat format) {
  codec::ImageRequest request;
  request.bytes = std::as_bytes(std::span(file.data(), file.size()));
  request.format = format;
  request.pixels = true;
  const codec::ImageResult result = codec::Client::shared().decode_image(request);
  const auto* image = std::get_if<codec::Image>(&result);
  EXPECT_NE(image, nullptr) << std::get<codec::DecodeError>(result).message;
  if (image == nullptr) return {};
  EXPECT_EQ(image->bits, 8U);
  Texels texels;
  for (std::size_t at = 0; at < image->pixels.size(); at += image->channels) {
    for (std::size_t c = 0; c < 3; ++c) {
      texels.push_back(image->pixels[at + (image->channels < 3 ? 0 : c)]);
    }
    texels.push_back(image->has_alpha() ? image->pixels[at + image->channels - 1] : std::byte{255});
  }
  return texels;
}

/// Of any format but KTX2.
inline Texels decoded(const std::string& file) {
  return decoded(file, model::codec_format(header_of(file).format));
}

/// An asset in memory, and its conversion.
struct ImageConversionCase {
  MemoryAsset asset;
  ConvertOptions options;
  EditedBytes<ConvertReport> result = {};

  ImageConversionCase(std::string text, std::map<std::string, std::string> files) {
    asset.bytes = std::move(text);
    asset.name = "a.gltf";
    asset.files = std::move(files);
  }
  /// Converts the asset; expects success.
  OrderedJson run() {
    result = convert_bytes(asset, options);
    EXPECT_EQ(result.report.error, "");
    return StoredAsset(result.bytes).json();
  }
  const ConvertStep& step() const {
    const auto& steps = result.report.steps;
    return *std::find_if(steps.begin(), steps.end(),
                         [](const ConvertStep& step) { return step.step == "images"; });
  }
  /// The asset and its files after the conversion.
  ImageConversionCase again() const {
    std::map<std::string, std::string> files = asset.files;
    for (const auto& [path, bytes] : result.files) files[path] = bytes;
    ImageConversionCase next(result.bytes, std::move(files));
    next.options = options;
    return next;
  }
  std::string left() const {
    std::string text;
    for (const ConvertNote& note : step().left) text += note.pointer + ": " + note.reason + "\n";
    return text;
  }
  std::string losses() const {
    std::string text;
    for (const ConvertLoss& loss : step().losses) text += loss.quantity + "\n";
    return text;
  }
};

/// Expects that a second conversion has nothing to do.
inline void expect_settled(const ImageConversionCase& conversion) {
  ImageConversionCase again = conversion.again();
  again.run();
  EXPECT_FALSE(again.step().changes) << again.step().what;
  EXPECT_EQ(again.result.bytes, conversion.result.bytes);
  EXPECT_THAT(again.result.files, testing::IsEmpty());
}

/// One material with these members, and one texture for each of `images`, which are JSON objects.
inline std::string asset_with(std::string_view material, const std::vector<std::string>& images,
                              std::string_view more = {}) {
  std::string textures, list;
  for (std::size_t i = 0; i < images.size(); ++i) {
    textures += (i == 0 ? "" : ", ") + ("{\"source\": " + std::to_string(i) + "}");
    list += (i == 0 ? "" : ", ") + images[i];
  }
  return std::string(R"({"asset": {"version": "2.0"}, "materials": [{)")
      .append(material)
      .append(R"(}], "textures": [)")
      .append(textures)
      .append("], \"images\": [")
      .append(list)
      .append("]")
      .append(more)
      .append("}");
}

inline constexpr std::string_view kColorSlot =
    R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 0}})";
inline constexpr std::string_view kBlendedSlot =
    R"("alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}})";
inline constexpr std::string_view kNormalSlot = R"("normalTexture": {"index": 0})";
inline constexpr std::string_view kDataSlot =
    R"("pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}})";

inline std::string file_image(std::string_view uri) {
  return std::string("{\"uri\": \"").append(uri).append("\"}");
}

}  // namespace gltfx::test
