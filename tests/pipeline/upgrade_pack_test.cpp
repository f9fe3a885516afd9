// SPDX-License-Identifier: Apache-2.0
// Fewer images: color and factor in one, and images that are no longer used are removed.
#include <tuple>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "codec/support/png_encoder.hpp"
#include "container/glb_builder.hpp"
#include "legacy_asset.hpp"

namespace gltfx::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

std::string rows(std::size_t bytes, unsigned step) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i) text += static_cast<char>(i * step + 5);
  return text;
}

const std::string kMap = encode_png({4, 4, PngColor::rgb, 8, rows(48, 7)});
const std::string kBase = encode_png({4, 4, PngColor::rgba, 8, rows(64, 11)});

// A material with a base colour (texture 1) and a factor map (texture 0).
Json leaf() {
  Json before = document({mapped()}, {{{"uri", "map.png"}}, {{"uri", "base.png"}}});
  before["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 1;
  return before;
}

struct Done {
  UpgradeReport report;
  Json after;
};

Done pack(const TempFolder& folder, const Json& before, bool prune = false) {
  folder.write("map.png", kMap);
  if (!std::filesystem::exists(folder.path() / "base.png")) folder.write("base.png", kBase);
  const auto path = folder.write("a.gltf", before.dump());
  UpgradeOptions options = in_place();
  options.pack = true;
  options.prune = prune;
  Done done;
  done.report = upgrade_file(path.native(), options);
  EXPECT_TRUE(done.report.written) << done.report.error;
  done.after = Json::parse(content(path));
  return done;
}

TEST(UpgradePack, ColourAndFactorShareOneImage) {
  const TempFolder folder;
  const Done done = pack(folder, leaf(), true);
  ASSERT_THAT(done.after["images"], SizeIs(1));
  EXPECT_EQ(upgraded_extension(done.after).dump(),
            R"({"diffuseTransmissionFactor":1.0,"diffuseTransmissionTexture":{"index":0},)"
            R"("diffuseTransmissionColorTexture":{"index":0}})");
  EXPECT_EQ(done.after["materials"][0]["pbrMetallicRoughness"].dump(),
            R"({"baseColorTexture":{"index":0}})");
  const codec::Image packed = decoded(image_bytes(done.after, 0, folder.path()));
  for (const std::size_t i : {0U, 1U, 2U}) {
    EXPECT_EQ(channel(packed, i), channel(decoded(kBase), i));
  }
  EXPECT_EQ(channel(packed, 3), channel(decoded(kMap), 0));
  EXPECT_THAT(done.report.new_files, ElementsAre(testing::StartsWith("base-")));
}

TEST(UpgradePack, AlphaThatIsCoverageStaysWhereItIs) {
  for (const char* mode : {"MASK", "BLEND"}) {
    const TempFolder folder;
    Json before = leaf();
    before["materials"][0]["alphaMode"] = mode;
    const Done done = pack(folder, before);
    EXPECT_EQ(done.after["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 1);
    EXPECT_EQ(upgraded_extension(done.after)["diffuseTransmissionColorTexture"]["index"], 2);
  }
}

TEST(UpgradePack, DefaultsThatAreWrittenOutChangeNothing) {
  const TempFolder folder;
  Json before = leaf();
  before["samplers"] = {{{"wrapS", 10497}, {"wrapT", 10497}}};
  before["textures"][0]["sampler"] = 0;
  before["extensionsUsed"].push_back("KHR_texture_transform");
  before["materials"][0]["extensions"]["KHR_materials_translucency"]["translucencyTexture"] = {
      {"index", 0},
      {"texCoord", 0},
      {"extensions", {{"KHR_texture_transform", {{"offset", {0, 0}}, {"scale", {1, 1}}}}}}};
  const Done done = pack(folder, before);
  EXPECT_EQ(upgraded_extension(done.after)["diffuseTransmissionColorTexture"]["index"], 2);
}

TEST(UpgradePack, WhatDiffersIsNotPacked) {
  struct Case {
    const char* says;
    std::function<void(Json&, const TempFolder&)> change;
  };
  Json& (*const base)(Json&) = [](Json& document) -> Json& {
    return document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  };
  const std::vector<Case> cases{
      {"different coordinates or transforms",
       [&](Json& d, const TempFolder&) { base(d)["texCoord"] = 1; }},
      {"different coordinates or transforms",
       [&](Json& d, const TempFolder&) {
         d["extensionsUsed"].push_back("KHR_texture_transform");
         base(d)["extensions"]["KHR_texture_transform"]["rotation"] = 0.5;
       }},
      {"sampled differently",
       [](Json& d, const TempFolder&) {
         d["samplers"] = {{{"wrapS", 33071}}};
         d["textures"][1]["sampler"] = 0;
       }},
      {"4x2 and 4x4",
       [](Json&, const TempFolder& folder) {
         folder.write("base.png", encode_png({4, 2, PngColor::rgb, 8, rows(24, 3)}));
       }},
      {"more than 8 bits",
       [](Json&, const TempFolder& folder) {
         folder.write("base.png", encode_png({4, 4, PngColor::rgb, 16, rows(96, 3)}));
       }},
      {"image 1", [](Json&, const TempFolder& folder) { folder.write("base.png", "no image"); }}};
  for (const Case& each : cases) {
    const TempFolder folder;
    Json before = leaf();
    each.change(before, folder);
    const Done done = pack(folder, before);
    EXPECT_THAT(done.report.actions[0].notes, Contains(HasSubstr(each.says)));
    EXPECT_EQ(upgraded_extension(done.after)["diffuseTransmissionTexture"]["index"], 2);
    EXPECT_EQ(upgraded_extension(done.after)["diffuseTransmissionColorTexture"]["index"], 1);
  }
}

UpgradeOptions pruning() {
  UpgradeOptions options = in_place();
  options.prune = true;
  return options;
}

// A large document is not held while another one is, but parsed again.
TEST(UpgradePrune, ALargeDocumentGivesTheSameAsASmallOne) {
  for (const bool prune : {false, true}) {
    std::vector<std::pair<Json, UpgradeReport>> done;
    for (const std::size_t blanks : {0U, 5U << 20U}) {
      const TempFolder folder;
      folder.write("map.png", kMap);
      folder.write("base.png", kBase);
      const auto path = folder.write("a.gltf", leaf().dump() + std::string(blanks, ' '));
      UpgradeOptions options;
      options.prune = prune;
      options.output = (folder.path() / "out" / "a.gltf").native();
      const UpgradeReport report = upgrade_file(path.native(), options);
      ASSERT_TRUE(report.written) << report.error;
      EXPECT_EQ(content(folder.path() / "out" / "base.png"), kBase);
      const std::string text = content(options.output);
      EXPECT_GE(text.size(), blanks);
      done.emplace_back(Json::parse(text), report);
    }
    EXPECT_EQ(done[0].first, done[1].first);
    const auto& [one, other] = std::tie(done[0].second, done[1].second);
    EXPECT_EQ(one.new_warnings, other.new_warnings);
    ASSERT_EQ(one.orphans.size(), other.orphans.size());
    EXPECT_FALSE(one.orphans.empty());
    for (std::size_t i = 0; i < one.orphans.size(); ++i) {
      EXPECT_EQ(one.orphans[i].pointer, other.orphans[i].pointer);
      EXPECT_EQ(one.orphans[i].bytes, other.orphans[i].bytes);
      EXPECT_EQ(one.orphans[i].removed, prune);
      EXPECT_EQ(other.orphans[i].removed, prune);
    }
  }
}

TEST(UpgradePrune, EveryIndexThatLeadsBehindAnOrphanMovesUp) {
  const TempFolder folder;
  folder.write("map.png", kMap);
  folder.write("base.png", kBase);
  Json before = leaf();
  before["materials"].push_back({{"normalTexture", {{"index", 1}}}});
  before["extensionsUsed"].push_back("KHR_animation_pointer");
  const Json::json_pointer pointer(
      "/animations/0/channels/0/target/extensions/KHR_animation_pointer/pointer");
  before["animations"] = Json::parse(
      R"([{"channels":[{"target":{"path":"pointer","extensions":{"KHR_animation_pointer":{}}}}]}])");
  before[pointer] = "/textures/1/sampler";
  const auto path = folder.write("a.gltf", before.dump());
  const UpgradeReport report = upgrade_file(path.native(), pruning());
  ASSERT_TRUE(report.written) << report.error;
  for (const UpgradeOrphan& orphan : report.orphans) EXPECT_TRUE(orphan.removed);
  const Json after = Json::parse(content(path));
  EXPECT_THAT(after["images"], SizeIs(2));
  EXPECT_EQ(after["textures"].dump(), R"([{"source":0},{"source":1}])");
  EXPECT_EQ(after["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
  EXPECT_EQ(after["materials"][1]["normalTexture"]["index"], 0);
  EXPECT_EQ(upgraded_extension(after)["diffuseTransmissionTexture"]["index"], 1);
  EXPECT_EQ(upgraded_extension(after)["diffuseTransmissionColorTexture"]["index"], 0);
  EXPECT_EQ(after[pointer], "/textures/0/sampler");
}

TEST(UpgradePrune, WhatSomebodyElseUsesStays) {
  const TempFolder folder;
  folder.write("map.png", kMap);
  folder.write("base.png", kBase);
  Json before = leaf();
  before["materials"].push_back({{"occlusionTexture", {{"index", 0}}}});
  before["textures"].push_back({{"source", 0}});  // it was not used before either
  const auto path = folder.write("a.gltf", before.dump());
  const UpgradeReport report = upgrade_file(path.native(), pruning());
  ASSERT_TRUE(report.written) << report.error;
  EXPECT_TRUE(report.orphans.empty());
  EXPECT_THAT(Json::parse(content(path))["textures"], SizeIs(4));
}

TEST(UpgradePrune, WhereSomebodyMayKeepIndicesNothingMoves) {
  for (const auto& [member, value] : std::vector<std::pair<std::string, Json>>{
           {"extensions", {{"ACME_x", {{"texture", 1}}}}}, {"extras", {{"myTexture", 1}}}}) {
    const TempFolder folder;
    folder.write("map.png", kMap);
    folder.write("base.png", kBase);
    Json before = leaf();
    before["materials"][0][member].update(value);
    const auto path = folder.write("a.gltf", before.dump());
    const UpgradeReport report = upgrade_file(path.native(), pruning());
    ASSERT_TRUE(report.written) << report.error;
    EXPECT_FALSE(report.orphans_kept.empty()) << member;
    EXPECT_THAT(Json::parse(content(path))["textures"], SizeIs(3));
  }
}

TEST(UpgradePrune, AListThatIsEmptyThenGoes) {
  const TempFolder folder;
  folder.write("map.png", encode_png({1, 1, PngColor::rgb, 8, "\xFF\1\2"}));
  const auto path = folder.write("a.gltf", document({mapped()}, {{{"uri", "map.png"}}}).dump());
  ASSERT_TRUE(upgrade_file(path.native(), pruning()).written);
  const Json after = Json::parse(content(path));
  EXPECT_FALSE(after.contains("textures"));
  EXPECT_FALSE(after.contains("images"));
}

std::string padded(std::string data, char filler) {
  data.append((4 - data.size() % 4) % 4, filler);
  return data;
}

/// A GLB of a document and parts of its BIN chunk, one buffer view each.
std::string glb_of(Json document, const std::vector<std::string>& parts) {
  using namespace container::test;
  std::string bin;
  for (const std::string& part : parts) {
    bin = padded(bin, '\0');
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", part.size()}});
    bin += part;
  }
  if (!parts.empty()) document["buffers"] = {{{"byteLength", bin.size()}}};
  return glb(chunk(container::kChunkJson, padded(document.dump(), ' ')) +
             (parts.empty() ? "" : bin_chunk(padded(bin, '\0'))) + chunk(kChunkOther, "kept"));
}

Json in_views(std::size_t count) {
  Json images = Json::array();
  for (std::size_t i = 0; i < count; ++i) {
    images.push_back({{"bufferView", i}, {"mimeType", "image/png"}});
  }
  return images;
}

struct Glb {
  Json json;
  std::string bin, rest;
};

Glb read_glb(const std::filesystem::path& path) {
  const auto file = container::open_file(path);
  Glb glb;
  if (!file || !file->json || !file->bin) {
    ADD_FAILURE() << path;
    return glb;
  }
  const std::string_view bytes = file->bytes.text();
  glb.json = Json::parse(*file->json);
  glb.bin = bytes.substr(file->bin->offset, file->bin->length);
  glb.rest = bytes.substr(file->bin->offset + file->bin->length);
  return glb;
}

TEST(UpgradeGlb, ANewImageIsPutBehindTheOldBytes) {
  const TempFolder folder;
  const std::string geometry = "geometry of 17 by";
  const auto path =
      folder.write("a.glb", glb_of(document({mapped()}, in_views(1)), {kMap, geometry}));
  const Glb before = read_glb(path);
  const UpgradeReport report = upgrade_file(path.native(), in_place());
  ASSERT_TRUE(report.written) << report.error;
  const Glb after = read_glb(path);
  EXPECT_TRUE(after.bin.starts_with(before.bin));
  EXPECT_EQ(after.rest, before.rest);
  const std::size_t length = after.json["buffers"][0]["byteLength"];
  EXPECT_LE(length, after.bin.size());
  EXPECT_GT(length + 4, after.bin.size());
  EXPECT_EQ(after.json["images"][1]["bufferView"], 2);
  EXPECT_EQ(channel(decoded(image_bytes(after.json, 1, {}, after.bin)), 3),
            channel(decoded(kMap), 0));
  EXPECT_TRUE(upgrade_file(path.native(), in_place()).actions.empty());
}

TEST(UpgradeGlb, WithoutABinChunkOneIsMade) {
  const TempFolder folder;
  folder.write("map.png", kMap);
  const auto path = folder.write("a.glb", glb_of(document({mapped()}, {{{"uri", "map.png"}}}), {}));
  const UpgradeReport report = upgrade_file(path.native(), in_place());
  ASSERT_TRUE(report.written) << report.error;
  const Glb after = read_glb(path);
  EXPECT_EQ(channel(decoded(image_bytes(after.json, 1, {}, after.bin)), 3),
            channel(decoded(kMap), 0));
  EXPECT_TRUE(after.rest.ends_with("kept"));
}

TEST(UpgradeGlb, WhereBufferZeroIsSomethingElseADataUriIsMade) {
  const TempFolder folder;
  folder.write("map.png", kMap);
  folder.write("a.bin", "1234");
  Json before = document({mapped()}, {{{"uri", "map.png"}}});
  before["buffers"] = {{{"byteLength", 4}, {"uri", "a.bin"}}};
  const auto path = folder.write("a.glb", glb_of(before, {}));
  const UpgradeReport report = upgrade_file(path.native(), in_place());
  ASSERT_TRUE(report.written) << report.error;
  const auto file = container::open_file(path);
  const Json after = Json::parse(*file->json);
  EXPECT_EQ(decoded(image_bytes(after, 1, {})).channels, 4U);
}

TEST(UpgradeGlb, PrunedImagesTakeTheirBytesAlong) {
  const TempFolder folder;
  Json before = leaf();
  before["images"] = in_views(2);
  const std::string geometry = "geometry of 17 by";
  const auto path = folder.write("a.glb", glb_of(before, {kMap, kBase, geometry}));
  const std::size_t size = content(path).size();
  const UpgradeReport report = upgrade_file(path.native(), pruning());
  ASSERT_TRUE(report.written) << report.error;
  EXPECT_THAT(report.orphans, SizeIs(3));
  const Glb after = read_glb(path);
  EXPECT_LT(content(path).size(), size + 400);
  EXPECT_EQ(after.bin.find(kMap), std::string::npos);
  EXPECT_THAT(after.json["bufferViews"], SizeIs(3));
  EXPECT_EQ(image_bytes(after.json, 0, {}, after.bin), kBase);
  const Json& view = after.json["bufferViews"][1];
  EXPECT_EQ(after.bin.substr(view["byteOffset"], view["byteLength"]), geometry);
  EXPECT_EQ(channel(decoded(image_bytes(after.json, 1, {}, after.bin)), 3),
            channel(decoded(kMap), 0));
}

}  // namespace
}  // namespace gltfx::test
