// SPDX-License-Identifier: Apache-2.0
// What the qualities of a picture have in common.
#include <gltfx/pipeline.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sanitized.hpp"

namespace gltfx {
namespace {

const std::string kBowl = std::string(GLTFX_SOURCE_DIR) + "/fixtures/good/bowl.glb";

BakeReport with_quality(BakeQuality quality) {
  BakeOptions options;
  options.sizes = kSanitized ? std::vector<BakeSize>{{16, 16}} : std::vector<BakeSize>{{24, 24}};
  options.quality = quality;
  return bake_file(kBowl, options);
}

double mean_of(const BakedPixels& pixels) {
  double sum = 0;
  for (const std::uint8_t byte : pixels.bytes) sum += byte;
  return sum / static_cast<double>(pixels.bytes.size());
}

double rms_difference(const BakedPixels& a, const BakedPixels& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.bytes.size(); ++i) {
    const double apart = static_cast<double>(a.bytes[i]) - b.bytes[i];
    sum += apart * apart;
  }
  return std::sqrt(sum / static_cast<double>(a.bytes.size()));
}

// In steps of 8 bits. The light of a draft is that of the other pictures.
TEST(BakeQuality, DraftStandardAndFinalShowTheSame) {
  const BakedPixels draft = with_quality(BakeQuality::draft).pixels;
  const BakedPixels standard = with_quality(BakeQuality::standard).pixels;
  const BakedPixels final = with_quality(BakeQuality::final).pixels;
  EXPECT_NEAR(mean_of(draft), mean_of(final), 4);
  EXPECT_LT(rms_difference(draft, final), 16);
  EXPECT_LT(rms_difference(standard, final), 6);
  EXPECT_LT(rms_difference(standard, final), rms_difference(draft, final));
}

TEST(BakeQuality, SamplesAndBouncesOverride) {
  BakeOptions options;
  options.sizes = {{24, 16}};
  options.quality = BakeQuality::final;
  const BakeReport usual = bake_file(kBowl, options);
  options.samples = 256;
  options.bounces = 12;
  EXPECT_EQ(bake_file(kBowl, options).pixels.bytes, usual.pixels.bytes);
  options.samples = 3;
  EXPECT_NE(bake_file(kBowl, options).pixels.bytes, usual.pixels.bytes);
}

}  // namespace
}  // namespace gltfx
