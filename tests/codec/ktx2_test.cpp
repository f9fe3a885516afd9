// SPDX-License-Identifier: Apache-2.0
/// KTX2 images of ETC1S and UASTC through the worker, compared with the output of Binomial's
/// transcoder: tests/codec/basis/README.md has the sources of the files.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/client.hpp"
#include "codec/support/results.hpp"
#include "sanitized.hpp"

namespace gltfx::codec {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kFiles = fs::path(GLTFX_SOURCE_DIR) / "tests/codec/basis";

std::string file_content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

ImageResult decode_ktx2_file(const std::string& bytes, bool pixels, std::uint32_t level = 0,
                             ImageFormat format = ImageFormat::ktx2) {
  ImageRequest request;
  request.bytes = std::as_bytes(std::span(bytes.data(), bytes.size()));
  request.format = format;
  request.level = level;
  request.pixels = pixels;
  request.max_pixels = 1U << 20U;
  return Client::shared().decode_image(request);
}

Image ktx2_image(const std::string& bytes, std::uint32_t level = 0,
                 ImageFormat format = ImageFormat::ktx2) {
  return test::value_of(decode_ktx2_file(bytes, true, level, format));
}

DecodeError ktx2_error(const std::string& bytes, bool pixels = true, std::uint32_t level = 0) {
  return test::error_of(decode_ktx2_file(bytes, pixels, level));
}

// Values of a channel; opaque if there is no alpha.
std::string channel_of(const Image& image, std::size_t channel) {
  std::string values;
  for (std::uint64_t i = 0; i < image.texels(); ++i) {
    const bool there = channel < image.channels;
    values += there ? static_cast<char>(image.pixels[i * image.channels + channel]) : '\xFF';
  }
  return values;
}

// Whether all channels of all levels equal those of the PNG files next to the file.
void expect_transcoded(const fs::path& path) {
  const std::string bytes = file_content(path);
  std::uint32_t level = 0;
  fs::path picture = path;
  const auto next = [&] {
    return fs::exists(picture.replace_extension(std::to_string(level) + ".png"));
  };
  for (picture = path; next(); picture = path, ++level) {
    const Image image = ktx2_image(bytes, level);
    const Image truth = ktx2_image(file_content(picture), 0, ImageFormat::png);
    ASSERT_EQ(image.width, truth.width) << picture;
    ASSERT_EQ(image.height, truth.height) << picture;
    for (std::size_t channel = 0; channel < 4; ++channel) {
      ASSERT_TRUE(channel_of(image, channel) == channel_of(truth, channel))
          << picture << ", channel " << channel;
    }
  }
  EXPECT_GT(level, 0U) << path;
  EXPECT_THAT(ktx2_error(bytes, true, level).message, HasSubstr("no such level"));
}

std::vector<fs::path> ktx2_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".ktx2") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(Ktx2Pixels, AreThoseOfTheTranscoder) {
  const std::vector<fs::path> files = ktx2_files(kFiles);
  EXPECT_EQ(files.size(), 12U);
  for (const fs::path& file : files) expect_transcoded(file);
}

// New files, in the folder that tools/nightly sets.
TEST(Ktx2Pixels, AreThoseOfTheTranscoderAfresh) {
  const char* folder = std::getenv("GLTFX_KTX2_TRUTH");  // NOLINT(concurrency-mt-unsafe)
  if (folder == nullptr) GTEST_SKIP() << "GLTFX_KTX2_TRUTH is not set";
  const std::vector<fs::path> files = ktx2_files(folder);
  EXPECT_GT(files.size(), 100U);
  for (const fs::path& file : files) expect_transcoded(file);
}

// --- Single files ---

constexpr std::size_t kHeaderAndIndex = 80 + 24;  // with one level
// For the samples in the following descriptor: the channel of the first one, and of the next.
constexpr std::size_t kFirstChannel = kHeaderAndIndex + 4 + 24 + 3;
constexpr std::size_t kSecondChannel = kFirstChannel + 16;

std::size_t begin_of_level(const std::string& bytes, std::size_t level) {
  std::size_t offset = 0;
  for (std::size_t i = 8; i-- > 0;) {
    offset = offset << 8U | static_cast<unsigned char>(bytes[80 + 24 * level + i]);
  }
  return offset;
}

TEST(Ktx2Pixels, RedAndGreenOfTwoSlicesAreTheFirstTwoChannels) {
  std::string bytes = file_content(kFiles / "etc1s-smoke-24x24-128.ktx2");
  const Image colors = ktx2_image(bytes);
  ASSERT_EQ(bytes[kFirstChannel], 0);
  ASSERT_EQ(bytes[kSecondChannel], 15);
  bytes[kFirstChannel] = 3;
  bytes[kSecondChannel] = 4;
  const Image image = ktx2_image(bytes);
  EXPECT_EQ(image.channels, 3U);
  EXPECT_EQ(channel_of(image, 0), channel_of(colors, 0));
  EXPECT_EQ(channel_of(image, 1), channel_of(colors, 3));
}

TEST(Ktx2Pixels, RedAloneIsGrey) {
  std::string bytes = file_content(kFiles / "etc1s-grey-16x16-64-linear.ktx2");
  const Image colors = ktx2_image(bytes);
  bytes[kFirstChannel] = 3;
  const Image image = ktx2_image(bytes);
  EXPECT_EQ(image.channels, 1U);
  EXPECT_EQ(channel_of(image, 0), channel_of(colors, 0));
}

TEST(Ktx2Pixels, BlocksOfReservedModesAndPatternsAreMagentaAndTold) {
  std::string bytes = file_content(kFiles / "uastc-smoke-24x24-2.ktx2");
  const std::size_t block = begin_of_level(bytes, 0);
  bytes[block] = 0x45;         // the reserved mode
  bytes[block + 16] = 0x07;    // mode 7,
  bytes[block + 18] = '\xF0';  // with its pattern in bits 20 to 24: there is no pattern 31
  bytes[block + 19] = 0x01;
  const Image image = ktx2_image(bytes);
  EXPECT_THAT(image.doubt, HasSubstr("2 of its blocks"));
  const Image before = ktx2_image(file_content(kFiles / "uastc-smoke-24x24-2.ktx2"));
  constexpr std::string_view kMagenta = "\xFF\x00\xFF\xFF";
  for (std::size_t channel = 0; channel < 4; ++channel) {
    const std::string row = channel_of(image, channel).substr(0, 24);
    EXPECT_EQ(row.substr(0, 8), std::string(8, kMagenta[channel]));
    EXPECT_EQ(row.substr(8), channel_of(before, channel).substr(8, 16));
  }
}

TEST(Ktx2Pixels, WithoutPixelsAllLevelsAreChecked) {
  for (const std::string name :
       {"etc1s-photo-32x20-200-mipmaps", "uastc-photo-32x20-2-mipmaps-zstd"}) {
    std::string bytes = file_content(kFiles / (name + ".ktx2"));
    EXPECT_TRUE(std::holds_alternative<Image>(decode_ktx2_file(bytes, false))) << name;
    const std::size_t begin = begin_of_level(bytes, 1), end = begin_of_level(bytes, 0);
    std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(begin + 4),
              bytes.begin() + static_cast<std::ptrdiff_t>(end), '\xFF');
    EXPECT_THAT(ktx2_error(bytes, false).message, HasSubstr("Level 1 is corrupt")) << name;
    EXPECT_TRUE(std::holds_alternative<Image>(decode_ktx2_file(bytes, true))) << name;
  }
}

TEST(Ktx2Pixels, StatisticsAreThoseOfTheLevel) {
  const std::string bytes = file_content(kFiles / "uastc-normals-16x16-3-linear.ktx2");
  ImageRequest request;
  request.bytes = std::as_bytes(std::span(bytes.data(), bytes.size()));
  request.format = ImageFormat::ktx2;
  request.normals = true;
  const ImageResult result = Client::shared().decode_image(request);
  ASSERT_TRUE(std::holds_alternative<Image>(result));
  const Image& image = std::get<Image>(result);
  EXPECT_EQ(image.normals.vectors, 256U);
  EXPECT_EQ(image.normals.far_off, 0U);
  EXPECT_NEAR(image.normals.mean_length, 1, 0.01);
}

TEST(Ktx2Pixels, MoreTexelsThanAskedForAreRefused) {
  std::string bytes = file_content(kFiles / "etc1s-noise-1x1-128.ktx2");
  bytes[20 + 1] = bytes[24 + 1] = '\x40';  // 16385 texels per side
  EXPECT_EQ(ktx2_error(bytes).kind, ErrorKind::too_large);
}

// --- Damaged files ---

// A typical damage of files: flipped bits, and lost, doubled or overwritten bytes.
std::string damaged(std::string bytes, std::mt19937& random) {
  const auto below = [&random](std::size_t count) { return random() % count; };
  const std::size_t at = below(bytes.size());
  switch (below(5)) {
    case 0:
      bytes.resize(at);
      break;
    case 1:
      bytes.erase(at, 1 + below(8));
      break;
    case 2:
      bytes.insert(at, bytes.substr(below(bytes.size()), 8));
      break;
    default:
      for (std::size_t i = 0, count = 1 + below(3); i < count; ++i) {
        bytes[below(bytes.size())] ^= static_cast<char>(1U << below(8));
      }
      bytes[at] = static_cast<char>(below(256));
      break;
  }
  return bytes;
}

TEST(Ktx2Pixels, DamagedFilesAreDecodedOrRefused) {
  const std::vector<fs::path> files = ktx2_files(kFiles);
  std::mt19937 random(7);
  std::size_t decoded = 0, refused = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::string bytes = damaged(file_content(files[random() % files.size()]), random);
    const ImageResult result = decode_ktx2_file(bytes, random() % 2 == 0);
    const auto* error = std::get_if<DecodeError>(&result);
    ++(error == nullptr ? decoded : refused);
    if (error == nullptr) continue;
    EXPECT_TRUE(error->kind == ErrorKind::malformed || error->kind == ErrorKind::too_large)
        << error->message;
    EXPECT_THAT(error->message, testing::MatchesRegex("[A-Za-z].*\\.")) << error->message;
  }
  EXPECT_GT(decoded, 100U);
  EXPECT_GT(refused, 100U);
}

}  // namespace
}  // namespace gltfx::codec
