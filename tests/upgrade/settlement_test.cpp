// SPDX-License-Identifier: Apache-2.0
// Where new bytes come to stand, and what new images are made of.
#include "upgrade/settlement.hpp"

#include <cstring>
#include <unordered_map>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "container/glb_builder.hpp"
#include "support.hpp"
#include "upgrade/image_cache.hpp"
#include "upgrade/render.hpp"

namespace gltfx::upgrade::test {
namespace {

using testing::ElementsAre;
using testing::MatchesRegex;
using testing::SizeIs;

struct Settled {
  Settlement settlement;
  Json json;
  std::string error;
};

// An asset with additions, everything free but for `taken` names. `images` are the files of its
// new images, "pixels" where there are none.
Settled tried(const std::string& content, const std::function<void(Additions&)>& add,
              std::size_t taken = 0, std::vector<std::shared_ptr<const std::string>> images = {}) {
  const container::Container file =
      container::open_bytes(container::Bytes::from_string(content), "a.gltf");
  const json::Parsed parsed = json::parse(file.json);
  const model::Asset asset(parsed.document);
  const container::Resolver resolver;
  const AssetBytes bytes(asset, file, resolver);
  Additions additions(parsed.document);
  add(additions);
  images.resize(additions.images().size(), std::make_shared<const std::string>("pixels"));
  auto result = settle(additions, images, file, bytes, [&](const std::string&, std::string_view) {
    if (taken == 0) return true;
    --taken;
    return false;
  });
  Settled done;
  if (!result) {
    done.error = result.error().message;
    return done;
  }
  done.settlement = *std::move(result);
  done.json = Json::parse(json::apply_edits(*file.json, done.settlement.edits));
  return done;
}

Settled settled(const std::string& content, const std::function<void(Additions&)>& add,
                std::size_t taken = 0) {
  Settled done = tried(content, add, taken);
  EXPECT_EQ(done.error, "");
  return done;
}

void add_vectors(Additions& additions) {
  EXPECT_EQ(additions.add_accessor({R"({"componentType":5121,"count":3,"type":"SCALAR"})", "abc"}),
            1U);
  EXPECT_EQ(additions.add_accessor({R"({"componentType":5121,"count":2,"type":"SCALAR"})", "de"}),
            2U);
}

TEST(Settlement, NewAccessorsShareABufferBesideTheOldOne) {
  const Settled done = settled(
      R"({"buffers":[{"byteLength":4,"uri":"old.bin"}],"bufferViews":[{}],"accessors":[{}]})",
      add_vectors);
  ASSERT_THAT(done.settlement.files, SizeIs(1));
  EXPECT_EQ(*done.settlement.files[0].bytes, std::string("abc\0de", 6));
  EXPECT_THAT(done.settlement.files[0].path, MatchesRegex("old-[0-9a-f]{8}\\.bin"));
  EXPECT_EQ(done.json["buffers"][1]["byteLength"], 6);
  EXPECT_EQ(done.json["bufferViews"][2].dump(), R"({"buffer":1,"byteOffset":4,"byteLength":2})");
  EXPECT_EQ(done.json["accessors"][2].dump(),
            R"({"bufferView":2,"componentType":5121,"count":2,"type":"SCALAR"})");
}

TEST(Settlement, WithoutAFileTheyAreADataUri) {
  const Settled done = settled(
      R"({"buffers":[{"byteLength":1,"uri":"data:;base64,AA=="}],"accessors":[{}]})", add_vectors);
  EXPECT_THAT(done.settlement.files, SizeIs(0));
  EXPECT_EQ(done.json["buffers"][1]["uri"], "data:application/octet-stream;base64,YWJjAGRl");
}

TEST(Settlement, ElementsFollowThoseThatWereThere) {
  const Settled done = settled(R"({"materials":[{"name":"a"}]})", [](Additions& additions) {
    EXPECT_EQ(additions.add_element("materials", R"({"name":"b"})"), 1U);
    EXPECT_EQ(additions.add_element("materials", R"({"name":"c"})"), 2U);
    EXPECT_EQ(additions.add_element("samplers", "{}"), 0U);
  });
  EXPECT_EQ(done.json.dump(),
            R"({"materials":[{"name":"a"},{"name":"b"},{"name":"c"}],"samplers":[{}]})");
}

TEST(Settlement, EqualJobsAreOneImageAndTexturesDifferBySampler) {
  ImageJob job;
  job.channels[3] = ChannelSource::of(0, 0);
  const Settled done = settled(R"({"images":[{"uri":"a/b.png"}]})", [&](Additions& additions) {
    EXPECT_EQ(additions.add_texture(job, std::nullopt), 0U);
    EXPECT_EQ(additions.add_texture(job, 0), 1U);
    EXPECT_EQ(additions.add_texture(job, std::nullopt), 0U);
    job.channels[3].scale = 0.5;
    EXPECT_EQ(additions.add_texture(job, std::nullopt), 2U);
  });
  EXPECT_EQ(done.json["textures"].dump(),
            R"([{"source":1},{"sampler":0,"source":1},{"source":2}])");
  EXPECT_THAT(done.settlement.files[0].path, MatchesRegex("a/b-[0-9a-f]{8}\\.png"));
}

TEST(Settlement, ATakenNameIsFollowedByAnother) {
  ImageJob job;
  job.channels[3] = ChannelSource::of(0, 0);
  const auto name = [&](std::size_t taken) {
    return settled(R"({"images":[{"uri":"a.png"}]})",
                   [&](Additions& additions) { additions.add_texture(job, std::nullopt); }, taken)
        .settlement.files.at(0)
        .path;
  };
  EXPECT_THAT(name(1), MatchesRegex("a-[0-9a-f]{16}\\.png"));
  EXPECT_THAT(name(3), MatchesRegex("a-[0-9a-f]{16}-3\\.png"));
}

TEST(Settlement, ANewNameHasTheStemOfTheOldOne) {
  ImageJob job;
  job.channels[3] = ChannelSource::of(0, 0);
  const auto name = [&](const std::string& uri) {
    return settled(R"({"images":[{"uri":")" + uri + R"("}]})",
                   [&](Additions& additions) { additions.add_texture(job, std::nullopt); })
        .settlement.files.at(0)
        .path;
  };
  EXPECT_THAT(name("a"), MatchesRegex("a-[0-9a-f]{8}\\.png"));
  EXPECT_THAT(name("a.b/c"), MatchesRegex("a\\.b/c-[0-9a-f]{8}\\.png"));
  EXPECT_THAT(name(".a"), MatchesRegex("\\.a-[0-9a-f]{8}\\.png"));
}

TEST(Settlement, WhereNoNameIsFreeNothingIsPut) {
  ImageJob job;
  job.channels[3] = ChannelSource::of(0, 0);
  const auto add = [&](Additions& additions) { additions.add_texture(job, std::nullopt); };
  const std::string none = "all names for a new file are taken";
  EXPECT_EQ(tried(R"({"images":[{"uri":"a.png"}]})", add, 100).error, none);
  EXPECT_EQ(tried(R"({"images":[{"uri":"https://example.com/a.png"}]})", add).error, none);
  const std::string buffers = R"({"buffers":[{"uri":"a.bin"},{"uri":"b.bin"}],"accessors":[{}]})";
  EXPECT_EQ(tried(buffers, add_vectors, 100).error, none);
}

TEST(Settlement, ARootArrayOfSomethingElseIsAnError) {
  const auto add = [](Additions& additions) { additions.add_element("samplers", "{}"); };
  EXPECT_EQ(tried(R"({"samplers":[1,2]})", add).error, "a root array has the wrong type");
}

// Two of these files have hashes that begin alike.
TEST(Settlement, FilesWhoseShortNamesAreEqualGetLongOnes) {
  std::unordered_map<std::uint64_t, int> known;
  std::vector<std::shared_ptr<const std::string>> files;
  for (int i = 0; files.empty() && i < 2'000'000; ++i) {
    const auto [twin, fresh] = known.emplace(content_hash(std::to_string(i)) >> 32U, i);
    if (fresh) continue;
    for (const int number : {twin->second, i, i + 1}) {
      files.push_back(std::make_shared<const std::string>(std::to_string(number)));
    }
  }
  ASSERT_THAT(files, SizeIs(3));
  ImageJob job;
  const Settled done = tried(R"({"images":[{"uri":"a.png"}]})",
                             [&](Additions& additions) {
                               for (const double scale : {1.0, 0.5, 0.25}) {
                                 job.channels[3] = ChannelSource::of(0, 0, scale);
                                 additions.add_texture(job, std::nullopt);
                               }
                             },
                             0, files);
  ASSERT_THAT(done.settlement.files, SizeIs(3));
  EXPECT_THAT(done.settlement.files[0].path, MatchesRegex("a-[0-9a-f]{8}\\.png"));
  EXPECT_THAT(done.settlement.files[1].path, MatchesRegex("a-[0-9a-f]{16}\\.png"));
  EXPECT_THAT(done.settlement.files[2].path, MatchesRegex("a-[0-9a-f]{8}\\.png"));
}

std::string with_bin(const std::string& json) {
  std::string text = json;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return container::test::glb(container::test::chunk(container::kChunkJson, text) +
                              container::test::bin_chunk("abcdef  "));
}

TEST(Settlement, OfAGlbTheBinChunkGrows) {
  const Settled done =
      settled(with_bin(R"({"buffers":[{"byteLength":6}],"accessors":[{}]})"), add_vectors);
  EXPECT_EQ(done.settlement.bin, std::string("abc\0de", 6));
  EXPECT_EQ(done.json["buffers"].dump(), R"([{"byteLength":14}])");
  EXPECT_EQ(done.json["bufferViews"].dump(), R"([{"buffer":0,"byteOffset":8,"byteLength":3},)"
                                             R"({"buffer":0,"byteOffset":12,"byteLength":2}])");
}

TEST(Settlement, OfAGlbWhoseBufferIsNotItsBinChunkDataUrisAreMade) {
  for (const char* const buffer :
       {R"({"byteLength":6,"uri":"a.bin"})", R"({"byteLength":9})", R"({"byteLength":"6"})"}) {
    const Settled done = settled(
        with_bin(std::string(R"({"accessors":[{}],"buffers":[)") + buffer + "]}"), add_vectors);
    EXPECT_EQ(done.settlement.bin, "") << buffer;
    EXPECT_EQ(done.json["buffers"][1]["uri"], "data:application/octet-stream;base64,YWJjAGRl");
  }
}

TEST(ContentHash, StaysTheSameForGood) {
  EXPECT_EQ(content_hash(""), content_hash({}));
  EXPECT_NE(content_hash(std::string(1, '\0')), content_hash(std::string(2, '\0')));
  EXPECT_EQ(fmt::format("{:016x}", content_hash("gltfx")), "d479cc4a58ddefe0");
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

// G = 255 - round(A * g), B = 0: what roughness is made of.
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
