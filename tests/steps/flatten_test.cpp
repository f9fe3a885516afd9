// SPDX-License-Identifier: Apache-2.0
// External assets become a part of the asset that shows them.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "convert_support.hpp"

namespace gltfx {
namespace {

using container::test::content_of;
using container::test::TempFolder;
using test::OrderedJson;
using test::StoredAsset;
using testing::ElementsAre;
using testing::HasSubstr;

/// An asset that shows others by their URIs, each at a node of its own.
std::string shows(const std::vector<std::string>& uris, const std::string& more = "") {
  OrderedJson json = {{"asset", {{"version", "2.1"}}}, {"scene", 0}};
  for (std::size_t i = 0; i < uris.size(); ++i) {
    json["files"].push_back({{"uri", uris[i]}, {"mimeType", "model/gltf+json"}});
    json["externalAssets"].push_back({{"file", i}});
    json["nodes"].push_back({{"externalAsset", i}});
    json["scenes"][0]["nodes"].push_back(i);
  }
  std::string text = json.dump();
  if (!more.empty()) text.insert(text.size() - 1, "," + more);
  return text;
}

/// A triangle with a material, a skin and an animation; its buffer is `uri`.
std::string triangle(const std::string& uri, const std::string& more = "") {
  return R"({"asset":{"version":"2.0","copyright":"A"},"scene":0,"scenes":[{"nodes":[1]}],)" +
         more +
         R"("nodes":[{"mesh":0,"name":"body","skin":0},{"children":[0,2]},{"name":"bone"}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},)"
         R"("material":0}]}],"materials":[{"name":"red"}],"skins":[{"joints":[2]}],)"
         R"("animations":[{"name":"go","channels":[{"sampler":0,"target":{"node":2,)"
         R"("path":"translation"}}],"samplers":[{"input":1,"output":4}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
         R"("min":[0,0,0],"max":[1,1,0]},)"
         R"({"bufferView":1,"componentType":5126,"count":1,"type":"SCALAR","min":[0],"max":[0]},)"
         R"({"componentType":5121,"count":3,"type":"VEC4"},)"
         R"({"bufferView":2,"componentType":5126,"count":3,"type":"VEC4"},)"
         R"({"bufferView":1,"componentType":5126,"count":1,"type":"VEC3"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36,"target":34962},)"
         R"({"buffer":0,"byteOffset":36,"byteLength":12},)"
         R"({"buffer":0,"byteOffset":48,"byteLength":48,"target":34962}],)"
         R"("buffers":[{"byteLength":96)" +
         (uri.empty() ? "" : R"(,"uri":")" + uri + '"') + "}]}";
}

std::string triangle_bytes() {
  std::vector<float> values{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0};
  for (int i = 0; i < 3; ++i) values.insert(values.end(), {1, 0, 0, 0});
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

/// Converts "main.gltf" in the folder.
ConvertReport flattened(const TempFolder& folder, const std::string& output = "out.gltf") {
  ConvertOptions options = test::options_to(folder.path() / output);
  options.later.flatten = true;
  return convert_file((folder.path() / "main.gltf").native(), options);
}

OrderedJson result_of(const TempFolder& folder, const std::string& output = "out.gltf") {
  const ConvertReport report = flattened(folder, output);
  EXPECT_TRUE(report.written) << report.error;
  if (!report.written) return OrderedJson::object();
  return StoredAsset::at(folder.path() / output).json();
}

TEST(Flatten, PutsRootsBelowTheNodeAfterItsChildren) {
  const TempFolder folder;
  folder.write("main.gltf", R"({"asset":{"version":"2.1"},
  "files":[{"uri":"a.gltf","mimeType":"model/gltf+json"}], "externalAssets":[{"file":0}],
  "nodes":[{"name":"own"}, {"name":"é", "externalAsset":0, "children":[ 0 ]}],
  "scene":0, "scenes":[{"nodes":[1]}]})");
  folder.write("a.gltf", R"({"asset":{"version":"2.1"},"scene":1,"scenes":[{"nodes":[0]},
{"nodes":[1,0]}],"nodes":[{"name":"x"},{"children":[2],"name":"y"},{"name":"z"}]})");
  const ConvertReport report = flattened(folder);
  ASSERT_TRUE(report.written) << report.error;
  EXPECT_EQ(content_of(folder.path() / "out.gltf"), R"({"asset":{"version":"2.1"},
  "nodes":[{"name":"own"}, {"name":"é", "children":[ 0,3,2 ]},{"name":"x"},{"children":[4],"name":"y"},{"name":"z"}],
  "scene":0, "scenes":[{"nodes":[1]}]})");
  ASSERT_EQ(report.steps.size(), 1U);
  EXPECT_EQ(report.steps[0].what, "1 asset at 1 node");
  ASSERT_EQ(report.steps[0].losses.size(), 1U);
  EXPECT_THAT(report.steps[0].losses[0].quantity, HasSubstr("the other scenes of "));
}

TEST(Flatten, SharesDataAndRepeatsNodesSkinsAndAnimations) {
  const TempFolder folder;
  folder.write("main.gltf", shows({"sub/a.gltf", "sub/a.gltf"}, R"("materials":[{"name":"own"}])"));
  folder.write("sub/a.gltf", triangle("a%20b.bin"));
  folder.write("sub/a b.bin", triangle_bytes());
  const OrderedJson json = result_of(folder);
  EXPECT_EQ(json["buffers"].dump(), R"([{"byteLength":96,"uri":"sub/a%20b.bin"}])");
  EXPECT_EQ(json["meshes"].size(), 1U);
  EXPECT_EQ(json["meshes"][0]["primitives"][0]["material"], 1);
  EXPECT_EQ(json["materials"][1]["name"], "red");
  EXPECT_EQ(json["accessors"].size(), 5U);
  EXPECT_EQ(json["nodes"].dump(),
            R"([{"children":[3]},{"children":[6]},{"mesh":0,"name":"body","skin":0},)"
            R"({"children":[2,4]},{"name":"bone"},{"mesh":0,"name":"body","skin":1},)"
            R"({"children":[5,7]},{"name":"bone"}])");
  EXPECT_EQ(json["skins"].dump(), R"([{"joints":[4]},{"joints":[7]}])");
  ASSERT_EQ(json["animations"].size(), 2U);
  EXPECT_EQ(json["animations"][0]["channels"][0]["target"]["node"], 4);
  EXPECT_EQ(json["animations"][1]["channels"][0]["target"]["node"], 7);
  EXPECT_EQ(json["animations"][1]["samplers"][0].dump(), R"({"input":1,"output":4})");
  EXPECT_EQ(json["asset"]["copyright"], "A");
  EXPECT_FALSE(json.contains("files"));
  EXPECT_FALSE(json.contains("externalAssets"));
}

TEST(Flatten, ReachesAssetsAtAnyDepth) {
  const TempFolder folder;
  folder.write("main.gltf", shows({"sub/a.gltf", "sub/more/b.gltf"}));
  folder.write("sub/a.gltf", shows({"more/b.gltf", "more/b.gltf"}));
  folder.write("sub/more/b.gltf", triangle("../b.bin"));
  folder.write("sub/b.bin", triangle_bytes());
  const OrderedJson json = result_of(folder);
  EXPECT_EQ(json["buffers"].dump(), R"([{"byteLength":96,"uri":"sub/b.bin"}])");
  EXPECT_EQ(json["nodes"].size(), 2U + 2U + 3U * 3U);
  EXPECT_EQ(json["animations"].size(), 3U);
  for (const auto& node : json["nodes"]) EXPECT_FALSE(node.contains("externalAsset"));
}

TEST(Flatten, TakesTheBytesOfBinaryAssets) {
  const TempFolder folder;
  folder.write("main.gltf", shows({"a.glb"}));
  folder.write("a.glb", test::glb_of(triangle(""), triangle_bytes()));
  const OrderedJson json = result_of(folder);
  const std::string uri = json["buffers"][0]["uri"];
  EXPECT_EQ(content_of(folder.path() / uri).substr(0, 96), triangle_bytes());
  const OrderedJson packed = result_of(folder, "out.glb");
  EXPECT_EQ(packed["buffers"].size(), 1U);
  EXPECT_FALSE(packed["buffers"][0].contains("uri"));
  EXPECT_EQ(StoredAsset::at(folder.path() / "out.glb").bin.substr(0, 96), triangle_bytes());
}

TEST(Flatten, PacksWhatAGlbShows) {
  const TempFolder folder;
  folder.write("main.glb", test::glb_of(shows({"a.gltf"}), {}));
  folder.write("a.gltf", triangle("a.bin"));
  folder.write("a.bin", triangle_bytes());
  ConvertOptions options = test::options_to(folder.path() / "out.glb");
  options.later.flatten = true;
  const ConvertReport report = convert_file((folder.path() / "main.glb").native(), options);
  ASSERT_TRUE(report.written) << report.error;
  EXPECT_EQ(StoredAsset::at(folder.path() / "out.glb").bin.substr(0, 96), triangle_bytes());
}

TEST(Flatten, AppliesAliases) {
  const TempFolder folder;
  folder.write("main.gltf", R"({"asset":{"version":"2.1"},"scene":0,"scenes":[{"nodes":[0]}],
"files":[{"uri":"a.gltf","mimeType":"model/gltf+json","aliases":[{"alias":"x.bin","file":1}]},
{"uri":"real.bin","mimeType":"application/gltf-buffer"}],
"externalAssets":[{"file":0}],"nodes":[{"externalAsset":0}]})");
  folder.write("a.gltf", triangle("x.bin"));
  folder.write("real.bin", triangle_bytes());
  const OrderedJson json = result_of(folder);
  EXPECT_FALSE(json.contains("files"));
  const std::string uri = json["buffers"][0]["uri"];
  EXPECT_EQ(content_of(folder.path() / uri).substr(0, 96), triangle_bytes());
}

TEST(Flatten, KeepsBuffersWithoutAUse) {
  const TempFolder folder;
  folder.write("main.gltf", shows({"a.glb"}));
  folder.write("a.glb",
               test::glb_of(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4}]})", "abcd"));
  EXPECT_EQ(result_of(folder)["buffers"][0]["uri"],
            "data:application/octet-stream;base64,YWJjZA==");
}

TEST(Flatten, MovesListsOfExtensions) {
  const TempFolder folder;
  const std::string lights =
      R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":)"
      R"({"lights":[{"type":"point","name":")";
  folder.write("main.gltf", shows({"a.gltf"}, lights + R"(own"}]}})"));
  folder.write("a.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)" +
                             lights +
                             R"(lamp"}]}},"nodes":[{"extensions":{"KHR_lights_punctual":)"
                             R"({"light":0}}}]})");
  const OrderedJson json = result_of(folder);
  const auto& list = json["extensions"]["KHR_lights_punctual"]["lights"];
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[1]["name"], "lamp");
  EXPECT_EQ(json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"], 1);
  EXPECT_EQ(json["extensionsUsed"].dump(), R"(["KHR_lights_punctual"])");
}

TEST(Flatten, MovesPointersOfAnimations) {
  const TempFolder folder;
  const std::string pointer =
      R"("extensionsUsed":["KHR_animation_pointer","X_y"],"extensionsRequired":["X_y"],)";
  std::string text = triangle("a.bin", pointer);
  const std::string target = R"("target":{"node":2,"path":"translation"})";
  text.replace(text.find(target), target.size(),
               R"("target":{"path":"pointer","extensions":{"KHR_animation_pointer":)"
               R"({"pointer":"/nodes/2/translation"}}})");
  folder.write("main.gltf", shows({"a.gltf"}));
  folder.write("a.gltf", text);
  folder.write("a.bin", triangle_bytes());
  const OrderedJson json = result_of(folder);
  EXPECT_EQ(json["animations"][0]["channels"][0]["target"]["extensions"]["KHR_animation_pointer"]
                ["pointer"],
            "/nodes/3/translation");
  EXPECT_EQ(json["extensionsRequired"].dump(), R"(["X_y"])");
}

TEST(Flatten, RefusesWhatCannotBeCopied) {
  struct Case {
    std::string a, b, why;
  };
  const std::vector<Case> cases{
      {shows({"b.gltf"}), shows({"a.gltf"}), "shows itself"},
      {shows({"a.gltf"}), "", "shows itself"},
      {shows({"none.gltf"}), "", "a.gltf /nodes/0/externalAsset: "},
      {shows({"https://example.com/x.gltf"}), "", "a.gltf /nodes/0/externalAsset: "},
      {"[]", "", "/nodes/0/externalAsset: "},
      {"no JSON", "", "/nodes/0/externalAsset: "},
      {R"({"asset":{"version":"1.0"}})", "", "glTF 1.0 is not supported"},
      {R"({"asset":{"version":"2.0"},"nodes":[{"mesh":3}]})", "", "does not exist"},
      {R"({"asset":{"version":"2.0"},"nodes":[{"extensions":{"X_y":{"node":0}}}]})", "",
       "may hold indices"}};
  for (const Case& each : cases) {
    const TempFolder folder;
    folder.write("main.gltf", shows({"a.gltf"}));
    folder.write("a.gltf", each.a);
    if (!each.b.empty()) folder.write("b.gltf", each.b);
    const ConvertReport report = flattened(folder);
    EXPECT_EQ(report.problem, EditProblem::refused) << each.why;
    EXPECT_THAT(report.error, HasSubstr("/nodes/0/externalAsset: "));
    EXPECT_THAT(report.error, HasSubstr(each.why));
  }
}

TEST(Flatten, RefusesMoreAssetsThanMemoryHas) {
  const TempFolder folder;
  folder.write("main.gltf", shows({"0.gltf", "0.gltf", "0.gltf", "0.gltf"}));
  for (int i = 0; i < 12; ++i) {
    const std::string next = fmt::format("{}.gltf", i + 1);
    folder.write(fmt::format("{}.gltf", i), shows({next, next, next, next}));
  }
  folder.write("12.gltf", R"({"asset":{"version":"2.1"}})");
  const ConvertReport report = flattened(folder);
  EXPECT_THAT(report.error, HasSubstr("it has more than 100000 external assets"));
}

TEST(Flatten, LeavesOtherAssetsAlone) {
  const TempFolder folder;
  const std::string text = R"({"asset":{"version":"2.0"}, "nodes":[{}]})";
  folder.write("main.gltf", text);
  const ConvertReport report = flattened(folder);
  EXPECT_TRUE(report.written) << report.error;
  EXPECT_FALSE(report.changes);
  EXPECT_EQ(content_of(folder.path() / "out.gltf"), text);
}

// Their bytes would be copied for each alias.
TEST(Flatten, RefusesManyAliasesOfOneFile) {
  const TempFolder folder;
  constexpr std::size_t kSize = 2 << 20;
  OrderedJson child = {{"asset", {{"version", "2.1"}}}};
  OrderedJson aliases = OrderedJson::array();
  for (int i = 0; i < 60; ++i) {
    const std::string uri = fmt::format("x{}.bin", i);
    child["buffers"].push_back({{"byteLength", kSize}, {"uri", uri}});
    child["bufferViews"].push_back({{"buffer", i}, {"byteLength", kSize}});
    aliases.push_back({{"alias", uri}, {"file", 1}});
  }
  OrderedJson main = OrderedJson::parse(shows({"a.gltf", "big.bin"}));
  main["files"][0]["aliases"] = aliases;
  main["files"][1]["mimeType"] = "application/gltf-buffer";
  main["externalAssets"].erase(1);
  main["nodes"].erase(1);
  main["scenes"][0]["nodes"].erase(1);
  folder.write("main.gltf", main.dump());
  folder.write("a.gltf", child.dump());
  folder.write("big.bin", std::string(kSize, '\0'));
  EXPECT_THAT(flattened(folder).error,
              HasSubstr("its aliases stand for more than 16 times the bytes of their files"));
}

}  // namespace
}  // namespace gltfx
