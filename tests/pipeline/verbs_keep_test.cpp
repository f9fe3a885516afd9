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

class EachGoodAsset : public testing::Test {
 protected:
  // `write` gives what became of the asset at the first path, which goes to the second one.
  template <class Write>
  std::size_t expect_same(const Write& write, bool unused_may_go = false) {
    std::size_t changed = 0;
    for (const fs::path& path : test::assets_in(kFixtures / "good", test::Depth::tree)) {
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

// The objects of the root that a fix of a value changes: what others say of it changes with it.
std::string object_of(std::string_view pointer) {
  const std::size_t second = pointer.find('/', 1);
  if (second == std::string_view::npos) return std::string(pointer);
  return std::string(pointer.substr(0, pointer.find('/', second + 1)));
}

// Of each bad fixture with fixes: what changed is at or below a value that was fixed, or at the
// object that has it.
TEST(EachBadAsset, ChangesAloneWhereItsFixesSay) {
  std::size_t changed = 0;
  for (const fs::path& path : test::assets_in(kFixtures / "bad")) {
    const TempFolder folder;
    FixOptions options;
    options.output = (folder.path() / path.filename()).native();
    const FixReport report = fix_file(path.native(), options);
    if (!report.written || !report.changes) continue;
    const CompareReport compared = compare_files(path.native(), report.written_to);
    if (!compared.error.empty()) continue;
    ++changed;
    std::vector<std::string> fixed;
    for (const FixAction& action : report.actions) {
      if (!action.done) continue;
      for (const std::string& pointer : action.pointers) fixed.push_back(object_of(pointer));
    }
    for (const Change& change : compared.changes) {
      const std::string place = place_of(change);
      const bool said = std::any_of(fixed.begin(), fixed.end(), [&](const std::string& each) {
        return each.empty() || is_at_or_below(place, each) || is_at_or_below(each, place);
      });
      // The data that an accessor or a channel describes is told where it is used.
      const bool data = std::any_of(fixed.begin(), fixed.end(), [](const std::string& each) {
        return each.starts_with("/accessors") || each.starts_with("/bufferViews") ||
               each.starts_with("/buffers");
      });
      EXPECT_TRUE(said || data) << path << " " << told({change}) << testing::PrintToString(fixed);
    }
  }
  EXPECT_GE(changed, 10U);
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
