// SPDX-License-Identifier: Apache-2.0
// The sources of new images.
#include <memory>
#include <vector>

#include <gmock/gmock.h>

#include "steps/upgrade/context.hpp"
#include "steps/upgrade/render.hpp"
#include "support.hpp"

namespace gltfx::upgrade::test {
namespace {

using testing::ElementsAre;

// A texture of the plan with channel R of image 0 as its source.
std::uint64_t add_texture(Context& context, double scale, std::optional<std::uint64_t> sampler) {
  ImageJob job;
  job.channels[3] = ChannelSource::of(0, 0, scale);
  return context.add_texture(job, sampler);
}

TEST(NewTextures, EqualJobsAreOneImageAndTexturesDifferBySampler) {
  const json::Parsed parsed = json::parse(std::string_view(R"({"images":[{"uri":"a.png"}]})"));
  const UpgradeOptions options;
  Context context(parsed.document, *schema::builtin_set(), options, nullptr, nullptr);
  EXPECT_EQ(add_texture(context, 1, std::nullopt), 0U);
  EXPECT_EQ(add_texture(context, 1, 0), 1U);
  EXPECT_EQ(add_texture(context, 1, std::nullopt), 0U);
  EXPECT_EQ(add_texture(context, 0.5, std::nullopt), 2U);
  EXPECT_EQ(context.plan.images.size(), 2U);
  EXPECT_THAT(context.plan.change.additions.elements().at("textures"),
              ElementsAre(R"({"source":1})", R"({"sampler":0,"source":1})", R"({"source":2})"));
}

std::shared_ptr<const codec::Image> image(std::uint32_t channels, std::uint32_t bits,
                                          const std::vector<std::uint8_t>& texels) {
  auto made = std::make_shared<codec::Image>();
  made->channels = channels;
  made->bits = bits;
  made->height = 1;
  made->width = static_cast<std::uint32_t>(texels.size() / (channels * (bits / 8)));
  auto owned = std::make_shared<std::vector<std::uint8_t>>(texels);
  made->pixels = std::as_bytes(std::span(*owned));
  made->owner = owned;
  return made;
}

std::vector<int> bytes_of(const Texels& texels) {
  std::vector<int> values;
  for (const std::byte value : texels.bytes) values.push_back(std::to_integer<int>(value));
  return values;
}

// G = 255 - round(A * g), B = 0: the source of roughness.
TEST(Mix, ANumberIsTurnedAround) {
  Recipe recipe;
  recipe.images[1] = image(4, 8, {0, 0, 0, 0, 0, 0, 0, 255, 0, 0, 0, 101});
  recipe.job.channels = {ChannelSource::constant(0), ChannelSource::of(0, 3, -0.5, 1),
                         ChannelSource::constant(0), ChannelSource::constant(1)};
  const Texels texels = mix(recipe);
  EXPECT_EQ(texels.raster.channels, 3U);
  EXPECT_THAT(bytes_of(texels), ElementsAre(0, 255, 0, 0, 127, 0, 0, 204, 0));
}

TEST(Mix, GreyIsEveryColourAndAMissingAlphaIsFull) {
  Recipe recipe;
  for (auto& each : recipe.images) each = image(1, 8, {7});
  for (std::uint8_t i = 0; i < 4; ++i) recipe.job.channels[i] = ChannelSource::of(0, i);
  EXPECT_THAT(bytes_of(mix(recipe)), ElementsAre(7, 7, 7, 255));
}

TEST(Mix, EightBitsBesideSixteenAreWidenedExactly) {
  Recipe recipe;
  recipe.images[0] = image(1, 8, {0x12});
  recipe.images[3] = image(1, 16, {0x34, 0x56});
  recipe.job.channels = {ChannelSource::of(0, 0), ChannelSource::constant(1),
                         ChannelSource::constant(0), ChannelSource::of(0, 0)};
  const Texels texels = mix(recipe);
  EXPECT_EQ(texels.raster.bits, 16U);
  EXPECT_THAT(bytes_of(texels), ElementsAre(0x12, 0x12, 255, 255, 0, 0, 0x34, 0x56));
}

}  // namespace
}  // namespace gltfx::upgrade::test
