// SPDX-License-Identifier: Apache-2.0
// An asset in memory becomes what the same asset in a file becomes, and no file is looked at: those
// that have the names of the asset hold something else.
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/support/png_encoder.hpp"
#include "container/temp_folder.hpp"
#include "legacy_asset.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using container::test::content_of;
using container::test::TempFolder;
using test::encode_png;
using test::PngColor;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Ne;
using testing::Pair;
using testing::SizeIs;

using Files = std::map<std::string, std::string>;  // contents by names

Files files_in(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) files[entry.path().filename()] = content_of(entry.path());
  }
  return files;
}

const Files& fixtures_in(const std::string& folder) {
  static std::map<std::string, Files> known;
  const auto [found, is_new] = known.try_emplace(folder);
  if (is_new) found->second = files_in(fs::path(GLTFX_SOURCE_DIR) / "fixtures" / folder);
  return found->second;
}

std::vector<std::string> assets() {
  std::vector<std::string> all;
  for (const std::string folder : {"good", "bad", "legacy"}) {
    for (const auto& [name, content] : fixtures_in(folder)) {
      if (name.ends_with(".gltf") || name.ends_with(".glb")) all.push_back(folder + "/" + name);
    }
  }
  return all;
}

class Bytes : public testing::TestWithParam<std::string> {
 protected:
  Bytes() {
    for (const auto& [name, content] : fixtures_in(folder_name())) decoys_.write(name, "decoy");
  }
  ~Bytes() override {
    for (const auto& [name, content] : files_in(decoys_.path())) EXPECT_EQ(content, "decoy");
    EXPECT_EQ(static_cast<std::size_t>(decoys_.entries()), fixtures_in(folder_name()).size());
  }

  static std::string folder_name() { return GetParam().substr(0, GetParam().find('/')); }
  static std::string name() { return GetParam().substr(GetParam().find('/') + 1); }
  static std::string path() { return std::string(GLTFX_SOURCE_DIR) + "/fixtures/" + GetParam(); }
  std::string output() const { return written_.path() / name(); }

  MemoryAsset asset() const {
    MemoryAsset asset;
    asset.bytes = fixtures_in(folder_name()).at(name());
    asset.name = decoys_.path() / name();
    asset.names = MemoryAsset::Names::paths;
    asset.read = [](const std::string& file) -> std::optional<std::string> {
      const Files& files = fixtures_in(folder_name());
      const auto found = files.find(file);
      return found == files.end() ? std::nullopt : std::optional(found->second);
    };
    return asset;
  }

  // `file` is what became of the asset in a file, with `output`.
  template <class Report>
  void expect_same(const EditedBytes<Report>& edited, const Report& file) const {
    EXPECT_EQ(edited.report.problem, file.problem);
    EXPECT_EQ(edited.report.error, file.error);
    EXPECT_EQ(edited.report.changes, file.changes);
    EXPECT_FALSE(edited.report.written);
    if (file.problem != EditProblem::none) {
      EXPECT_EQ(edited.bytes, "");
    } else {
      EXPECT_EQ(edited.bytes, file.written ? content_of(output()) : asset().bytes);
    }
    for (const auto& [path, content] : edited.files) {
      EXPECT_EQ(content, content_of(written_.path() / path)) << path;
    }
    for (const auto& [path, content] : files_in(written_.path())) {
      const auto old = fixtures_in(folder_name()).find(path);
      const bool is_new = old == fixtures_in(folder_name()).end() || old->second != content;
      EXPECT_EQ(edited.files.contains(path), is_new && path != name()) << path;
    }
  }

 private:
  const TempFolder decoys_, written_;
};

TEST_P(Bytes, AreFixedAsFilesAre) {
  FixOptions options;
  const auto edited = fix_bytes(asset(), options);
  options.output = output();
  const FixReport file = fix_file(path(), options);
  expect_same(edited, file);
  EXPECT_EQ(edited.report.fixed(), file.fixed());
  EXPECT_EQ(edited.report.left(), file.left());
  EXPECT_EQ(edited.report.changed_files, file.changed_files);
}

TEST_P(Bytes, AreUpgradedAsFilesAre) {
  UpgradeOptions options;
  options.unsafe = options.prune = options.pack = true;
  const auto edited = upgrade_bytes(asset(), options);
  options.output = output();
  const UpgradeReport file = upgrade_file(path(), options);
  expect_same(edited, file);
  EXPECT_EQ(edited.report.actions.size(), file.actions.size());
  EXPECT_EQ(edited.report.left(), file.left());
  EXPECT_EQ(edited.report.new_files, file.new_files);
  EXPECT_EQ(edited.report.new_warnings, file.new_warnings);
}

TEST_P(Bytes, LoseObjectsAsFilesDo) {
  DeleteOptions options;
  options.pointers = {"/nodes/0"};
  options.cascade = true;
  const auto edited = delete_objects_in_bytes(asset(), options);
  options.output = output();
  const DeleteReport file = delete_objects(path(), options);
  expect_same(edited, file);
  EXPECT_EQ(edited.report.deleted.size(), file.deleted.size());
  EXPECT_EQ(edited.report.renumbered, file.renumbered);
}

std::string json_of(InspectReport report) {
  report.path = "asset";
  InspectWriter writer;
  std::string text;
  writer.file(report, text);
  return text;
}

TEST_P(Bytes, AreInspectedAsFilesAre) {
  EXPECT_EQ(json_of(inspect_bytes(asset())), json_of(inspect_file(path())));
}

INSTANTIATE_TEST_SUITE_P(Fixtures, Bytes, testing::ValuesIn(assets()), [](const auto& tested) {
  std::string name = tested.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
});

BakeOptions small_picture() {
  BakeOptions options;
  options.sizes = {{32, 24}};
  options.quality = BakeQuality::draft;
  options.layers = {BakeLayer::albedo};
  return options;
}

class DrawnBytes : public Bytes {};

TEST_P(DrawnBytes, AreDrawnAsFilesAre) {
  if (!can_bake()) GTEST_SKIP() << "built without Embree";
  BakeOptions options = small_picture();
  const BakedBytes drawn = bake_bytes(asset(), options);
  const TempFolder folder;
  options.output = folder.path() / "a.png";
  const BakeReport file = bake_file(path(), options);
  EXPECT_EQ(drawn.report.problem, file.problem);
  EXPECT_EQ(drawn.report.error, file.error);
  EXPECT_EQ(drawn.report.notes, file.notes);
  EXPECT_EQ(drawn.report.pixels.bytes, file.pixels.bytes);
  EXPECT_EQ(drawn.pictures.size(), file.written.size());
  for (const auto& [suffix, png] : drawn.pictures) {
    EXPECT_EQ(png, content_of(folder.path() / ("a" + suffix + ".png"))) << suffix;
  }
}

TEST_P(DrawnBytes, GetTheirThumbnailAsFilesDo) {
  if (!can_bake()) GTEST_SKIP() << "built without Embree";
  BakeOptions options = small_picture();
  options.embed = true;
  const BakedBytes drawn = bake_bytes(asset(), options);
  const TempFolder folder;
  for (const auto& [name, content] : fixtures_in(folder_name())) folder.write(name, content);
  const BakeReport file = bake_file(folder.path() / name(), options);
  EXPECT_EQ(drawn.report.embedded, file.embedded) << file.error;
  const std::string written = content_of(folder.path() / name());
  EXPECT_EQ(drawn.bytes, file.embedded ? written : "");
}

INSTANTIATE_TEST_SUITE_P(Fixtures, DrawnBytes,
                         testing::Values("good/chair.gltf", "good/bowl.glb", "bad/kelp-bounds.gltf",
                                         "legacy/shop.gltf"));

// One asset with one file beside it, which its resolver is asked for by URI and by path, or which
// comes along.
std::vector<MemoryAsset> assets_with(const std::string& text, const std::string& path,
                                     const std::string& uri, const std::string& content) {
  MemoryAsset asset{text, "a.gltf"};
  const auto read_as = [&](const std::string& name) -> ReadResource {
    return [name, content](const std::string& wanted) {
      return wanted == name ? std::optional(content) : std::nullopt;
    };
  };
  std::vector<MemoryAsset> all(3, asset);
  all[0].read = read_as(uri);
  all[1].read = read_as(path);
  all[1].names = MemoryAsset::Names::paths;
  all[2].files[path] = content;
  return all;
}

TEST(BytesBesideTheAsset, AreGivenBackWhereTheyChange) {
  const std::string zero(4, '\0'), one("\0\0\x80\x3F", 4), two("\0\0\0\x40", 4);
  const std::string positions = zero + zero + zero + one + zero + zero + zero + one + zero;
  const std::string normal = zero + zero + two;
  const std::string text = R"({"asset": {"version": "2.0"},
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0],
"max": [1, 1, 0]}, {"bufferView": 1, "componentType": 5126, "type": "VEC3", "count": 3}],
"bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 36}],
"buffers": [{"byteLength": 72, "uri": "my%20data/a.bin"}]})";
  const std::string path = "my data/a.bin";
  const std::string before = positions + normal + normal + normal;
  const std::string unit = zero + zero + one;
  for (MemoryAsset& asset : assets_with(text, path, "my%20data/a.bin", before)) {
    const auto fixed = fix_bytes(asset);
    EXPECT_EQ(fixed.report.error, "");
    EXPECT_THAT(fixed.report.changed_files, ElementsAre(path));
    EXPECT_THAT(fixed.files, ElementsAre(Pair(path, positions + unit + unit + unit)));
    asset.read = {};
    EXPECT_EQ(fix_bytes(asset).files.contains(path), asset.files.contains(path));
  }
}

TEST(BytesBesideTheAsset, GetAFreeName) {
  const TempFolder folder;
  const std::string map =
      encode_png({16, 16, PngColor::rgb, 8, std::string(300, 'a') + std::string(468, 'b'), {}});
  folder.write("my maps/leaf.png", map);
  const std::string uri = "my%20maps/leaf.png";
  const std::string text = test::document({test::mapped()}, {{{"uri", uri}}}).dump();
  const UpgradeReport file = upgrade_file(folder.write("a.gltf", text), test::in_place());
  ASSERT_THAT(file.new_files, SizeIs(1)) << file.error;
  const std::string name = file.new_files.front();
  for (MemoryAsset& asset : assets_with(text, "my maps/leaf.png", uri, map)) {
    const auto upgraded = upgrade_bytes(asset);
    EXPECT_EQ(upgraded.bytes, content_of(folder.path() / "a.gltf"));
    EXPECT_THAT(upgraded.files, ElementsAre(Pair(name, content_of(folder.path() / name))));
    asset.files[name] = "something else";
    const auto other = upgrade_bytes(asset);
    EXPECT_THAT(other.report.new_files, ElementsAre(Ne(name)));
  }
}

TEST(BytesOptions, ThoseOfFilesAreRefused) {
  const MemoryAsset asset{R"({"asset": {"version": "2.0"}})", "a.gltf"};
  FixOptions fix;
  fix.in_place = true;
  EXPECT_EQ(fix_bytes(asset, fix).report.problem, EditProblem::refused);
  UpgradeOptions upgrade;
  upgrade.output = "b.gltf";
  EXPECT_THAT(upgrade_bytes(asset, upgrade).report.error, HasSubstr("output"));
  DeleteOptions deletion;
  deletion.root = ".";
  EXPECT_THAT(delete_objects_in_bytes(asset, deletion).report.error, HasSubstr("root"));
  InspectOptions inspect;
  inspect.root = ".";
  EXPECT_THAT(inspect_bytes(asset, inspect).error, HasSubstr("root"));
  BakeOptions bake;
  bake.output = "a.png";
  const BakedBytes drawn = bake_bytes(asset, bake);
  EXPECT_EQ(drawn.report.problem, BakeProblem::refused);
  EXPECT_THAT(drawn.pictures, IsEmpty());
}

TEST(BytesOptions, ThePathOfADiffIsTheName) {
  DeleteOptions options;
  options.diff = true;
  options.pointers = {"/nodes/0"};
  const MemoryAsset asset{R"({"asset": {"version": "2.0"}, "nodes": [{}, {}]})", "sub/../a.gltf"};
  EXPECT_THAT(delete_objects_in_bytes(asset, options).report.diff, HasSubstr("--- a/a.gltf\n"));
}

}  // namespace
}  // namespace gltfx
