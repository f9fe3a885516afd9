// SPDX-License-Identifier: Apache-2.0
// What verbs say of external assets of glTF 2.1, and do with them.
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// A triangle in the plane of x and y.
const std::string kTriangle = R"(
  "buffers": [{"byteLength": 36, "uri": "URI"}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                 "min": [0, 0, 0], "max": [1, 1, 0]}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "nodes": [{"mesh": 0}], "scene": 0, "scenes": [{"nodes": [0]}])";

std::string triangle_with(const std::string& uri, const std::string& more = {}) {
  std::string text = R"({"asset": {"version": "2.0"}, )" + more + kTriangle + "}";
  return text.replace(text.find("URI"), 3, uri);
}

std::string parent_of(const std::string& files, const std::string& external,
                      const std::string& nodes) {
  nlohmann::json scene = nlohmann::json::array();
  const nlohmann::json list = nlohmann::json::parse("[" + nodes + "]");
  for (std::size_t i = 0; i < list.size(); ++i) scene.push_back(i);
  return R"({"asset": {"version": "2.1"}, "files": [)" + files + R"(], "externalAssets": [)" +
         external + R"(], "nodes": [)" + nodes + R"(], "scene": 0, "scenes": [{"nodes": )" +
         scene.dump() + "}]}";
}

std::string file_of(const std::string& uri) {
  return R"({"uri": ")" + uri + R"(", "mimeType": "model/gltf+json"})";
}

class ExternalAssetsOfVerbs : public testing::Test {
 protected:
  ExternalAssetsOfVerbs() {
    const float one = 1;
    std::memcpy(points_.data() + 12, &one, sizeof(one));
    std::memcpy(points_.data() + 28, &one, sizeof(one));
    folder_.write("parts/points.bin", points_);
    folder_.write("parts/child.gltf", triangle_with("points.bin"));
  }
  Outcome here(std::vector<std::string> arguments) const {
    return gltfx(std::move(arguments), {folder_.path().native(), {}, {}});
  }
  nlohmann::json facts(const std::string& path) const {
    const Outcome outcome = here({"inspect", "--format", "json", path});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json report = nlohmann::json::parse(outcome.out);
    return report["assets"][0]["facts"];
  }
  TempFolder folder_;
  std::string points_ = std::string(36, '\0');
};

TEST_F(ExternalAssetsOfVerbs, InspectListsThemAsATree) {
  folder_.write(
      "parts/middle.gltf",
      parent_of(file_of("child.gltf") + ", " + file_of("../main.gltf"),
                R"({"file": 0}, {"file": 1})",
                R"({"externalAsset": 0, "translation": [10, 0, 0]}, {"externalAsset": 0})"));
  folder_.write("main.gltf",
                parent_of(file_of("parts/middle.gltf") + ", " + file_of("parts/child.gltf") + ", " +
                              file_of("gone.gltf"),
                          R"({"file": 0}, {"file": 1}, {"file": 2})",
                          R"({"externalAsset": 0, "scale": [2, 2, 2]}, {"externalAsset": 1})"));
  const nlohmann::json all = facts("main.gltf");
  const nlohmann::json& rows = all["externalAssets"];
  ASSERT_EQ(rows.size(), 5U);
  const auto row = [&](std::size_t i) {
    const nlohmann::json& one = rows[i];
    return std::to_string(one["depth"].get<int>()) + " " + std::to_string(one["index"].get<int>()) +
           " " + one["path"].get<std::string>() + " " + one["state"].get<std::string>() + " " +
           std::to_string(one["placed"].get<int>());
  };
  EXPECT_EQ(row(0), "0 0 parts/middle.gltf read 1");
  EXPECT_EQ(row(1), "1 0 parts/child.gltf read 2");
  EXPECT_EQ(row(2), "1 1 main.gltf cycle 0");
  EXPECT_EQ(row(3), "0 1 parts/child.gltf repeated 1");
  EXPECT_EQ(row(4), "0 2 gone.gltf unread 0");
  EXPECT_EQ(rows[1]["triangles"], 1);
  EXPECT_THAT(rows[4]["problem"].get<std::string>(), HasSubstr("gone.gltf"));
  EXPECT_EQ(all["counts"]["drawnTriangles"], 3);
  EXPECT_EQ(all["bounds"]["max"], nlohmann::json::array({22, 2, 0}));
  EXPECT_EQ(all["referredFiles"].size(), 3U);
  const std::string text = here({"inspect", "main.gltf"}).out;
  EXPECT_THAT(text, AllOf(HasSubstr("External assets"), HasSubstr("  parts/child.gltf"),
                          HasSubstr("left out: it is above itself"), HasSubstr("see above"),
                          HasSubstr("no triangle (3 drawn by the scene)")));
  EXPECT_THAT(here({"inspect", "--top", "2", "main.gltf"}).out, HasSubstr("and 3 more"));
}

TEST_F(ExternalAssetsOfVerbs, AnAssetOfAnEarlierVersionHasNone) {
  std::string text =
      parent_of(file_of("parts/child.gltf"), R"({"file": 0})", R"({"externalAsset": 0})");
  text.replace(text.find("2.1"), 3, "2.0");
  folder_.write("main.gltf", text);
  EXPECT_FALSE(facts("main.gltf").contains("externalAssets"));
}

TEST_F(ExternalAssetsOfVerbs, NothingIsSaidToBeInvisible) {
  folder_.write("main.gltf", parent_of(file_of("parts/child.gltf"), R"({"file": 0})",
                                       R"({"externalAsset": 0})"));
  EXPECT_THAT(here({"inspect", "main.gltf"}).out, Not(HasSubstr("NOTHING_VISIBLE")));
}

TEST_F(ExternalAssetsOfVerbs, ChangesNameThoseThatNeedThem) {
  folder_.write("parts/old.gltf", triangle_with("points.bin", R"("extensionsUsed": ["KHR_xmp"],)"));
  folder_.write("parts/child.gltf", triangle_with("points.bin", R"("extensionsUsed": ["A_b"],)"));
  folder_.write("main.gltf",
                parent_of(file_of("parts/old.gltf") + ", " + file_of("parts/child.gltf"),
                          R"({"file": 0}, {"file": 1})", R"({"externalAsset": 0})"));
  const auto named = [&](const std::string& verb) {
    const nlohmann::json report =
        nlohmann::json::parse(here({verb, "--format", "json", "main.gltf"}).out);
    const nlohmann::json& file = report["files"][0];
    return file.value("externalAssets", std::vector<std::string>());
  };
  EXPECT_THAT(named("convert"), ElementsAre("parts/child.gltf", "parts/old.gltf"));
  EXPECT_THAT(named("upgrade"), ElementsAre("parts/old.gltf"));
  EXPECT_THAT(here({"upgrade", "main.gltf"}).out,
              HasSubstr("main.gltf: external assets have legacy extensions, too: parts/old.gltf"));
}

TEST_F(ExternalAssetsOfVerbs, AnotherFolderGetsThemWithTheirFiles) {
  folder_.write("main.gltf", parent_of(file_of("parts/child.gltf"), R"({"file": 0})",
                                       R"({"externalAsset": 0})"));
  const Outcome outcome = here({"convert", "--to", "glb", "-o", "out/main.glb", "main.gltf"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out/parts/child.gltf"));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out/parts/points.bin"));
  EXPECT_EQ(facts("out/main.glb")["counts"]["drawnTriangles"], 1);
}

TEST_F(ExternalAssetsOfVerbs, FlatteningCopiesThem) {
  folder_.write("main.gltf", parent_of(file_of("parts/child.gltf"), R"({"file": 0})",
                                       R"({"externalAsset": 0})"));
  EXPECT_THAT(here({"convert", "--to", "glb", "main.gltf"}).out,
              HasSubstr("external assets stay as they are: parts/child.gltf"));
  EXPECT_THAT(here({"convert", "--flatten", "main.gltf"}).out,
              AllOf(HasSubstr("1 asset at 1 node"), Not(HasSubstr("stay as they are"))));
}

TEST_F(ExternalAssetsOfVerbs, AnAssetIsMeantWhereOneIsMissing) {
  folder_.write("main.gltf", parent_of(file_of("parts/points.gltf"), R"({"file": 0})",
                                       R"({"externalAsset": 0})"));
  const auto help = [&] { return here({"validate", "--isolated", "main.gltf"}).out; };
  EXPECT_THAT(help(), AllOf(HasSubstr("IO_ERROR"), Not(HasSubstr("points.bin"))));
  folder_.write("parts/points.glb", "");
  EXPECT_THAT(help(), HasSubstr("write 'parts/points.glb' if that file is meant"));
}

TEST_F(ExternalAssetsOfVerbs, ACachedPictureIsThatOfTheirFiles) {
  folder_.write("main.gltf", parent_of(file_of("parts/child.gltf"), R"({"file": 0})",
                                       R"({"externalAsset": 0})"));
  const auto picture = [&] {
    TempFolder::wait_for_tick();
    const Outcome outcome = here({"bake", "main.gltf", "-o", "a.png", "--size", "8", "--quality",
                                  "draft", "--camera", "front", "--cache", "cache"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::ifstream file(folder_.path() / "a.png", std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string first = picture();
  EXPECT_EQ(picture(), first);
  std::string bytes = points_;
  std::memcpy(bytes.data() + 24, bytes.data() + 12, sizeof(float));  // another triangle
  folder_.write("parts/points.bin", bytes);
  EXPECT_NE(picture(), first);
  folder_.write("parts/points.bin", points_);
  EXPECT_EQ(picture(), first);
}

// It reads the asset, not bytes of it.
TEST_F(ExternalAssetsOfVerbs, AParentDoesNotKeepAnAssetFromChanging) {
  folder_.write("parts/main.gltf",
                parent_of(file_of("child.gltf"), R"({"file": 0})", R"({"externalAsset": 0})"));
  folder_.write("parts/child.gltf", triangle_with("points.bin", R"("materials": [{}],)"));
  const Outcome outcome = here({"convert", "--in-place", "--prune", "parts/child.gltf"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("1 file written"));
}

}  // namespace
}  // namespace gltfx::program
