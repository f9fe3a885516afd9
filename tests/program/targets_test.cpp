// SPDX-License-Identifier: Apache-2.0
/// Engines that the user names: --target, gltfx.toml, and the matrix of `gltfx targets`.
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::content_of;
using container::test::TempFolder;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string kTwist = R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_xyz_twist",
 "KHR_node_visibility"], "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"extensions":
 {"KHR_node_visibility": {"visible": false}}}]})";

const std::string kEngine = R"({"format": 1, "name": "engine", "title": "Engine",
 "source": "other:engine", "measured": "picture", "versions": [{"version": "1.0",
 "released": "2020-02-03"}], "features": {"KHR_node_visibility": {"used": "ignored"}}})";

class Targets : public testing::Test {
 protected:
  Targets() {
    folder_.write("a.gltf", kTwist);
    folder_.write("engine.json", kEngine);
  }
  Outcome run(const std::vector<std::string>& arguments) {
    return gltfx(arguments, {folder_.path().native(), {}, {}});
  }
  TempFolder folder_;
};

TEST_F(Targets, AFileOfTheUsersOwnAddsAnEngine) {
  const Outcome outcome =
      run({"validate", "a.gltf", "--target", "engine@1.0", "--target-file", "engine.json"});
  EXPECT_THAT(outcome.out, HasSubstr("warning[TARGET_IGNORES]: Engine 1.0 ignores "
                                     "KHR_node_visibility: "));
}

TEST_F(Targets, BuiltInEnginesByNameInTheConfiguration) {
  folder_.write("gltfx.toml", "[[overrides]]\npaths = [\"a.gltf\"]\ntargets = [\"nonsense\"]\n");
  const Outcome wrong = run({"validate", "a.gltf"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("'nonsense' is no target; there are "));
  folder_.write("gltfx.toml", "targets = [\"three@0.187.0\"]\n");
  EXPECT_NE(run({"validate", "a.gltf"}).code, 2);
}

TEST_F(Targets, APlanNotesWhoIgnoresTheSuccessor) {
  folder_.write("old.gltf", R"({"asset": {"version": "2.0"},
      "extensionsUsed": ["KHR_materials_translucency"], "materials": [{"extensions":
      {"KHR_materials_translucency": {"translucencyFactor": 0.5}}}]})");
  folder_.write("other.json", R"({"format": 1, "name": "engine", "title": "Engine",
      "source": "other:engine", "measured": "objects", "versions": [{"version": "1.0"}],
      "features": {"KHR_materials_diffuse_transmission": {"used": "ignored"}}})");
  const Outcome outcome =
      run({"upgrade", "old.gltf", "--target", "engine", "--target-file", "other.json"});
  EXPECT_THAT(outcome.out, HasSubstr("Engine 1.0 ignores KHR_materials_diffuse_transmission"));
  folder_.write("gltfx.toml", "targets = [\"three@0.187.0\"]\n");
  const std::string before = content_of(folder_.path() / "old.gltf");
  const Outcome configured = run({"upgrade", "old.gltf"});
  EXPECT_THAT(configured.out,
              HasSubstr("three.js 0.187.0 ignores KHR_materials_diffuse_transmission"));
  EXPECT_EQ(content_of(folder_.path() / "old.gltf"), before);
}

TEST_F(Targets, WrongWordsAndFilesAreUsageErrors) {
  EXPECT_EQ(run({"validate", "a.gltf", "--target", "nobody"}).code, 2);
  EXPECT_EQ(run({"validate", "a.gltf", "--target", "three@x"}).code, 2);
  EXPECT_EQ(run({"validate", "a.gltf", "--target", "three", "--target-file", "a.gltf"}).code, 2);
  EXPECT_EQ(run({"validate", "a.gltf", "--target", "three", "--target-file", "none.json"}).code, 2);
}

TEST_F(Targets, TheNewestVersionByAWord) {
  const std::string named = run({"targets", "three"}).out;
  EXPECT_THAT(named, StartsWith("feature "));
  EXPECT_EQ(run({"targets", "three@newest"}).out, named);
  EXPECT_EQ(run({"targets", "--target", "three@newest"}).out, named);
  EXPECT_EQ(run({"targets", "three@0.140", "--target", "three"}).out,
            run({"targets", "three@0.140", "three"}).out);
  EXPECT_NE(run({"validate", "a.gltf", "--target", "three@newest"}).code, 2);
  EXPECT_THAT(run({"targets", "three@newer"}).err, HasSubstr("'newer' is no version"));
}

TEST_F(Targets, TheMatrixOfAllEnginesFitsAWideTerminal) {
  const std::string text = run({"targets"}).out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  EXPECT_THAT(text, StartsWith(" 1  Assimp 5.2.5 "));
  EXPECT_THAT(text, ContainsRegex("\n[ 1][0-9]  three.js 0\\.[0-9.]+"));
  EXPECT_THAT(text, HasSubstr("\nx refused, - ignored, r read, d drawn"));
  // Of one engine by words, of all by signs: Assimp is the first.
  EXPECT_THAT(run({"targets", "assimp"}).out, ContainsRegex("\nscene\\.none +refused\n"));
  EXPECT_THAT(text, ContainsRegex("\nscene\\.none +x "));
}

TEST_F(Targets, TheMatrixInThreeFormats) {
  const Outcome text = run({"targets", "three", "engine", "--target-file", "engine.json"});
  EXPECT_EQ(text.code, 0);
  EXPECT_THAT(text.out, StartsWith("feature "));
  EXPECT_THAT(text.out, HasSubstr("Engine 1.0"));
  EXPECT_THAT(text.out, HasSubstr("\nKHR_materials_unlit "));
  EXPECT_THAT(text.out, HasSubstr("\nEngine 1.0 was released on 2020-02-03.\n"));
  const Outcome markdown = run({"targets", "three", "--format", "markdown"});
  EXPECT_THAT(markdown.out, StartsWith("| feature | three.js "));
  EXPECT_THAT(markdown.out, HasSubstr("|---|---|"));
  const auto matrix = nlohmann::json::parse(run({"targets", "three", "--format", "json"}).out);
  EXPECT_EQ(matrix["targets"][0]["name"], "three");
  EXPECT_GE(matrix["targets"][0]["versions"].size(), 12U);
  EXPECT_THAT(run({"targets"}).out, HasSubstr("three.js"));
}

}  // namespace
}  // namespace gltfx::program
