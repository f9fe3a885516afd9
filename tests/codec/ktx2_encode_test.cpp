// SPDX-License-Identifier: Apache-2.0
/// KTX2 files that the worker encodes as UASTC, decoded by the worker: tests/codec/basis compares
/// them with those of another encoder, and their texels with those of another decoder.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/client.hpp"
#include "codec/support/results.hpp"
#include "image/ktx2.hpp"

namespace gltfx::codec {
namespace {

using test::png_file;
using testing::IsEmpty;

// Red, green, blue and alpha, 0 to 1.
using Color = std::array<double, 4>;
using Paint = std::function<Color(double x, double y)>;

std::vector<std::byte> painted(const Raster& raster, const Paint& paint) {
  std::vector<std::byte> texels;
  for (std::uint32_t y = 0; y < raster.height; ++y) {
    for (std::uint32_t x = 0; x < raster.width; ++x) {
      const Color color = paint((x + 0.5) / raster.width, (y + 0.5) / raster.height);
      for (std::size_t c = 0; c < raster.channels; ++c) {
        const double value = std::clamp(color[raster.channels == 2 && c == 1 ? 3 : c], 0.0, 1.0);
        texels.push_back(static_cast<std::byte>(std::lround(value * 255)));
      }
    }
  }
  return texels;
}

double waves(double x, double y, double f) {
  return std::sin(f * x + 3 * y) * std::cos(f * y - 2 * x * y) / 2 + 0.5;
}
// The same for the same place.
double noise(double x, double y) {
  const double value = std::sin(x * 12989.8 + y * 78233.7) * 43758.5453;
  return value - std::floor(value);
}

Color photo(double x, double y) {
  const double grain = noise(x, y) * 0.06;
  return {waves(x, y, 17) * 0.8 + grain, waves(y, x, 23) * 0.9 + grain,
          waves(x + y, y, 9) * 0.6 + 0.2 + grain, 1};
}
Color flat(double x, double y) {
  return waves(x, y, 9) > 0.5 ? Color{0.8, 0.2, 0.1, 1} : Color{0.1, 0.5, 0.9, 1};
}
Color normal(double x, double y) {
  const double a = std::cos(60 * x) * 0.4 + std::sin(23 * y) * 0.2;
  const double b = std::sin(50 * y) * 0.4;
  const double length = std::hypot(a, b, 1.0);
  return {a / length / 2 + 0.5, b / length / 2 + 0.5, 0.5 / length + 0.5, 1};
}
Color data(double x, double y) {
  return {0.7 + 0.3 * waves(x, y, 6), waves(y, x, 31), waves(x, y, 12) > 0.6 ? 1.0 : 0.0, 1};
}
Color leaf(double x, double y) {
  const double edge = (waves(x, y, 25) - 0.5) * 20;
  return {0.2 + 0.1 * waves(y, x, 9), 0.4 + 0.3 * waves(x, y, 13), 0.1, edge};
}

TranscodeRequest to_ktx2(const std::vector<std::byte>& png, TexelKind kind) {
  TranscodeRequest request;
  request.image.bytes = png;
  request.image.max_pixels = 1U << 22U;
  request.image.resize.kind = kind;
  request.format = EncodedFormat::ktx2;
  return request;
}

EncodedImage ktx2_of(const TranscodeRequest& request) {
  return test::value_of(Client::shared().transcode_image(request));
}

Image level_of(const EncodedImage& file, std::uint32_t level = 0) {
  ImageRequest request;
  request.bytes = file.bytes;
  request.format = ImageFormat::ktx2;
  request.level = level;
  request.pixels = true;
  return test::value_of(Client::shared().decode_image(request));
}

double mean_of(const Image& image, std::size_t channel) {
  double sum = 0;
  for (std::size_t i = channel; i < image.pixels.size(); i += image.channels) {
    sum += static_cast<double>(image.pixels[i]);
  }
  return sum / static_cast<double>(image.texels());
}

double greatest_of(const std::vector<std::byte>& texels, const Image& image) {
  EXPECT_EQ(texels.size(), image.pixels.size());
  int greatest = 0;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    greatest = std::max(greatest,
                        std::abs(static_cast<int>(texels[i]) - static_cast<int>(image.pixels[i])));
  }
  return greatest;
}

TEST(Ktx2Encoder, KeepsQualityByClass) {
  struct Case {
    const char* name;
    Paint paint;
    TexelKind kind;
    std::uint32_t channels;
    double least_decibels;
  };
  const std::vector<Case> cases{
      {"photo", photo, TexelKind::color, 3, 36},        {"flat", flat, TexelKind::color, 3, 60},
      {"normal", normal, TexelKind::normal, 3, 38.5},   {"data", data, TexelKind::data, 3, 44.5},
      {"leaf", leaf, TexelKind::color, 4, 45},          {"grey", photo, TexelKind::data, 1, 51},
      {"grey and alpha", leaf, TexelKind::color, 2, 50}};
  for (const Case& one : cases) {
    const Raster raster{128, 128, one.channels, 8};
    const std::vector<std::byte> png = png_file(raster, painted(raster, one.paint));
    const EncodedImage file = ktx2_of(to_ktx2(png, one.kind));
    ASSERT_TRUE(file.distance);
    EXPECT_GE(file.distance->decibels(), one.least_decibels) << one.name;
    EXPECT_EQ(file.distance->angle.has_value(), one.kind == TexelKind::normal) << one.name;
    if (file.distance->angle) {
      EXPECT_LT(*file.distance->angle, 4.5) << one.name;
    }
  }
}

TEST(Ktx2Encoder, StatesTheDistanceOfItsTexels) {
  const Raster raster{64, 64, 3, 8};
  const std::vector<std::byte> texels = painted(raster, photo);
  const EncodedImage file = ktx2_of(to_ktx2(png_file(raster, texels), TexelKind::color));
  const Image image = level_of(file);
  double squares = 0;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const double off = static_cast<double>(texels[i]) - static_cast<double>(image.pixels[i]);
    squares += off * off;
  }
  ASSERT_TRUE(file.distance);
  EXPECT_DOUBLE_EQ(file.distance->mean_square, squares / static_cast<double>(texels.size()));
  EXPECT_EQ(file.distance->greatest, greatest_of(texels, image));
}

// One colour in each block, also with alpha.
TEST(Ktx2Encoder, KeepsBlocksOfOneColour) {
  const Raster raster{64, 64, 4, 8};
  const auto patches = [](double x, double y) {
    const double block = std::floor(x * 16) + 16 * std::floor(y * 16);
    return Color{noise(block, 1), noise(block, 2), noise(block, 3), noise(block, 4)};
  };
  const std::vector<std::byte> texels = painted(raster, patches);
  const Image image = level_of(ktx2_of(to_ktx2(png_file(raster, texels), TexelKind::color)));
  EXPECT_EQ(greatest_of(texels, image), 0);
}

TEST(Ktx2Encoder, KeepsTheEdgesOfAMask) {
  const Raster raster{64, 64, 4, 8};
  const auto mask = [](double x, double y) {
    return Color{0.3, 0.6, 0.1, std::hypot(x - 0.5, y - 0.5) < 0.4 ? 1.0 : 0.0};
  };
  const std::vector<std::byte> texels = painted(raster, mask);
  const Image image = level_of(ktx2_of(to_ktx2(png_file(raster, texels), TexelKind::color)));
  EXPECT_LE(greatest_of(texels, image), 1);
}

TEST(Ktx2Encoder, MakesSidesMultiplesOfFour) {
  struct Case {
    std::uint32_t width, height, most, new_width, new_height;
  };
  for (const Case& one :
       {Case{1, 1, 0, 4, 4}, Case{3, 5, 0, 4, 4}, Case{4, 4, 0, 4, 4}, Case{30, 17, 0, 32, 16},
        Case{6, 100, 0, 8, 100}, Case{100, 60, 50, 48, 32}, Case{9, 2, 3, 4, 4}}) {
    const Raster raster{one.width, one.height, 3, 8};
    TranscodeRequest request;
    const std::vector<std::byte> png = png_file(raster, painted(raster, photo));
    request = to_ktx2(png, TexelKind::color);
    request.image.resize.max_side = one.most;
    const EncodedImage file = ktx2_of(request);
    EXPECT_EQ(file.source, raster);
    EXPECT_EQ(file.raster, (Raster{one.new_width, one.new_height, 3, 8}));
    const image::Ktx2 header = image::read_ktx2(file.bytes);
    EXPECT_EQ(header.level_count, header.full_pyramid());
    for (std::uint32_t level = 0; level < header.level_count; ++level) {
      const Image image = level_of(file, level);
      EXPECT_EQ(image.width, image::level_extent(one.new_width, level));
      EXPECT_EQ(image.height, image::level_extent(one.new_height, level));
    }
  }
}

TEST(Ktx2Encoder, EnlargesWithoutNewColours) {
  const Raster raster{3, 5, 3, 8};
  const std::vector<std::byte> texels = painted(raster, [](double x, double) {
    return Color{x < 0.5 ? 0.2 : 0.8, 0.4, 0.6, 1};
  });
  const Image image = level_of(ktx2_of(to_ktx2(png_file(raster, texels), TexelKind::data)));
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    EXPECT_GE(static_cast<int>(image.pixels[i]), 50);
    EXPECT_LE(static_cast<int>(image.pixels[i]), 205);
    EXPECT_NEAR(static_cast<int>(image.pixels[i + 1]), 102, 1);
    EXPECT_NEAR(static_cast<int>(image.pixels[i + 2]), 153, 1);
  }
}

TEST(Ktx2Encoder, DescribesTheTexels) {
  for (const TexelKind kind : {TexelKind::color, TexelKind::normal, TexelKind::data}) {
    for (std::uint32_t channels = 1; channels <= 4; ++channels) {
      const Raster raster{20, 12, channels, 8};
      const std::vector<std::byte> png = png_file(raster, painted(raster, leaf));
      const EncodedImage encoded = ktx2_of(to_ktx2(png, kind));
      const image::Ktx2 file = image::read_ktx2(encoded.bytes);
      EXPECT_THAT(file.errors, IsEmpty());
      EXPECT_TRUE(image::has_known_texels(file));
      EXPECT_EQ(file.model, image::Ktx2Model::uastc);
      EXPECT_EQ(file.scheme, static_cast<std::uint32_t>(image::Ktx2Scheme::zstd));
      const bool color = kind == TexelKind::color;
      EXPECT_EQ(file.transfer, color ? image::kKtx2TransferSrgb : image::kKtx2TransferLinear);
      EXPECT_EQ(file.primaries, color ? image::kKtx2PrimariesBt709 : 0);
      EXPECT_EQ(file.contents, channels % 2 == 0 ? image::Channels::rgba : image::Channels::rgb);
      EXPECT_EQ(level_of(encoded).channels, encoded.raster.channels);
    }
  }
}

TEST(Ktx2Encoder, DropsAnOpaqueAlpha) {
  const Raster raster{16, 16, 4, 8};
  const std::vector<std::byte> png = png_file(raster, painted(raster, photo));
  EXPECT_EQ(ktx2_of(to_ktx2(png, TexelKind::color)).raster.channels, 3U);
}

TEST(Ktx2Encoder, ReducesSixteenBits) {
  const Raster raster{16, 16, 3, 16};
  std::vector<std::byte> texels;
  for (const std::byte value : painted({16, 16, 3, 8}, photo))
    texels.insert(texels.end(), 2, value);
  const EncodedImage file = ktx2_of(to_ktx2(png_file(raster, texels), TexelKind::data));
  EXPECT_EQ(file.source.bits, 16U);
  EXPECT_EQ(file.raster.bits, 8U);
}

// Black and white in equal parts.
TEST(Ktx2Encoder, AveragesLevelsByKind) {
  const Raster raster{64, 64, 3, 8};
  const auto checkers = [](double x, double y) {
    const double value = (std::lround(x * 64 - 0.5) + std::lround(y * 64 - 0.5)) % 2 == 0 ? 1 : 0;
    return Color{value, value, value, 1};
  };
  const std::vector<std::byte> png = png_file(raster, painted(raster, checkers));
  EXPECT_NEAR(mean_of(level_of(ktx2_of(to_ktx2(png, TexelKind::color)), 6), 0), 188, 1);
  EXPECT_NEAR(mean_of(level_of(ktx2_of(to_ktx2(png, TexelKind::data)), 6), 0), 128, 1);
  const std::vector<std::byte> bumps = png_file(raster, painted(raster, normal));
  const EncodedImage normals = ktx2_of(to_ktx2(bumps, TexelKind::normal));
  for (const std::uint32_t level : {1U, 3U, 6U}) {
    const Image image = level_of(normals, level);
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
      double square = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double value = static_cast<double>(image.pixels[i + c]) / 127.5 - 1;
        square += value * value;
      }
      EXPECT_NEAR(std::sqrt(square), 1, 0.08) << level;
    }
  }
}

TEST(Ktx2Encoder, KeepsTheCoverageOfAMaskInAllLevels) {
  const Raster raster{128, 128, 4, 8};
  const auto dots = [](double x, double y) {
    return Color{0.5, 0.5, 0.5, noise(x, y) < 0.3 ? 1.0 : 0.0};
  };
  const std::vector<std::byte> png = png_file(raster, painted(raster, dots));
  TranscodeRequest request = to_ktx2(png, TexelKind::color);
  request.image.resize.weigh_alpha = true;
  request.image.resize.alpha_cutoff = 0.5F;
  const EncodedImage file = ktx2_of(request);
  for (const std::uint32_t level : {1U, 2U, 3U}) {
    const Image image = level_of(file, level);
    double shown = 0;
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) {
      if (static_cast<double>(image.pixels[i]) >= 127.5) ++shown;
    }
    EXPECT_NEAR(shown / static_cast<double>(image.texels()), 0.3, 0.03) << level;
  }
}

TEST(Ktx2Encoder, GivesTheSameBytesAgain) {
  const Raster raster{40, 24, 4, 8};
  const std::vector<std::byte> png = png_file(raster, painted(raster, leaf));
  const EncodedImage first = ktx2_of(to_ktx2(png, TexelKind::color));
  const EncodedImage second = ktx2_of(to_ktx2(png, TexelKind::color));
  EXPECT_TRUE(
      std::equal(first.bytes.begin(), first.bytes.end(), second.bytes.begin(), second.bytes.end()));
}

}  // namespace
}  // namespace gltfx::codec
