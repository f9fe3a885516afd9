// SPDX-License-Identifier: Apache-2.0
// vkFormat of KTX2 files against their descriptors, typeSize and supercompression.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "image/ktx2_reading.hpp"

namespace gltfx::image {
namespace {

using test::codes;
using test::Ktx2Builder;
using test::le;
using test::patched;
using test::problems;
using test::read_ktx2_text;

using Codes = std::vector<std::string>;
constexpr std::size_t kSchemeAt = 44;

std::vector<std::string> mismatches(const Ktx2Builder& builder) {
  return problems(builder.file(), "KTX2_FORMAT_MISMATCH");
}
const std::vector<std::string> kNoIssues;

TEST(Ktx2Format, OfUastcAndEtc1sIsZero) {
  Ktx2Builder uastc;
  uastc.vk_format = 37;
  EXPECT_EQ(mismatches(uastc),
            std::vector<std::string>{
                "vkFormat is 37 (R8G8B8A8_UNORM); for colorModel 166 (UASTC) it must be 0."});
  Ktx2Builder etc1s = Ktx2Builder::etc1s();
  etc1s.vk_format = 147;
  EXPECT_EQ(codes(etc1s.file()), Codes{"KTX2_FORMAT_MISMATCH"});
}

TEST(Ktx2Format, OfAstcIsThatOfItsBlocks) {
  EXPECT_EQ(codes(Ktx2Builder::astc().file()), Codes{});
  Ktx2Builder astc = Ktx2Builder::astc();
  astc.vk_format = 0;
  EXPECT_EQ(mismatches(astc).size(), 1U) << "Vulkan has formats";
  astc.vk_format = 166;
  EXPECT_EQ(mismatches(astc),
            std::vector<std::string>{"vkFormat is 166 (ASTC_6x6_SRGB_BLOCK), but the texel blocks "
                                     "of the descriptor are 4x4."});
  astc.block = std::string("\5\5\0\0", 4);
  EXPECT_EQ(mismatches(astc), kNoIssues);
  astc.vk_format = 145;
  EXPECT_EQ(mismatches(astc),
            std::vector<std::string>{"vkFormat is 145 (BC7_UNORM_BLOCK), but colorModel of the "
                                     "descriptor is 162 (ASTC), not 134."});
  Ktx2Builder two = Ktx2Builder::astc();
  two.channels = {0, 15};
  two.bits = {64, 64};
  EXPECT_EQ(mismatches(two).size(), 1U) << "samples";
  Ktx2Builder hdr = Ktx2Builder::astc().linear();
  hdr.vk_format = 1000066000;
  EXPECT_EQ(mismatches(hdr).size(), 1U) << "no floats";
  hdr.type = 0xC0;
  EXPECT_EQ(mismatches(hdr), kNoIssues);
}

TEST(Ktx2Format, OfSrgbNeedsItsTransferFunction) {
  Ktx2Builder srgb = Ktx2Builder::astc().linear();
  EXPECT_EQ(mismatches(srgb),
            std::vector<std::string>{"vkFormat is 158 (ASTC_4x4_SRGB_BLOCK), but the transfer "
                                     "function of the descriptor is 1, not sRGB."});
  Ktx2Builder linear = Ktx2Builder::astc();
  linear.vk_format = 157;
  const auto found = mismatches(linear);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0][0], '!') << "should not, and readers differ";
  EXPECT_TRUE(read_ktx2_text(linear.file()).is_sound());
  Ktx2Builder packed = Ktx2Builder::texels(64, 4, {0, 1, 2, 15}, {10, 10, 10, 2});
  packed.transfer = 2;
  EXPECT_EQ(mismatches(packed), kNoIssues) << "there is no format of sRGB like it";
}

TEST(Ktx2Format, TexelsAreThoseOfItsName) {
  struct Case {
    std::uint32_t format, type_size;
    std::vector<std::uint8_t> channels;
    std::vector<std::uint32_t> bits;
    std::uint8_t type = 0;
  };
  const std::vector<Case> cases{
      {4, 2, {2, 1, 0}, {5, 6, 5}},                    // R5G6B5_UNORM_PACK16
      {9, 1, {0}, {8}},                                // R8_UNORM
      {24, 1, {0, 1, 2}, {8, 8, 8}, 0x40},             // R8G8B8_SNORM
      {44, 1, {2, 1, 0, 15}, {8, 8, 8, 8}},            // B8G8R8A8_UNORM
      {97, 2, {0, 1, 2, 15}, {16, 16, 16, 16}, 0xC0},  // R16G16B16A16_SFLOAT
      {122, 4, {0, 1, 2}, {11, 11, 10}, 0x80},         // B10G11R11_UFLOAT_PACK32
      {124, 2, {14}, {16}},                            // D16_UNORM
  };
  for (const Case& each : cases) {
    Ktx2Builder builder =
        Ktx2Builder::texels(each.format, each.type_size, each.channels, each.bits);
    builder.type = each.type;
    if (each.format == 124) builder.transfer = 0;
    EXPECT_EQ(codes(builder.file()), Codes{}) << each.format;
    Ktx2Builder wrong = builder;
    wrong.type ^= 0x80;
    EXPECT_EQ(mismatches(wrong).size(), 1U) << each.format;
    wrong = builder;
    wrong.channels.back() = 13;
    EXPECT_EQ(mismatches(wrong).size(), 1U) << each.format;
    wrong = builder;
    wrong.type_size = 3;
    EXPECT_EQ(codes(wrong.file()), Codes{"KTX2_HEADER_INVALID"}) << each.format;
    wrong = builder;
    wrong.vk_format = 107;
    EXPECT_FALSE(mismatches(wrong).empty()) << each.format;
  }
  const Ktx2Builder few = Ktx2Builder::texels(37, 1, {0, 1, 2}, {8, 8, 16});
  EXPECT_EQ(mismatches(few),
            std::vector<std::string>{"vkFormat is 37 (R8G8B8A8_UNORM), but the samples of the "
                                     "descriptor are R8G8B16."});
}

TEST(Ktx2Format, ThousandsOfSamplesMakeAShortMessage) {
  const Ktx2Builder builder = Ktx2Builder::texels(37, 1, std::vector<std::uint8_t>(4000),
                                                  std::vector<std::uint32_t>(4000, 8));
  for (const std::string& problem : mismatches(builder)) EXPECT_LT(problem.size(), 200U);
}

TEST(Ktx2Format, OfIntegersHasNoColourSpace) {
  Ktx2Builder builder = Ktx2Builder::texels(13, 1, {0}, {8});
  EXPECT_EQ(mismatches(builder).size(), 1U);
  EXPECT_TRUE(read_ktx2_text(builder.file()).is_sound());
  builder.transfer = 0;
  EXPECT_EQ(mismatches(builder), kNoIssues);
}

TEST(Ktx2Format, OfScaledNumbersOrPlanesIsProhibited) {
  for (const std::uint32_t format : {11U, 12U, 67U, 94U, 1000156002U, 1000156033U, 1000330003U}) {
    EXPECT_EQ(codes(Ktx2Builder::texels(format, 1, {0}, {8}).file()), Codes{"KTX2_HEADER_INVALID"})
        << format;
  }
  for (const std::uint32_t format : {185U, 1000156000U, 1000156034U, 1000400000U}) {
    EXPECT_EQ(codes(Ktx2Builder::texels(format, 1, {0}, {8}).file()), Codes{}) << format;
  }
}

TEST(Ktx2Format, SchemesGoWithTheirModel) {
  const Codes bad{"KTX2_HEADER_INVALID"};
  Ktx2Builder etc1s = Ktx2Builder::etc1s();
  etc1s.scheme = 2;
  EXPECT_EQ(codes(etc1s.file()), bad);
  Ktx2Builder uastc;
  uastc.scheme = 1;
  EXPECT_EQ(codes(uastc.file()), bad);
  EXPECT_EQ(codes(patched(Ktx2Builder().file(), kSchemeAt, le(0x20000, 4))), bad) << "reserved";
}

}  // namespace
}  // namespace gltfx::image
