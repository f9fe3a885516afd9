// SPDX-License-Identifier: Apache-2.0
/// Changes of what few readers look at, each told at its place.
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "prove/compare.hpp"
#include "prove/edited_asset.hpp"

namespace gltfx::prove {
namespace {

using test::EditedAsset;
using test::Json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

CompareReport compared(const EditedAsset& before, const EditedAsset& after,
                       const CompareOptions& options = {}) {
  CompareReport report;
  compare_assets(before.open(), after.open(), *schema::builtin_set(), options, report);
  return report;
}

std::string told(const CompareReport& report) {
  std::string text(compare_level_name(report.level));
  for (const Change& change : report.changes) {
    text += "\n  " + std::string(change.kind) + " " + change.old_pointer.value_or("null") + " " +
            change.new_pointer.value_or("null") + ": " + change.what;
  }
  return text;
}

/// A triangle with textures, of which one has an image for other readers, a clip and what nothing
/// uses.
EditedAsset odd_asset() {
  std::string bytes(36 + 8 + 24, '\0');
  const float values[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 2, 3};
  std::memcpy(bytes.data(), values, sizeof(values));
  return EditedAsset::made(R"({
    "asset": {"version": "2.0"}, "extensionsUsed": ["EXT_texture_webp", "ACME_note"],
    "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"name": "A", "mesh": 0, "scale": [1, 1, 1], "children": [1]}, {"name": "B"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0},
                               {"attributes": {"POSITION": 3}, "material": 0}]}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
                  {"name": "Other", "normalTexture": {"index": 1}}],
    "textures": [{"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}}},
                 {"source": 2}, {"source": 2}],
    "images": [{"uri": "data:image/png;base64,AAAA", "mimeType": "image/png"},
               {"uri": "data:image/webp;base64,AAAB", "mimeType": "image/webp"},
               {"uri": "data:image/png;base64,AAAC", "mimeType": "image/png"},
               {"uri": "missing.png"}],
    "samplers": [{"wrapS": 33071}],
    "animations": [{"samplers": [{"input": 1, "output": 2},
                                 {"input": 1, "output": 4, "interpolation": "STEP"}],
                    "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation",
                                                           "extras": {"by": "me"}}}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
       "extensions": {"ACME_note": {"text": "first"}}},
      {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR"},
      {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"},
      {"componentType": 5126, "count": 3, "type": "VEC3"},
      {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36},
                    {"buffer": 0, "byteOffset": 36, "byteLength": 8},
                    {"buffer": 0, "byteOffset": 44, "byteLength": 24}]})",
                           bytes);
}

struct OddEdit {
  std::string pointer;
  Json value;        ///< null: removed
  std::string kind;  ///< of the only change
  std::string told;  ///< its pointer, if it is another one
};

std::vector<OddEdit> odd_edits() {
  return {
      {"/samplers/0/wrapS", 10497, "stored.name", "/samplers/0"},
      {"/textures/0/source", 2, "texture.value", ""},
      {"/textures/0/source", nullptr, "texture.value", "/textures/0"},
      {"/images/0/mimeType", "image/jpeg", "image.value", "/images/0"},
      {"/images/3/uri", "lost.png", "image.value", "/images/3"},
      {"/accessors/0/extensions/ACME_note/text", "second", "stored.name",
       "/accessors/0/extensions/ACME_note"},
      {"/animations/0/samplers/1/interpolation", "LINEAR", "stored.name",
       "/animations/0/samplers/1"},
      {"/animations/0/channels/0/target/extras/by", "you", "stored.name",
       "/animations/0/channels/0/target/extras"},
      {"/nodes/0/scale", {1, 1}, "node.value", ""},
      {"/meshes/0/primitives/1/material", nullptr, "geometry.material", "/meshes/0/primitives/1"},
      {"/meshes/0/primitives/1/attributes/POSITION", 9, "geometry.elements",
       "/meshes/0/primitives/1/attributes/POSITION"},
      {"/accessors/2/count", 9, "animation.curve", "/accessors/2"},
  };
}

TEST(CompareEdits, TellsEachAtItsPlace) {
  const EditedAsset before = odd_asset();
  for (const OddEdit& each : odd_edits()) {
    SCOPED_TRACE(each.pointer);
    EditedAsset after = before;
    const Json::json_pointer place(each.pointer);
    if (each.value.is_null()) {
      after.json[place.parent_pointer()].erase(place.back());
    } else {
      after.json[place] = each.value;
    }
    const std::string wanted = each.told.empty() ? each.pointer : each.told;
    const CompareReport report = compared(before, after);
    ASSERT_THAT(report.changes, SizeIs(1)) << told(report);
    const Change& change = report.changes.front();
    EXPECT_EQ(change.kind, each.kind) << told(report);
    EXPECT_EQ(change.new_pointer.value_or(wanted), wanted) << told(report);
    const CompareReport back = compared(after, before);
    ASSERT_THAT(back.changes, SizeIs(1)) << told(back);
    EXPECT_EQ(back.changes.front().old_pointer, change.new_pointer) << told(back);
    EXPECT_EQ(back.changes.front().new_pointer, change.old_pointer) << told(back);
  }
}

TEST(CompareEdits, ListsOfNumbersAreNoObjects) {
  for (const char* const list : {"nodes", "meshes", "images", "materials", "textures", "scenes",
                                 "skins", "animations", "cameras"}) {
    const EditedAsset before = odd_asset();
    EditedAsset after = before;
    after.json[list] = {5, 0, 1};
    EXPECT_EQ(compared(before, after).level, CompareLevel::differs) << list;
    EXPECT_EQ(compared(after, before).level, CompareLevel::differs) << list;
    EditedAsset other = after;
    other.json[list] = {5, 0};
    EXPECT_EQ(compared(after, other).level, CompareLevel::differs) << list;
  }
}

TEST(CompareEdits, AnotherTypeOfAnObjectIsOneChange) {
  EditedAsset before = odd_asset();
  before.json["cameras"] = Json::parse(R"([{"name": "Lens", "type": "perspective",
      "perspective": {"yfov": 0.7, "znear": 0.1}}])");
  EditedAsset after = before;
  after.json["cameras"] = Json::parse(R"([{"name": "Lens", "type": "orthographic",
      "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 9}}])");
  const CompareReport report = compared(before, after);
  ASSERT_THAT(report.changes, SizeIs(1)) << told(report);
  EXPECT_EQ(report.changes.front().new_pointer, "/cameras/0/type");
  EXPECT_THAT(compared(after, before).changes, SizeIs(1));
}

TEST(CompareEdits, AChannelIsGoneWithItsSampler) {
  EditedAsset before = odd_asset();
  Json& clip = before.json["animations"][0];
  clip["channels"].push_back(
      Json::parse(R"({"sampler": 1, "target": {"node": 0, "path": "scale"}})"));
  EditedAsset after = before;
  after.json["animations"][0]["channels"].erase(1);
  const CompareReport report = compared(before, after);
  ASSERT_THAT(report.changes, SizeIs(1)) << told(report);
  EXPECT_EQ(report.changes.front().kind, "animation.channel");
  EXPECT_THAT(compared(after, before).changes, SizeIs(1));
}

// A texel of one color, with an alpha of 255 and of 100.
TEST(CompareEdits, OpaqueMaterialsReadNoAlpha) {
  EditedAsset before = odd_asset();
  before.json["images"][0]["uri"] =
      "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGM4kWL0HwAF"
      "tAJeHzr7ywAAAABJRU5ErkJggg==";
  EditedAsset after = before;
  after.json["images"][0]["uri"] =
      "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGM4kWKUAgAF"
      "GQHDX/fUYgAAAABJRU5ErkJggg==";
  const auto with_mode = [&](const char* mode, double cutoff) {
    for (EditedAsset* each : {&before, &after}) {
      each->json["materials"][0]["alphaMode"] = mode;
      each->json["materials"][0]["alphaCutoff"] = cutoff;
    }
    CompareOptions options;
    options.bounds.image = 1;
    return compared(before, after, options).level;
  };
  EXPECT_EQ(with_mode("OPAQUE", 0.5), CompareLevel::storage);
  EXPECT_EQ(with_mode("BLEND", 0.5), CompareLevel::bounds);
  EXPECT_EQ(with_mode("MASK", 0.25), CompareLevel::bounds);
  EXPECT_EQ(with_mode("MASK", 0.5), CompareLevel::differs);
}

TEST(CompareEdits, AReferenceToAnEqualObjectIsStorage) {
  const EditedAsset before = odd_asset();
  EditedAsset after = before;
  after.json["materials"][1]["normalTexture"]["index"] = 2;
  const CompareReport report = compared(before, after);
  EXPECT_EQ(report.level, CompareLevel::storage) << told(report);
  EXPECT_THAT(report.storage,
              ElementsAre(HasSubstr("/materials/1/normalTexture/index refers to another object")));
}

TEST(CompareEdits, AnImageForOtherReadersMayBeNew) {
  EditedAsset after = odd_asset();
  EditedAsset before = after;
  before.json["textures"][0].erase("extensions");
  after.json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 0;
  EXPECT_THAT(compared(before, after).changes, IsEmpty());
}

TEST(CompareEdits, TellsWhatOneAssetAloneCanReadOnce) {
  EditedAsset before = odd_asset();
  before.json["meshes"].push_back(before.json["meshes"][0]);
  before.json["nodes"][1]["mesh"] = 1;
  before.json["meshes"][0]["name"] = "First";
  before.json["meshes"][1]["name"] = "Second";
  EditedAsset after = before;
  after.json["accessors"][0]["count"] = 7;
  const CompareReport report = compared(before, after);
  ASSERT_THAT(report.changes, SizeIs(1)) << told(report);
  EXPECT_EQ(report.changes.front().new_pointer, "/accessors/0");
  EXPECT_EQ(report.level, CompareLevel::differs);
}

}  // namespace
}  // namespace gltfx::prove
