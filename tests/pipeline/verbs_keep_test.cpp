// SPDX-License-Identifier: Apache-2.0
// Whatever verb writes an asset, the asset means what it meant before: all that is not asked for is
// kept, and what is referred to is still there.
#include <gltfx/compare.hpp>
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "graph/graph.hpp"
#include "graph/orphans.hpp"
#include "pipeline/open_asset.hpp"
#include "prove/edited_asset.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using container::test::content_of;
using container::test::TempFolder;
using model::OpenedAsset;
using testing::AnyOf;
using testing::IsEmpty;
using testing::StartsWith;

const fs::path kFixtures = fs::path(GLTFX_SOURCE_DIR) / "fixtures";

OpenedAsset opened(const fs::path& path) { return *open_asset(path.native(), {}); }

// The changes between two files, other than those of unused objects, if these may go.
std::vector<Change> changes_between(const fs::path& before, const fs::path& after,
                                    bool unused_may_go = false) {
  CompareReport report = compare_files(before.native(), after.native());
  EXPECT_EQ(report.error, "") << before;
  EXPECT_THAT(report.unproven, IsEmpty()) << before;
  std::erase_if(report.changes, [&](const Change& change) {
    return unused_may_go && (change.kind.ends_with(".removed") || change.kind == "stored.name");
  });
  return std::move(report.changes);
}

std::string place_of(const Change& change) {
  return change.old_pointer.value_or(change.new_pointer.value_or(""));
}

std::string told(const std::vector<Change>& changes) {
  std::string text;
  for (const Change& each : changes) {
    text.append(each.kind).append(" ").append(place_of(each)).append(" ").append(each.what);
    text += "\n";
  }
  return text;
}

// JSON pointers of materials, meshes, textures and their like without any reference.
std::vector<std::string> unused_objects(const fs::path& path) {
  const OpenedAsset asset = opened(path);
  if (asset.document().empty()) return {};
  const graph::Graph graph(asset.document(), *schema::builtin_set());
  std::vector<json::NodeId> candidates;
  for (const char* array : {"materials", "meshes", "textures", "images", "samplers", "accessors"}) {
    const json::NodeId list = graph.tree().member(asset.document().root(), array);
    if (list == json::kNoNode || !asset.document().is_array(list)) continue;
    for (const json::NodeId element : asset.document().elements(list))
      candidates.push_back(element);
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<std::string> pointers;
  for (const json::NodeId object : graph::find_orphans(graph, candidates))
    pointers.push_back(asset.document().pointer_of(object));
  return pointers;
}

// Good fixtures of both versions.
std::vector<fs::path> good_assets() {
  std::vector<fs::path> assets = test::assets_in(kFixtures / "good", test::Depth::tree);
  const std::vector<fs::path> later = test::assets_in(kFixtures / "gltf-2.1" / "good");
  assets.insert(assets.end(), later.begin(), later.end());
  return assets;
}

class EachGoodAsset : public testing::Test {
 protected:
  // `write` gives what became of the asset at the first path, which goes to the second one.
  template <class Write>
  std::size_t expect_same(const Write& write, bool unused_may_go = false) {
    std::size_t changed = 0;
    for (const fs::path& path : good_assets()) {
      const TempFolder folder;
      const fs::path output = folder.path() / "out" / path.filename();
      const EditOutcome outcome = write(path, output);
      if (!outcome.written) continue;
      ++written_;
      changed += outcome.changes ? 1 : 0;
      EXPECT_EQ(told(changes_between(path, outcome.written_to, unused_may_go)), "") << path;
    }
    return changed;
  }

  std::size_t written_ = 0;  // of all
};

TEST_F(EachGoodAsset, MeansTheSameAfterFixes) {
  expect_same([](const fs::path& path, const fs::path& output) -> EditOutcome {
    FixOptions options;
    options.output = output.native();
    return fix_file(path.native(), options);
  });
  EXPECT_GE(written_, 20U);
}

bool is_at_or_below(std::string_view pointer, std::string_view place) {
  return pointer == place || (pointer.starts_with(place) && pointer[place.size()] == '/');
}

// Where changes of the fixes are allowed: at the values that they report, and at the objects of the
// root that these refer to. An extension that is required is in two lists.
std::vector<std::string> places_of_fixes(const fs::path& path, const FixReport& report) {
  const OpenedAsset asset = opened(path);
  std::vector<std::string> places;
  for (const FixAction& action : report.actions) {
    if (!action.done) continue;
    for (const std::string& pointer : action.pointers) {
      const std::string_view code = action.code;
      EXPECT_TRUE(!pointer.empty() || code.starts_with("GLB_") || code.starts_with("JSON_"))
          << path << code;
      if (pointer.empty()) continue;
      places.push_back(pointer);
      if (pointer.starts_with("/extensionsUsed")) places.emplace_back("/extensionsRequired");
    }
  }
  if (asset.document().empty()) return places;
  const graph::Graph graph(asset.document(), *schema::builtin_set());
  const std::size_t reported = places.size();
  for (std::size_t i = 0; i < reported; ++i) {
    const json::NodeId value = asset.document().resolve(places[i]);
    if (value == json::kNoNode) continue;
    graph.each_use_in(value, [&](const graph::Use& use) {
      if (use.target != json::kNoNode)
        places.push_back(asset.document().pointer_of(graph.tree().root_element(use.target)));
    });
  }
  return places;
}

void expect_changes_at(const fs::path& path, const FixReport& report,
                       const std::vector<std::string>& places) {
  const CompareReport compared = compare_files(path.native(), report.written_to);
  EXPECT_NE(compared.level, CompareLevel::identical) << path;
  for (const Change& change : compared.changes) {
    const std::string place = place_of(change);
    EXPECT_TRUE(std::any_of(places.begin(), places.end(),
                            [&](const std::string& each) {
                              return is_at_or_below(place, each) || is_at_or_below(each, place);
                            }))
        << path << " " << told({change}) << testing::PrintToString(places);
  }
}

// All else is at most stored differently.
TEST(EachBadAsset, ChangesAloneWhereItsFixesSay) {
  std::size_t changed = 0;
  for (const fs::path& folder : {kFixtures / "bad", kFixtures / "gltf-2.1" / "bad"}) {
    for (const fs::path& path : test::assets_in(folder)) {
      const TempFolder output;
      FixOptions options;
      options.output = (output.path() / path.filename()).native();
      const FixReport report = fix_file(path.native(), options);
      const bool any = std::any_of(report.actions.begin(), report.actions.end(),
                                   [](const FixAction& action) { return action.done; });
      EXPECT_EQ(report.changes, any) << path;
      if (!report.written || !report.changes) continue;
      ++changed;
      expect_changes_at(path, report, places_of_fixes(path, report));
      options.output = (output.path() / "again" / path.filename()).native();
      EXPECT_FALSE(fix_file(report.written_to, options).changes) << path;
    }
  }
  EXPECT_GE(changed, 12U);
}

// An empty node goes, and its parent is empty then.
TEST(EachBadAsset, HasItsFixedFindingsInTheReportIfOthersCome) {
  const TempFolder folder;
  FixOptions options;
  options.output = (folder.path() / "a.gltf").native();
  options.unsafe = true;
  options.only = {"NODE_EMPTY"};
  const FixReport report =
      fix_file((kFixtures / "bad" / "reed-without-skin.gltf").native(), options);
  EXPECT_TRUE(report.changes);
  ASSERT_FALSE(report.actions.empty());
  EXPECT_TRUE(report.actions.front().done);
  EXPECT_EQ(report.actions.front().pointers, std::vector<std::string>{"/nodes/3"});
}

// The asset as one text, with a material and a sampler that nothing refers to.
std::string with_unused_objects(const fs::path& path, const fs::path& place) {
  ConvertOptions options;
  options.to = StoredAs::embedded;
  options.output = (place / "embedded.gltf").native();
  if (!convert_file(path.native(), options).written) return {};
  auto json = nlohmann::ordered_json::parse(container::test::content_of(options.output));
  json["materials"].push_back({{"name", "unused"}});
  json["samplers"].push_back({{"magFilter", 9729}});
  const fs::path output = place / "unused.gltf";
  std::ofstream(output) << json.dump(1);
  return output.native();
}

TEST_F(EachGoodAsset, MeansTheSameWithoutItsUnusedObjects) {
  const std::size_t changed = expect_same(
      [](const fs::path& path, const fs::path& output) -> EditOutcome {
        const TempFolder folder;
        const std::string larger = with_unused_objects(path, folder.path());
        if (larger.empty()) return {};
        DeleteOptions options;
        options.output = fs::path(output).replace_extension(".gltf").native();
        options.pointers = unused_objects(larger);
        EXPECT_GE(options.pointers.size(), 2U) << path;
        return delete_objects(larger, options);
      },
      true);
  EXPECT_GE(changed, 20U);
}

TEST_F(EachGoodAsset, MeansTheSameInEachContainer) {
  for (const StoredAs to : {StoredAs::glb, StoredAs::gltf, StoredAs::embedded}) {
    const std::size_t changed =
        expect_same([&](const fs::path& path, fs::path output) -> EditOutcome {
          ConvertOptions options;
          options.to = to;
          options.output =
              output.replace_extension(to == StoredAs::glb ? ".glb" : ".gltf").native();
          return convert_file(path.native(), options);
        });
    EXPECT_GE(changed, 10U);
  }
}

// One object of each asset: in turn of each list that it has.
std::string object_to_delete(const fs::path& path, std::size_t turn) {
  const OpenedAsset asset = opened(path);
  std::vector<std::string> objects;
  for (const char* list : {"/nodes", "/meshes", "/materials", "/textures", "/images", "/animations",
                           "/skins", "/cameras", "/scenes"}) {
    const json::NodeId array = asset.document().resolve(list);
    if (array == json::kNoNode || !asset.document().is_array(array)) continue;
    objects.push_back(fmt::format("{}/{}", list, asset.document().array_size(array) / 2));
  }
  return objects.empty() ? std::string() : objects[turn % objects.size()];
}

// A child of a deleted node has another parent; all else changes at what the deletion tells.
TEST(EachAsset, ChangesAloneWhereADeletionSays) {
  std::size_t turn = 0;
  std::size_t changed = 0;
  for (const fs::path& path : good_assets()) {
    const TempFolder folder;
    DeleteOptions options;
    options.output = (folder.path() / path.filename()).native();
    options.pointers = {object_to_delete(path, turn++)};
    options.cascade = true;
    if (options.pointers.front().empty()) continue;
    const DeleteReport report = delete_objects(path.native(), options);
    if (!report.written) continue;
    ++changed;
    for (const Change& change : changes_between(path, report.written_to)) {
      const std::string place = place_of(change);
      const auto is_told = [&](const DeletedObject& each) {
        return is_at_or_below(place, each.pointer) || is_at_or_below(each.pointer, place);
      };
      EXPECT_TRUE(change.kind == "node.parent" ||
                  std::any_of(report.deleted.begin(), report.deleted.end(), is_told))
          << path << options.pointers.front() << " " << told({change});
    }
  }
  EXPECT_GE(changed, 30U);
}

// Triangles of Draco have an order of their own.
TEST(EachFigure, IsWithinItsBoundsAfterQuantizationInAnyOrder) {
  std::size_t changed = 0;
  for (const fs::path& path : test::assets_in(kFixtures / "figures")) {
    const TempFolder folder;
    ConvertOptions options;
    options.quantize = LossBounds();
    options.compress = Compression::draco;
    options.output = (folder.path() / path.filename()).native();
    const ConvertReport report = convert_file(path.native(), options);
    if (!report.written || !report.changes) continue;
    ++changed;
    std::vector<Change> beyond = changes_between(path, report.written_to);
    std::erase_if(beyond,
                  [](const Change& change) { return change.level <= CompareLevel::bounds; });
    EXPECT_EQ(told(beyond), "") << path;
  }
  EXPECT_GE(changed, 10U);
}

// An upgrade changes legacy objects, what shows them and what points to them, and nothing else.
TEST(EachLegacyAsset, DiffersInItsLegacyObjectsAloneAfterAnUpgrade) {
  std::size_t changed = 0;
  for (const fs::path& path : test::assets_in(kFixtures / "legacy", test::Depth::tree)) {
    const TempFolder folder;
    UpgradeOptions options;
    options.output = (folder.path() / path.filename()).native();
    const UpgradeReport report = upgrade_file(path.native(), options);
    if (!report.written || !report.changes) continue;
    ++changed;
    for (const Change& one : changes_between(path, report.written_to, true)) {
      EXPECT_THAT(place_of(one), AnyOf(StartsWith("/materials"), StartsWith("/textures"),
                                       StartsWith("/images"), StartsWith("/extensions"),
                                       StartsWith("/asset/extensions"), StartsWith("/animations")))
          << path << " " << one.what;
    }
  }
  EXPECT_GE(changed, 5U);
}

// An empty list is what `fix` removes.
std::string asset_that_refers_to(const std::string& uri, const std::string& more = {}) {
  return fmt::format(R"({{"asset":{{"version":"2.1"}},"externalAssets":[{{"file":0}}],
"files":[{{"uri":"{}","mimeType":"model/gltf+json"}}]{}}})",
                     uri, more);
}

class WrittenTogether : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    return folder_.write(fs::path("in") / name, text).native();
  }
  std::string output(const std::string& name) const {
    return (folder_.path() / "out" / name).native();
  }
  std::vector<EditInput> inputs(const std::vector<std::string>& names) const {
    std::vector<EditInput> inputs;
    for (const std::string& name : names) {
      inputs.push_back({(folder_.path() / "in" / name).native(), output(name)});
    }
    return inputs;
  }

  TempFolder folder_;
};

TEST_F(WrittenTogether, FixWritesAnAssetAndItsExternalAsset) {
  const std::string empty = R"(,"bufferViews":[])";
  write("a.gltf", asset_that_refers_to("b.gltf", empty));
  write("b.gltf", R"({"asset":{"version":"2.1"},"bufferViews":[]})");
  write("c.gltf", asset_that_refers_to("b.gltf"));
  for (int run = 0; run < 2; ++run) {
    fix_files(inputs({"a.gltf", "b.gltf", "c.gltf"}), {}, 2, [](FixReport&& report) {
      EXPECT_TRUE(report.written) << report.path << report.error;
    });
    EXPECT_EQ(content_of(output("a.gltf")), asset_that_refers_to("b.gltf"));
    EXPECT_EQ(content_of(output("b.gltf")), R"({"asset":{"version":"2.1"}})");
  }
}

TEST_F(WrittenTogether, ConvertWritesAnAssetAndItsExternalAsset) {
  write("a.gltf", asset_that_refers_to("b.gltf"));
  const std::string kept =
      R"({"asset":{"version":"2.1"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{}])";
  write("b.gltf", kept + R"(,"materials":[{}]})");
  ConvertOptions options;
  options.prune = true;
  options.shared_folder = true;
  convert_files(inputs({"a.gltf", "b.gltf"}), options, 1, [](ConvertReport&& report) {
    EXPECT_TRUE(report.written) << report.path << report.error;
  });
  EXPECT_EQ(content_of(output("b.gltf")), kept + "}");
}

TEST_F(WrittenTogether, OtherExternalAssetsAreCopied) {
  const std::string path = write("a.gltf", asset_that_refers_to("b.gltf", R"(,"bufferViews":[])"));
  write("b.gltf", asset_that_refers_to("sub/../a.gltf"));
  FixOptions options;
  options.output = output("a.gltf");
  const FixReport report = fix_file(path, options);
  EXPECT_TRUE(report.written) << report.error;
  EXPECT_EQ(content_of(output("a.gltf")), asset_that_refers_to("b.gltf"));
  EXPECT_EQ(content_of(output("b.gltf")), asset_that_refers_to("sub/../a.gltf"));
}

}  // namespace
}  // namespace gltfx
