// SPDX-License-Identifier: Apache-2.0
// Places of new bytes.
#include "change/place.hpp"

#include <functional>
#include <memory>
#include <unordered_map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/hash.hpp"
#include "container/glb3_builder.hpp"

namespace gltfx::change {
namespace {

using testing::MatchesRegex;
using testing::SizeIs;

using Json = nlohmann::ordered_json;

struct Placed {
  Change change;
  Json json;
  std::string error;
};

// An asset with additions; all names are free except `taken` ones.
Placed tried(const std::string& content, const std::function<void(Additions&)>& add,
             std::size_t taken = 0) {
  const container::Container file =
      container::open_bytes(container::Bytes::from_string(content), "a.gltf");
  const model::OpenedAsset asset("a.gltf", file, {});
  Change change;
  change.additions = Additions(asset.document());
  add(change.additions);
  auto result = place(std::move(change), asset, [&](const std::string&, std::string_view) {
    if (taken == 0) return true;
    --taken;
    return false;
  });
  Placed done;
  if (!result) {
    done.error = result.error().message;
    return done;
  }
  done.change = *std::move(result);
  done.json = Json::parse(json::apply_edits(*file.json, done.change.edits));
  return done;
}

Placed placed(const std::string& content, const std::function<void(Additions&)>& add,
              std::size_t taken = 0) {
  Placed done = tried(content, add, taken);
  EXPECT_EQ(done.error, "");
  return done;
}

void add_picture(Additions& additions, const std::string& beside, const std::string& content) {
  additions.add_image({std::make_shared<const std::string>(content), beside, std::nullopt});
}

void add_vectors(Additions& additions) {
  EXPECT_EQ(additions.add_accessor({R"({"componentType":5121,"count":3,"type":"SCALAR"})", "abc"}),
            1U);
  EXPECT_EQ(additions.add_accessor({R"({"componentType":5121,"count":2,"type":"SCALAR"})", "de"}),
            2U);
}

TEST(Place, NewAccessorsShareABufferBesideTheOldOne) {
  const Placed done = placed(
      R"({"buffers":[{"byteLength":4,"uri":"old.bin"}],"bufferViews":[{}],"accessors":[{}]})",
      add_vectors);
  ASSERT_THAT(done.change.files, SizeIs(1));
  EXPECT_EQ(container::join(done.change.files[0].pieces), std::string("abc\0de", 6));
  EXPECT_THAT(done.change.files[0].path, MatchesRegex("old-[0-9a-f]{8}\\.bin"));
  EXPECT_EQ(done.json["buffers"][1]["byteLength"], 6);
  EXPECT_EQ(done.json["bufferViews"][2].dump(), R"({"buffer":1,"byteOffset":4,"byteLength":2})");
  EXPECT_EQ(done.json["accessors"][2].dump(),
            R"({"bufferView":2,"componentType":5121,"count":2,"type":"SCALAR"})");
}

TEST(Place, WithoutAFileTheyAreADataUri) {
  const Placed done = placed(
      R"({"buffers":[{"byteLength":1,"uri":"data:;base64,AA=="}],"accessors":[{}]})", add_vectors);
  EXPECT_THAT(done.change.files, SizeIs(0));
  EXPECT_EQ(done.json["buffers"][1]["uri"], "data:application/octet-stream;base64,YWJjAGRl");
}

TEST(Place, ElementsFollowThoseThatWereThere) {
  const Placed done = placed(R"({"materials":[{"name":"a"}]})", [](Additions& additions) {
    EXPECT_EQ(additions.add_element("materials", R"({"name":"b"})"), 1U);
    EXPECT_EQ(additions.add_element("materials", R"({"name":"c"})"), 2U);
    EXPECT_EQ(additions.add_element("samplers", "{}"), 0U);
  });
  EXPECT_EQ(done.json.dump(),
            R"({"materials":[{"name":"a"},{"name":"b"},{"name":"c"}],"samplers":[{}]})");
}

TEST(Place, ATakenNameIsFollowedByAnother) {
  const auto name = [](std::size_t taken) {
    return placed(
               "{}", [](Additions& additions) { add_picture(additions, "a.png", "pixels"); }, taken)
        .change.files.at(0)
        .path;
  };
  EXPECT_THAT(name(1), MatchesRegex("a-[0-9a-f]{16}\\.png"));
  EXPECT_THAT(name(3), MatchesRegex("a-[0-9a-f]{16}-3\\.png"));
}

TEST(Place, ANewNameHasTheStemOfTheOldOne) {
  const auto name = [](const std::string& uri) {
    return placed("{}", [&](Additions& additions) { add_picture(additions, uri, "pixels"); })
        .change.files.at(0)
        .path;
  };
  EXPECT_THAT(name("a"), MatchesRegex("a-[0-9a-f]{8}\\.png"));
  EXPECT_THAT(name("a.b/c"), MatchesRegex("a\\.b/c-[0-9a-f]{8}\\.png"));
  EXPECT_THAT(name(".a"), MatchesRegex("\\.a-[0-9a-f]{8}\\.png"));
}

TEST(Place, WhereNoNameIsFreeNothingIsPut) {
  const std::string none = "all names for a new file are taken";
  const auto beside = [](const std::string& uri) {
    return [uri](Additions& additions) { add_picture(additions, uri, "pixels"); };
  };
  EXPECT_EQ(tried("{}", beside("a.png"), 100).error, none);
  EXPECT_EQ(tried("{}", beside("https://example.com/a.png")).error, none);
  const std::string buffers = R"({"buffers":[{"uri":"a.bin"},{"uri":"b.bin"}],"accessors":[{}]})";
  EXPECT_EQ(tried(buffers, add_vectors, 100).error, none);
}

TEST(Place, ARootArrayOfSomethingElseIsAnError) {
  const auto add = [](Additions& additions) { additions.add_element("samplers", "{}"); };
  EXPECT_EQ(tried(R"({"samplers":[1,2]})", add).error, "a root array has the wrong type");
}

// Two of these files have hashes with the same beginning.
TEST(Place, FilesWhoseShortNamesAreEqualGetLongOnes) {
  std::unordered_map<std::uint64_t, int> known;
  std::vector<std::string> files;
  for (int i = 0; files.empty() && i < 2'000'000; ++i) {
    const auto [twin, fresh] = known.emplace(content_hash(std::to_string(i)) >> 32U, i);
    if (fresh) continue;
    for (const int number : {twin->second, i, i + 1}) files.push_back(std::to_string(number));
  }
  ASSERT_THAT(files, SizeIs(3));
  const Placed done = tried("{}", [&](Additions& additions) {
    for (const std::string& file : files) add_picture(additions, "a.png", file);
  });
  ASSERT_THAT(done.change.files, SizeIs(3));
  EXPECT_THAT(done.change.files[0].path, MatchesRegex("a-[0-9a-f]{8}\\.png"));
  EXPECT_THAT(done.change.files[1].path, MatchesRegex("a-[0-9a-f]{16}\\.png"));
  EXPECT_THAT(done.change.files[2].path, MatchesRegex("a-[0-9a-f]{8}\\.png"));
}

std::string with_bin(const std::string& json) {
  std::string text = json;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return container::test::glb(container::test::chunk(container::kChunkJson, text) +
                              container::test::bin_chunk("abcdef  "));
}

TEST(Place, OfAGlbTheBinChunkGrows) {
  const Placed done =
      placed(with_bin(R"({"buffers":[{"byteLength":6}],"accessors":[{}]})"), add_vectors);
  EXPECT_EQ(done.change.bins.at(1).more, std::string("abc\0de", 6));
  EXPECT_EQ(done.json["buffers"].dump(), R"([{"byteLength":14}])");
  EXPECT_EQ(done.json["bufferViews"].dump(), R"([{"buffer":0,"byteOffset":8,"byteLength":3},)"
                                             R"({"buffer":0,"byteOffset":12,"byteLength":2}])");
}

// The second buffer is the first one with a chunk; no chunk gets another number.
TEST(Place, OfAGlbOfVersionThreeAChunkGrows) {
  using container::test::glb3;
  const std::string text =
      R"({"asset":{"version":"2.1"},"buffers":[{"byteLength":2,"uri":"b.bin"},)"
      R"({"byteLength":4,"chunk":2}],"accessors":[{}]})";
  const Placed done = placed(
      glb3({{0x41525458, "x"}, {container::kChunkJson, text}, {container::kChunkBin, "abcd"}}),
      add_vectors);
  EXPECT_EQ(done.change.bins.at(2).more, std::string("abc\0de", 6));
  EXPECT_EQ(done.json["buffers"][1].dump(), R"({"byteLength":10,"chunk":2})");
  EXPECT_EQ(done.json["bufferViews"][0].dump(), R"({"buffer":1,"byteOffset":4,"byteLength":3})");
  const Placed first = placed(
      glb3({{container::kChunkJson, R"({"accessors":[{}]})"}, {0x41525458, "x"}}), add_vectors);
  EXPECT_TRUE(first.change.bins.empty());
}

TEST(Place, OfAGlbWhoseBufferIsNotItsBinChunkDataUrisAreMade) {
  for (const char* const buffer :
       {R"({"byteLength":6,"uri":"a.bin"})", R"({"byteLength":9})", R"({"byteLength":"6"})"}) {
    const Placed done = placed(
        with_bin(std::string(R"({"accessors":[{}],"buffers":[)") + buffer + "]}"), add_vectors);
    EXPECT_TRUE(done.change.bins.empty()) << buffer;
    EXPECT_EQ(done.json["buffers"][1]["uri"], "data:application/octet-stream;base64,YWJjAGRl");
  }
}

TEST(Place, AnImageMayTakeThePlaceOfAnother) {
  const Placed done =
      placed(with_bin(R"({"buffers":[{"byteLength":6}],"images":[{"uri":"a.png"},{}]})"),
             [](Additions& additions) {
               const auto png = std::make_shared<const std::string>("pixels");
               EXPECT_EQ(additions.add_image({png, "", 0}), 0U);
             });
  EXPECT_EQ(done.json["images"].dump(), R"([{"bufferView":0,"mimeType":"image/png"},{}])");
  EXPECT_EQ(done.change.bins.at(1).more, "pixels");
}

TEST(Place, ContentsStayWhereTheOldOnesAre) {
  const container::Container file = container::open_bytes(container::Bytes::from_string(
      R"({"buffers":[{"uri":"data:;base64,AAAA"},{"uri":"b.bin"},{}]})"));
  container::Resolver resolver;
  resolver.add("b.bin", container::Bytes::from_string("old"));
  const model::OpenedAsset asset("a.gltf", file, resolver);
  Change change;
  change.contents = {{0, "abc"}, {1, "newer"}};
  const auto done = place(change, asset, nullptr);
  ASSERT_TRUE(done);
  EXPECT_EQ(json::apply_edits(*file.json, done->edits),
            R"({"buffers":[{"uri":"data:;base64,YWJj"},{"uri":"b.bin"},{}]})");
  ASSERT_THAT(done->replaced, SizeIs(1));
  EXPECT_EQ(done->replaced[0].before.text(), "old");
  EXPECT_EQ(done->replaced[0].after.text(), "newer");
  EXPECT_THAT(done->contents, SizeIs(0));
  change.contents = {{2, "abc"}};
  EXPECT_EQ(place(change, asset, nullptr).error().message, "the bytes of a buffer are missing");
  change.contents = {{1, "ab"}};
  EXPECT_EQ(place(change, asset, nullptr).error().message, "the bytes of a buffer are missing");
}

}  // namespace
}  // namespace gltfx::change
