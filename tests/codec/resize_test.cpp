// SPDX-License-Identifier: Apache-2.0
/// Images that the worker makes smaller: decoded from PNG, and checked according to their texel
/// kind.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/client.hpp"
#include "codec/support/results.hpp"

namespace gltfx::codec {
namespace {

/// Texels of 8 or 16 bits as numbers.
struct Picture {
  Raster raster;
  std::vector<unsigned> values;

  unsigned at(std::uint32_t x, std::uint32_t y, std::uint32_t c) const {
    return values[(std::size_t{y} * raster.width + x) * raster.channels + c];
  }
  std::size_t texels() const { return values.size() / raster.channels; }
};

using Paint = std::function<std::vector<unsigned>(std::uint32_t x, std::uint32_t y)>;

Picture paint(const Raster& raster, const Paint& texel) {
  Picture picture{raster, {}};
  for (std::uint32_t y = 0; y < raster.height; ++y) {
    for (std::uint32_t x = 0; x < raster.width; ++x) {
      const std::vector<unsigned> values = texel(x, y);
      picture.values.insert(picture.values.end(), values.begin(), values.end());
    }
  }
  return picture;
}

std::vector<std::byte> png_of(const Picture& picture) {
  std::vector<std::byte> bytes;
  for (const unsigned value : picture.values) {
    bytes.push_back(static_cast<std::byte>(value));
    if (picture.raster.bits == 16) bytes.push_back(static_cast<std::byte>(value >> 8U));
  }
  return test::png_file(picture.raster, bytes);
}

Picture picture_of(const ImageResult& result) {
  const Image image = test::value_of(result);
  Picture picture{{image.width, image.height, image.channels, image.bits}, {}};
  const std::size_t size = image.bits / 8;
  for (std::size_t i = 0; i < image.pixels.size(); i += size) {
    unsigned value = 0;
    std::memcpy(&value, image.pixels.data() + i, size);
    picture.values.push_back(value);
  }
  return picture;
}

Picture shrunk(const Picture& picture, const Resize& how) {
  const std::vector<std::byte> file = png_of(picture);
  ImageRequest request;
  request.bytes = file;
  request.pixels = true;
  request.resize = how;
  return picture_of(Client::shared().decode_image(request));
}

Resize to_side(std::uint32_t side, TexelKind kind) {
  Resize how;
  how.max_side = side;
  how.kind = kind;
  return how;
}

double light_of(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

double mean_light(const Picture& picture, std::uint32_t channel = 0) {
  double sum = 0;
  for (std::size_t i = channel; i < picture.values.size(); i += picture.raster.channels) {
    sum += light_of(picture.values[i] / (picture.raster.bits == 16 ? 65535.0 : 255.0));
  }
  return sum / static_cast<double>(picture.texels());
}

double coverage(const Picture& picture, unsigned least) {
  std::size_t shown = 0;
  for (std::size_t i = 3; i < picture.values.size(); i += 4) shown += picture.values[i] >= least;
  return static_cast<double>(shown) / static_cast<double>(picture.texels());
}

std::vector<unsigned> checker(std::uint32_t x, std::uint32_t y) {
  const unsigned value = (x + y) % 2 == 0 ? 255 : 0;
  return {value, value, value};
}

TEST(Resize, AColourKeepsItsLight) {
  for (const std::uint32_t side : {64U, 50U, 33U, 7U, 1U}) {
    const Picture small = shrunk(paint({128, 128, 3, 8}, checker), to_side(side, TexelKind::color));
    EXPECT_EQ(small.raster.width, side);
    EXPECT_NEAR(mean_light(small), 0.5, 0.01) << side;
  }
  const Picture data = shrunk(paint({128, 128, 3, 8}, checker), to_side(64, TexelKind::data));
  EXPECT_NEAR(data.at(5, 5, 0), 128, 1) << "numbers are averaged as they are";
}

TEST(Resize, SixteenBitsStaySixteen) {
  const Picture source = paint({64, 64, 4, 16}, [](auto x, auto y) {
    const unsigned value = (x + y) % 2 == 0 ? 65535 : 0;
    return std::vector<unsigned>{value, 300, value, 65535};
  });
  const Picture small = shrunk(source, to_side(16, TexelKind::color));
  EXPECT_EQ(small.raster.bits, 16U);
  EXPECT_NEAR(mean_light(small), 0.5, 0.001);
  EXPECT_NEAR(small.at(3, 3, 1), 300, 1);
  EXPECT_EQ(small.at(3, 3, 3), 65535U);
}

TEST(Resize, NormalsAreUnitVectors) {
  const Picture bumps = paint({96, 96, 3, 8}, [](auto x, auto y) {
    const double u = std::sin(x * 0.9) * 0.8;
    const double v = std::cos(y * 1.3) * 0.55;
    const double w = std::sqrt(1 - u * u - v * v);
    const auto byte = [](double c) {
      return static_cast<unsigned>(std::lround(c * 127.5 + 127.5));
    };
    return std::vector<unsigned>{byte(u), byte(v), byte(w)};
  });
  const Picture small = shrunk(bumps, to_side(24, TexelKind::normal));
  for (std::uint32_t y = 0; y < 24; ++y) {
    for (std::uint32_t x = 0; x < 24; ++x) {
      double sum = 0;
      for (std::uint32_t c = 0; c < 3; ++c) sum += std::pow(small.at(x, y, c) / 127.5 - 1, 2);
      ASSERT_NEAR(std::sqrt(sum), 1, 0.01) << x << ' ' << y;
    }
  }
}

TEST(Resize, AMaskCoversAsMuch) {
  // Single lines, whose averages are all below the cutoff.
  const Picture lines = paint({200, 200, 4, 8}, [](auto x, auto) {
    return std::vector<unsigned>{200, 100, 50, x % 10 < 3 ? 255U : 0U};
  });
  const Picture noise = paint({256, 128, 4, 8}, [](auto x, auto y) {
    const std::uint32_t hash = (x * 73856093U ^ y * 19349663U) * 2654435761U;
    return std::vector<unsigned>{9, 99, 199, hash >> 24U};
  });
  for (const float cutoff : {0.1F, 0.5F, 0.9F}) {
    for (const Picture* picture : {&lines, &noise}) {
      Resize how = to_side(50, TexelKind::color);
      how.weigh_alpha = true;
      how.alpha_cutoff = cutoff;
      const auto least = static_cast<unsigned>(std::ceil(cutoff * 255));
      EXPECT_NEAR(coverage(shrunk(*picture, how), least), coverage(*picture, least), 0.01)
          << cutoff;
    }
  }
}

TEST(Resize, TransparentTexelsDoNotDarkenOthers) {
  const Picture leaf = paint({64, 64, 4, 8}, [](auto x, auto) {
    return x < 21 ? std::vector<unsigned>{250, 120, 60, 255} : std::vector<unsigned>{0, 0, 0, 0};
  });
  Resize how = to_side(16, TexelKind::color);
  how.wrap_u = Wrap::clamp;
  how.weigh_alpha = true;
  const Picture small = shrunk(leaf, how);
  EXPECT_EQ(small.at(15, 8, 3), 0U);
  for (std::uint32_t x = 0; x < 16; ++x) {
    EXPECT_NEAR(small.at(x, 8, 0), 250, 1) << x << ": filled where there is no alpha";
    EXPECT_NEAR(small.at(x, 8, 2), 60, 1) << x;
  }
  how.weigh_alpha = false;
  EXPECT_EQ(shrunk(leaf, how).at(15, 8, 0), 0U) << "channels by themselves";
}

TEST(Resize, NothingRings) {
  const Picture edge = paint(
      {64, 8, 1, 8}, [](auto x, auto) { return std::vector<unsigned>{x < 32 ? 100U : 180U}; });
  const Picture small = shrunk(edge, to_side(21, TexelKind::data));
  const auto [least, greatest] = std::minmax_element(small.values.begin(), small.values.end());
  EXPECT_EQ(*least, 100U);
  EXPECT_EQ(*greatest, 180U);
}

// A black image whose last column and last row are white.
Picture bordered() {
  return paint({32, 32, 1, 8}, [](auto x, auto y) {
    return std::vector<unsigned>{x == 31 || y == 31 ? 255U : 0U};
  });
}

TEST(Resize, BordersAreThoseOfTheSampler) {
  const auto first = [](Wrap u, Wrap v) {
    Resize how = to_side(16, TexelKind::data);
    how.wrap_u = u;
    how.wrap_v = v;
    const Picture small = shrunk(bordered(), how);
    return std::pair(small.at(0, 8, 0), small.at(8, 0, 0));
  };
  EXPECT_GT(first(Wrap::repeat, Wrap::clamp).first, 5U) << "the last column is left of the first";
  EXPECT_EQ(first(Wrap::repeat, Wrap::clamp).second, 0U);
  EXPECT_EQ(first(Wrap::clamp, Wrap::repeat).first, 0U);
  EXPECT_GT(first(Wrap::clamp, Wrap::repeat).second, 5U);
  EXPECT_EQ(first(Wrap::mirror, Wrap::mirror).first, 0U);
}

TEST(Resize, MirroredBordersAreSymmetric) {
  const Picture ramp =
      paint({8, 1, 1, 8}, [](auto x, auto) { return std::vector<unsigned>{x * 20}; });
  Resize how = to_side(4, TexelKind::data);
  how.wrap_u = Wrap::mirror;
  const Picture small = shrunk(ramp, how);
  EXPECT_NEAR(small.at(0, 0, 0), 11, 1);
  EXPECT_NEAR(small.at(0, 0, 0) + small.at(3, 0, 0), 140, 1);
  EXPECT_NEAR(small.at(1, 0, 0) + small.at(2, 0, 0), 140, 1);
}

TEST(Resize, SizesKeepTheAspectAndAreNeverLarger) {
  const auto size = [](std::uint32_t width, std::uint32_t height, std::uint32_t side) {
    const Picture grey =
        paint({width, height, 1, 8}, [](auto, auto) { return std::vector<unsigned>{77}; });
    const Picture small = shrunk(grey, to_side(side, TexelKind::data));
    EXPECT_THAT(small.values, testing::Each(77U));
    return std::pair(small.raster.width, small.raster.height);
  };
  EXPECT_EQ(size(10, 6, 10), std::pair(10U, 6U));
  EXPECT_EQ(size(10, 6, 4000), std::pair(10U, 6U));
  EXPECT_EQ(size(101, 37, 50), std::pair(50U, 18U));
  EXPECT_EQ(size(37, 101, 50), std::pair(18U, 50U));
  EXPECT_EQ(size(300, 1, 7), std::pair(7U, 1U)) << "a side of one texel";
  EXPECT_EQ(size(1, 300, 1), std::pair(1U, 1U));
  EXPECT_EQ(size(3, 3, 2), std::pair(2U, 2U));
}

TEST(Resize, FloatsStayFloats) {
  std::vector<float> light;
  for (unsigned i = 0; i < 16 * 8; ++i) light.insert(light.end(), {i % 2 == 0 ? 30.0F : 10, 7, 0});
  const auto bytes = std::as_bytes(std::span(light));
  const auto encoded = Client::shared().encode_image(
      {EncodedFormat::exr, Raster{16, 8, 3, 32}, 0, {bytes.data(), bytes.size()}});
  ASSERT_TRUE(std::holds_alternative<EncodedImage>(encoded));
  ImageRequest request;
  request.bytes = std::get<EncodedImage>(encoded).bytes;
  request.format = ImageFormat::openexr;
  request.pixels = true;
  request.resize = to_side(8, TexelKind::color);
  const ImageResult result = Client::shared().decode_image(request);
  ASSERT_TRUE(std::holds_alternative<Image>(result));
  const Image& image = std::get<Image>(result);
  ASSERT_EQ(image.bits, 32U);
  ASSERT_EQ(image.pixels.size(), std::size_t{8} * 4 * 3 * 4);
  std::array<float, 3> texel{};
  std::memcpy(texel.data(), image.pixels.data() + 12 * 9, sizeof texel);
  EXPECT_NEAR(texel[0], 20, 0.001) << "light is averaged as it is";
  EXPECT_EQ(texel[1], 7);
}

// Floats in an EXR file, made smaller.
std::vector<float> shrunk_floats(const Raster& raster, const std::vector<float>& values,
                                 const Resize& how) {
  const auto bytes = std::as_bytes(std::span(values));
  const EncodedImage file = test::value_of(
      Client::shared().encode_image({EncodedFormat::exr, raster, 0, {bytes.data(), bytes.size()}}));
  ImageRequest request;
  request.bytes = file.bytes;
  request.format = ImageFormat::openexr;
  request.pixels = true;
  request.resize = how;
  const Image image = test::value_of(Client::shared().decode_image(request));
  std::vector<float> small(image.pixels.size() / sizeof(float));
  if (!small.empty()) std::memcpy(small.data(), image.pixels.data(), small.size() * sizeof(float));
  return small;
}

// Floats may be no numbers, or beyond 1.
TEST(Resize, AnAlphaThatIsNoNumberIsZero) {
  constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  constexpr std::array<float, 8> kAlphas{kNoNumber, 1, 0.25F, kInfinite, -kInfinite, -2, 3, 0.75F};
  std::vector<float> values;
  for (unsigned i = 0; i < 32 * 32; ++i) {
    const float alpha = kAlphas[(i / 2 + i / 64) % kAlphas.size()];
    values.insert(values.end(), {alpha, 2, 3, alpha});
  }
  for (const bool weighs : {false, true}) {
    Resize how = to_side(16, TexelKind::color);
    how.weigh_alpha = weighs;
    how.alpha_cutoff = 0.5F;
    const std::vector<float> small = shrunk_floats({32, 32, 4, 32}, values, how);
    ASSERT_EQ(small.size(), std::size_t{16} * 16 * 4);
    std::size_t shown = 0;
    for (std::size_t i = 0; i < small.size(); i += 4) {
      EXPECT_TRUE(small[i + 3] >= 0 && small[i + 3] <= 1) << small[i + 3];
      if (small[i + 3] >= 0.5F) ++shown;
    }
    EXPECT_EQ(shown, 128U) << "half of the texels, as before";
  }
}

TEST(Resize, ColoursThatAreNoNumbersStayThat) {
  const std::vector<float> values(std::size_t{16} * 16 * 3,
                                  std::numeric_limits<float>::quiet_NaN());
  const std::vector<float> small =
      shrunk_floats({16, 16, 3, 32}, values, to_side(4, TexelKind::color));
  ASSERT_EQ(small.size(), 48U);
  EXPECT_TRUE(std::all_of(small.begin(), small.end(), [](float each) { return each != each; }));
}

// Whichever worker decodes the image.
TEST(Resize, ACutoffIsANumber) {
  const std::vector<std::byte> file = png_of(paint({8, 8, 3, 8}, checker));
  ImageRequest request;
  request.bytes = file;
  request.pixels = true;
  request.resize = to_side(4, TexelKind::color);
  request.resize.alpha_cutoff = std::numeric_limits<float>::quiet_NaN();
  for (const ImageFormat format : {ImageFormat::png, ImageFormat::avif, ImageFormat::tga}) {
    request.format = format;
    const ImageResult result = Client::shared().decode_image(request);
    ASSERT_TRUE(std::holds_alternative<DecodeError>(result));
    EXPECT_EQ(std::get<DecodeError>(result).kind, ErrorKind::malformed);
    EXPECT_EQ(std::get<DecodeError>(result).message, "The alpha cutoff is not a number.");
  }
}

TEST(Resize, StatisticsAreThoseOfTheResult) {
  const std::vector<std::byte> file = png_of(paint({64, 64, 3, 8}, checker));
  ImageRequest request;
  request.bytes = file;
  request.pixels = true;
  request.resize = to_side(32, TexelKind::data);
  const ImageResult result = Client::shared().decode_image(request);
  ASSERT_TRUE(std::holds_alternative<Image>(result));
  EXPECT_LE(std::get<Image>(result).statistics[0].greatest, 129U);
  EXPECT_TRUE(std::get<Image>(result).grey);
}

}  // namespace
}  // namespace gltfx::codec
