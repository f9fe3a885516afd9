// SPDX-License-Identifier: Apache-2.0
/// Random documents with legacy materials, and pictures in every form that glTF allows, with the
/// values of their texels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "codec/client.hpp"
#include "codec/support/png_encoder.hpp"
#include "container/base64.hpp"

namespace gltfx::test {

using Json = nlohmann::ordered_json;
using Texel = std::array<double, 4>;

/// Random numbers that are the same everywhere.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(engine_() % limit); }
  double share() { return below(1U << 20U) / static_cast<double>((1U << 20U) - 1); }
  double between(double least, double most) { return least + (most - least) * share(); }
  bool one_in(std::uint32_t n) { return below(n) == 0; }

 private:
  std::mt19937 engine_;
};

/// Values are 0 to 1, as they are encoded; rows from the top.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<Texel> texels;
  std::string bytes;  ///< of the file
  std::string mime;
};

inline std::span<const std::byte> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

/// What a decoder makes of a file, told by its first bytes.
inline Picture read_picture(const std::string& file) {
  codec::ImageRequest request;
  request.bytes = bytes_of(file);
  request.pixels = true;
  Picture picture{0, 0, {}, file, "image/png"};
  if (file.starts_with("\xff\xd8")) {
    request.format = codec::ImageFormat::jpeg;
    picture.mime = "image/jpeg";
  } else if (file.starts_with("RIFF")) {
    request.format = codec::ImageFormat::webp;
    picture.mime = "image/webp";
  }
  const codec::ImageResult result = codec::Client::shared().decode_image(request);
  const auto* image = std::get_if<codec::Image>(&result);
  EXPECT_NE(image, nullptr);
  if (image == nullptr) return picture;
  picture.width = image->width;
  picture.height = image->height;
  const auto value = [&](std::size_t at) {
    std::uint16_t wide = 0;
    if (image->bits != 16) return static_cast<double>(image->pixels[at]) / 255;
    std::memcpy(&wide, image->pixels.data() + at * 2, 2);
    return wide / 65535.0;
  };
  for (std::size_t i = 0; i < image->texels(); ++i) {
    const std::size_t at = i * image->channels;
    const bool grey = image->channels < 3;
    const double alpha = image->has_alpha() ? value(at + image->channels - 1) : 1;
    picture.texels.push_back(
        {value(at), value(grey ? at : at + 1), value(grey ? at : at + 2), alpha});
  }
  return picture;
}

/// A PNG of random values, or of one that is everywhere the same.
inline Picture png_picture(Random& random, PngColor color, unsigned bits, int constant = -1) {
  constexpr std::uint32_t kWidth = 8, kHeight = 4;
  Picture picture{kWidth, kHeight, {}, {}, "image/png"};
  PngImage file{kWidth, kHeight, color, static_cast<char>(bits), {}, {}, false};
  const std::uint32_t full = (1U << bits) - 1;
  std::vector<Texel> palette;
  if (color == PngColor::palette) {
    std::string colors, alphas;
    for (std::uint32_t i = 0; i <= full; ++i) {
      Texel entry{};
      for (std::size_t c = 0; c < 4; ++c) {
        const std::uint32_t value = random.below(256);
        (c < 3 ? colors : alphas) += static_cast<char>(value);
        entry[c] = value / 255.0;
      }
      palette.push_back(entry);
    }
    file.chunks = png_encoder::chunk("PLTE", colors) + png_encoder::chunk("tRNS", alphas);
  }
  const std::size_t channels = color == PngColor::rgb          ? 3
                               : color == PngColor::rgba       ? 4
                               : color == PngColor::grey_alpha ? 2
                                                               : 1;
  unsigned pending = 0, filled = 0;
  for (std::size_t i = 0; i < kWidth * kHeight; ++i) {
    std::array<std::uint32_t, 4> values{};
    for (std::size_t c = 0; c < channels; ++c) {
      values[c] = constant >= 0 ? static_cast<std::uint32_t>(constant) : random.below(full + 1);
      if (bits == 16) file.texels += static_cast<char>(values[c] >> 8U);
      if (bits >= 8) {
        file.texels += static_cast<char>(values[c] & 0xFFU);
        continue;
      }
      pending = pending << bits | values[c];
      filled += bits;
      if (filled < 8) continue;
      file.texels += static_cast<char>(pending);
      pending = filled = 0;
    }
    const auto share = [&](std::size_t c) { return values[c] / static_cast<double>(full); };
    if (!palette.empty()) {
      picture.texels.push_back(palette[values[0]]);
    } else if (channels < 3) {
      picture.texels.push_back({share(0), share(0), share(0), channels == 2 ? share(1) : 1});
    } else {
      picture.texels.push_back({share(0), share(1), share(2), channels == 4 ? share(3) : 1});
    }
  }
  picture.bytes = encode_png(file);
  return picture;
}

inline Picture encoded_picture(Random& random, codec::EncodedFormat format, std::uint32_t channels,
                               std::uint32_t quality) {
  codec::EncodeRequest request;
  request.format = format;
  request.raster = {16, 8, channels, 8};
  request.quality = quality;
  std::string pixels;
  for (std::size_t i = 0; i < std::size_t{16} * 8 * channels; ++i) {
    pixels += static_cast<char>(random.below(256));
  }
  request.pixels = bytes_of(pixels);
  const codec::EncodeResult result = codec::Client::shared().encode_image(request);
  const auto* file = std::get_if<codec::EncodedImage>(&result);
  EXPECT_NE(file, nullptr);
  if (file == nullptr) return {};
  return read_picture({reinterpret_cast<const char*>(file->bytes.data()), file->bytes.size()});
}

/// One of every form, and two that are the same everywhere.
inline std::vector<Picture> all_pictures(Random& random) {
  std::vector<Picture> pictures;
  for (const unsigned bits : {1U, 2U, 4U, 8U, 16U}) {
    pictures.push_back(png_picture(random, PngColor::grey, bits));
    if (bits < 16) pictures.push_back(png_picture(random, PngColor::palette, bits));
    if (bits < 8) continue;
    for (const PngColor color : {PngColor::grey_alpha, PngColor::rgb, PngColor::rgba}) {
      pictures.push_back(png_picture(random, color, bits));
    }
  }
  pictures.push_back(png_picture(random, PngColor::rgba, 8, 255));
  pictures.push_back(png_picture(random, PngColor::rgb, 8, 100));
  pictures.push_back(encoded_picture(random, codec::EncodedFormat::jpeg, 1, 80));
  pictures.push_back(encoded_picture(random, codec::EncodedFormat::jpeg, 3, 80));
  pictures.push_back(encoded_picture(random, codec::EncodedFormat::webp, 3, 80));
  pictures.push_back(encoded_picture(random, codec::EncodedFormat::webp, 4, 0));
  return pictures;
}

/// Documents with such pictures and materials of one generation of the legacy extension.
class LegacyScene {
 public:
  LegacyScene(Random& random, const std::vector<Picture>& pictures, bool first_generation)
      : random_(random), first_(first_generation) {
    json_ = {{"asset", {{"version", "2.0"}}},
             {"extensionsUsed",
              {"KHR_materials_translucency", "KHR_texture_transform", "EXT_texture_webp"}}};
    json_["samplers"] = {{{"wrapS", 33071}, {"wrapT", 10497}},
                         {{"wrapS", 33648}, {"wrapT", 33071}}};
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      json_["images"].push_back({{"uri", "data:" + pictures[i].mime + ";base64," +
                                             container::encode_base64(pictures[i].bytes)}});
      Json texture{{"source", i}};
      if (pictures[i].mime == "image/webp") {
        texture = {{"extensions", {{"EXT_texture_webp", {{"source", i}}}}}};
      }
      if (!random_.one_in(3)) texture["sampler"] = random_.below(2);
      json_["textures"].push_back(texture);
    }
  }
  void add_material() {
    Json base{{"metallicFactor", random_.one_in(4) ? 0 : random_.share()},
              {"roughnessFactor", random_.between(0.2, 1)}};
    if (!random_.one_in(5)) {
      base["baseColorFactor"] = {random_.share(), random_.share(), random_.share(), 1};
    }
    if (!random_.one_in(3)) base["baseColorTexture"] = texture_info();
    Json legacy = Json::object();
    if (!random_.one_in(12)) {
      legacy["translucencyFactor"] = random_.one_in(12) ? 0 : random_.share();
    }
    if (!random_.one_in(4)) legacy["translucencyTexture"] = texture_info();
    if (!first_) {
      legacy["translucencyColorFactor"] = {random_.share(), random_.share(), random_.share()};
      if (!random_.one_in(2)) legacy["translucencyColorTexture"] = texture_info();
    }
    json_["materials"].push_back(
        {{"pbrMetallicRoughness", base}, {"extensions", {{"KHR_materials_translucency", legacy}}}});
  }
  const Json& json() const { return json_; }

 private:
  Json texture_info() {
    Json info{{"index", random_.below(static_cast<std::uint32_t>(json_["textures"].size()))}};
    if (random_.one_in(2)) info["texCoord"] = 1;
    if (random_.one_in(2)) {
      Json transform{{"offset", {random_.between(-1, 1), random_.between(-1, 1)}}};
      if (random_.one_in(2)) transform["rotation"] = random_.between(-3, 3);
      if (random_.one_in(2))
        transform["scale"] = {random_.between(.5, 2), random_.between(-2, -.5)};
      if (random_.one_in(3)) transform["texCoord"] = random_.below(2);
      info["extensions"]["KHR_texture_transform"] = transform;
    }
    return info;
  }

  Random& random_;
  bool first_;
  Json json_;
};

}  // namespace gltfx::test
