// SPDX-License-Identifier: Apache-2.0
/// Limits from configurations, presets and other tools.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

// Two triangles in a mesh, and a second mesh with one.
constexpr const char* kMeshes = R"({"asset": {"version": "2.0"}, "scene": 0,
  "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"mesh": 1}],
  "meshes": [{"name": "SM_a", "primitives": [{"attributes": {"POSITION": 0}}]},
             {"name": "b", "primitives": [{"attributes": {"POSITION": 1}}]}],
  "accessors": [
    {"componentType": 5126, "type": "VEC3", "count": 6, "min": [0, 0, 0], "max": [0, 0, 0]},
    {"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}]})";

class Budgets : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("a.gltf", kMeshes);
    folder_.write("props/a.gltf", kMeshes);
  }
  Outcome in(const std::string& where, std::vector<std::string> arguments) const {
    return gltfx(std::move(arguments), {(folder_.path() / where).native(), {}, {}});
  }
  /// The output of validate with a configuration.
  std::string with(std::string_view text, std::vector<std::string> arguments = {"a.gltf"}) const {
    folder_.write("gltfx.toml", text);
    arguments.insert(arguments.begin(), {"validate", "--format", "agent"});
    const Outcome outcome = in("", std::move(arguments));
    EXPECT_NE(outcome.code, 2) << text << outcome.err;
    return outcome.out;
  }
  /// The mistakes in a configuration.
  std::string said(std::string_view text) const {
    folder_.write("gltfx.toml", text);
    const Outcome outcome = in("", {"validate", "a.gltf"});
    EXPECT_EQ(outcome.code, 2) << text;
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
  }

  TempFolder folder_;
};

TEST_F(Budgets, OfAConfigurationHold) {
  const std::string out = with("[budgets]\ntriangles = 2\n\n[budgets.mesh]\ntriangles = 1\n");
  EXPECT_THAT(out, HasSubstr("The asset has 3 triangles; the limit is 2 (gltfx.toml:2)."));
  EXPECT_THAT(out, HasSubstr("The mesh has 2 triangles; the limit is 1 (gltfx.toml:5)."));
}

TEST_F(Budgets, HaveOpsSeveritiesAndTiers) {
  EXPECT_THAT(with("[budgets.mesh]\ntriangles = { min = 2, severity = \"warning\" }\n"),
              AllOf(HasSubstr("warning[BUDGET_TRIANGLES]"), HasSubstr("the minimum is 2")));
  const std::string tiers =
      with("[budgets.mesh]\ntriangles = [{ max = 1, severity = \"info\" },\n 9]\n");
  EXPECT_THAT(tiers, AllOf(HasSubstr("info[BUDGET_TRIANGLES]"), Not(HasSubstr("error["))));
  EXPECT_THAT(with("[budgets.mesh]\nname = { match = '^SM_', unique = true }\n"),
              HasSubstr("The name of the mesh is 'b'; it must match '^SM_' (gltfx.toml:2)."));
  EXPECT_THAT(with("[budgets]\nfile-size = \"100 B\"\n"), HasSubstr("the limit is 100 bytes"));
  EXPECT_THAT(with("[budgets.mesh]\ntriangles = { max = 1, note = \"props\" }\n"),
              HasSubstr("the limit is 1 (gltfx.toml:2: props)."));
  EXPECT_THAT(with("[budgets.primitive]\nattributes = { deny = [\"POS*\"] }\n"),
              HasSubstr("include 'POSITION', which is not allowed"));
}

TEST_F(Budgets, OfOverridesReplaceThoseOfTheSameOp) {
  const std::string text =
      "[budgets]\ntriangles = { min = 1, max = 9 }\n[[overrides]]\npaths = [\"props/\"]\n"
      "budgets.triangles = 2\nbudgets.mesh.triangles = 1\n";
  EXPECT_THAT(with(text), Not(HasSubstr("BUDGET_")));
  const std::string out = with(text, {"props/a.gltf"});
  EXPECT_THAT(out, HasSubstr("the limit is 2 (gltfx.toml:5)"));
  EXPECT_THAT(out, HasSubstr("the limit is 1 (gltfx.toml:6)"));
  EXPECT_THAT(with("budgets.triangles = 1\n[[overrides]]\npaths = [\"props/\"]\n"
                   "budgets.triangles = false\n",
                   {"props/a.gltf"}),
              Not(HasSubstr("BUDGET_")));
}

TEST_F(Budgets, OfTheCommandLineComeLast) {
  EXPECT_THAT(with("budgets.triangles = 1\n", {"a.gltf", "--budget", "triangles=9"}),
              Not(HasSubstr("BUDGET_")));
  EXPECT_THAT(with("", {"a.gltf", "--budget", "mesh.triangles=1"}),
              HasSubstr("the limit is 1 (--budget)"));
  EXPECT_THAT(with("budgets.triangles = 1\n", {"a.gltf", "--max-triangles", "0"}),
              Not(HasSubstr("BUDGET_")));
  EXPECT_THAT(with("[[overrides]]\npaths = [\"props/\"]\nlfs = \"error\"\n",
                   {"props/a.gltf", "--max-triangles", "1"}),
              HasSubstr("the limit is 1 (--max-triangles)"));
  EXPECT_THAT(in("", {"validate", "a.gltf", "--budget", "triangels=1"}).err,
              HasSubstr("--budget: there is no measure 'triangels'; did you mean 'triangles'?\n"));
  EXPECT_THAT(in("", {"validate", "a.gltf", "--budget", "triangles"}).err,
              HasSubstr("is not MEASURE=LIMIT.\n"));
}

TEST_F(Budgets, MistakesAreNamedWithTheirLine) {
  EXPECT_THAT(said("[budgets]\ntriangels = 1\n"),
              HasSubstr("gltfx.toml:2: budgets: there is no measure 'triangels'; did you mean "
                        "'triangles'?"));
  EXPECT_THAT(said("[budgets.mash]\ntriangles = 1\n"), HasSubstr("did you mean 'mesh'?"));
  EXPECT_THAT(said("[budgets.node]\ntriangles = 1\n"), HasSubstr("not a measure of node"));
  EXPECT_THAT(said("[budgets]\nfile-size = \"5 m\"\n"), HasSubstr("is not in B, kB"));
  EXPECT_THAT(said("[budgets]\ntriangles = { mxa = 1 }\n"), HasSubstr("did you mean 'max'?"));
  EXPECT_THAT(said("[budgets]\ntriangles = { match = \"a\" }\n"), HasSubstr("not an operator"));
  EXPECT_THAT(said("[budgets]\ntriangles = nan\n"), HasSubstr("a finite number"));
  EXPECT_THAT(said("[budgets]\ntriangles = true\n"), HasSubstr("write triangles = 10"));
  EXPECT_THAT(said("[budgets.mesh]\nname = \"a\"\n"), HasSubstr("write name = { match"));
  EXPECT_THAT(said("[budgets.material]\nuv-gutter = 8\n"), HasSubstr("write uv-gutter = { min"));
  EXPECT_THAT(said("[budgets]\nmin-y = 0\n"), HasSubstr("write min-y = { min"));
  EXPECT_THAT(said("[budgets]\ntriangles = { max = 1, note = 2 }\n"), HasSubstr("note must be"));
  EXPECT_THAT(said("[budgets]\ntriangles = { max = 1, severity = \"loud\" }\n"),
              HasSubstr("severity must be"));
  EXPECT_THAT(said("budgets = 3\n"), HasSubstr("a table of MEASURE = LIMIT is expected"));
  EXPECT_THAT(said("[budgets]\nopen-edges = { max = 1, weld = -1 }\n"),
              HasSubstr("weld must be a number"));
  EXPECT_THAT(said("[budgets]\ntriangles = { max = 1, weld = 1 }\n"),
              HasSubstr("triangles does not depend on weld"));
  EXPECT_THAT(said("[budgets]\nmaterials = { max = 1, slot = \"a\" }\n"),
              HasSubstr("does not depend on slot"));
}

TEST_F(Budgets, HostileConfigurationsAreRefused) {
  std::string tiers = "[budgets]\ntriangles = [";
  for (int i = 0; i < 1000; ++i) tiers += "1, ";
  EXPECT_THAT(said(tiers + "]\n"), HasSubstr("at most 16 tiers"));
  std::string many;
  for (int i = 0; i < 20'000; ++i) {
    many += "[[overrides]]\npaths=[\"*\"]\nbudgets.nodes=1\n";
  }
  EXPECT_THAT(said(many), HasSubstr("more than 10000 limits"));
  std::string welds;
  for (int i = 0; i < 100; ++i) {
    welds += "[[overrides]]\npaths=[\"*\"]\nbudgets.mesh.open-edges={max=1,weld=0." +
             std::to_string(i + 10) + "}\n";
  }
  EXPECT_THAT(said(welds), HasSubstr("more than 16 combinations"));
  EXPECT_THAT(said("[budgets.mesh]\nname = { match = \"(((a{1000}){1000}){1000})\" }\n"),
              HasSubstr("not a pattern"));
}

TEST_F(Budgets, ExtendPresetsAndFilesInOrder) {
  folder_.write("house.toml", "ignore = [\"UNUSED_OBJECT\"]\n[budgets.mesh]\ntriangles = 1\n");
  const std::string out = with("extends = [\"house.toml\"]\n[budgets]\ntriangles = 2\n");
  EXPECT_THAT(out, HasSubstr("(house.toml:3)"));
  EXPECT_THAT(out, HasSubstr("(gltfx.toml:3)"));
  EXPECT_THAT(with("extends = [\"house.toml\"]\n[budgets.mesh]\ntriangles = 9\n"),
              Not(HasSubstr("BUDGET_")));
  folder_.write("props/own.toml", "extends = [\"../house.toml\"]\n");
  EXPECT_THAT(with("extends = [\"props/own.toml\"]\n"), HasSubstr("(house.toml:3)"));
  EXPECT_THAT(in("", {"config"}).out, HasSubstr("extends house.toml\nextends props/own.toml\n"));
  const std::string preset = "extends = [\"khronos-3d-commerce/mobile-ar\"]\n";
  EXPECT_THAT(with(preset), Not(HasSubstr("BUDGET_")));
  const std::string shown = in("", {"config"}).out;
  EXPECT_THAT(shown,
              HasSubstr("extends preset khronos-3d-commerce/mobile-ar, 1.0.0, 2020-10-20, read 2"));
  EXPECT_THAT(
      shown, ContainsRegex("budgets.triangles +max 150,000 +preset khronos-3d-commerce/mobile-ar"));
}

TEST_F(Budgets, ThatExtendInACircleAreRefused) {
  folder_.write("house.toml", "extends = [\"gltfx.toml\"]\n");
  EXPECT_THAT(said("extends = [\"house.toml\"]\n"), HasSubstr("'gltfx.toml' extends itself"));
  EXPECT_THAT(said("extends = [\"gltfx.toml\"]\n"), HasSubstr("gltfx.toml:1: extends: "));
  EXPECT_THAT(said("extends = [\"none.toml\"]\n"), HasSubstr("none.toml"));
  EXPECT_THAT(said("extends = [\"khronos-3d-comerce\"]\n"),
              HasSubstr("Did you mean 'khronos-3d-commerce'?"));
  EXPECT_THAT(said("extends = \"a\"\n"), HasSubstr("a list of presets and files"));
  for (int i = 0; i < 40; ++i) {
    folder_.write("f" + std::to_string(i) + ".toml",
                  "extends = [\"f" + std::to_string(i + 1) + ".toml\"]\n");
  }
  EXPECT_THAT(said("extends = [\"f0.toml\"]\n"), HasSubstr("in a row"));
  for (int i = 0; i < 8; ++i) {
    const std::string next = "\"f" + std::to_string(i + 1) + ".toml\"";
    folder_.write("f" + std::to_string(i) + ".toml", "extends = [" + next + ", " + next + "]\n");
  }
  folder_.write("f8.toml", "");
  EXPECT_THAT(said("extends = [\"f0.toml\"]\n"), HasSubstr("more than 64 files"));
}

TEST_F(Budgets, PathsOfAnExtendedFileAreTakenFromItsFolder) {
  folder_.write("props/own.toml", "baseline = \"known.json\"\n");
  ASSERT_EQ(in("", {"validate", "a.gltf", "--write-baseline", "props/known.json"}).code, 0);
  folder_.write("gltfx.toml", "extends = [\"props/own.toml\"]\n");
  EXPECT_EQ(in("", {"validate", "a.gltf"}).code, 0);
  EXPECT_THAT(in("", {"config"}).out, ContainsRegex("baseline +known.json +props/own.toml:1"));
}

TEST_F(Budgets, OfAConfigurationAreShownWithTheirSource) {
  folder_.write("gltfx.toml",
                "[budgets]\nfile-size = \"5 MiB\"\n[budgets.mesh]\nname = { match = \"^A\" }\n"
                "[[overrides]]\npaths = [\"props/\"]\nbudgets.triangles = 5000\n");
  const std::string all = in("", {"config"}).out;
  EXPECT_THAT(all, ContainsRegex("budgets.file-size +max 5,242,880 bytes +gltfx.toml:2\n"));
  EXPECT_THAT(all, ContainsRegex("budgets.mesh.name +match \\^A +gltfx.toml:4\n"));
  EXPECT_THAT(in("", {"config", "props/a.glb"}).out,
              ContainsRegex("budgets.triangles +max 5,000 +gltfx.toml:7\n"));
}

TEST_F(Budgets, StandInColumns) {
  folder_.write(
      "gltfx.toml",
      "budgets.nodes = 5\n[budgets.mesh]\nnon-manifold-vertices = { max = 1000, severity = "
      "\"warning\" }\nname = { match = \"^[A-Z][a-z]*[0-9]*_[A-Za-z0-9_]*_LOD[0-9]$\" }\n");
  const std::string all = in("", {"config"}).out;
  const auto column_of = [&](const std::string& text) {
    const std::size_t at = all.find(text);
    return at == std::string::npos ? at : at - all.rfind('\n', at);
  };
  EXPECT_NE(column_of("max 5"), std::string::npos);
  EXPECT_EQ(column_of("max 5"), column_of("max 1,000 (warning)"));
  EXPECT_EQ(column_of("max 5"), column_of("match ^[A-Z]"));
  EXPECT_EQ(column_of("gltfx.toml:1\n"), column_of("gltfx.toml:3\n"));
}

TEST_F(Budgets, OfPresetsNameTheirSource) {
  EXPECT_THAT(
      with("", {"a.gltf", "--preset", "ready-player-me/headwear"}),
      HasSubstr(
          "it must match '^Wolf3D_Headwear$' (preset ready-player-me/headwear, undated, read 2"));
  EXPECT_EQ(in("", {"validate", "a.gltf", "--preset", "x"}).code, 2);
}

TEST_F(Budgets, EveryPresetCanBeRead) {
  const auto all = nlohmann::json::parse(in("", {"presets", "--format", "json"}).out)["presets"];
  const std::string list = in("", {"presets"}).out;
  EXPECT_THAT(list, HasSubstr("\n" + std::to_string(all.size()) + " presets."));
  EXPECT_GE(all.size(), 30U);
  for (const auto& preset : all) {
    const std::string id = preset["id"];
    EXPECT_THAT(list, HasSubstr(id));
    EXPECT_FALSE(preset["limits"].empty()) << id;
    EXPECT_TRUE(preset["evidence"] == "page" || preset["evidence"] == "repository") << id;
    EXPECT_THAT(preset["source"].get<std::string>(), HasSubstr("https://")) << id;
    EXPECT_EQ(preset["read"].get<std::string>().size(), 10U) << id;
  }
  EXPECT_THAT(in("", {"presets", "khronos-3d-commerce/mobile-ar"}).out,
              AllOf(HasSubstr("dated: 1.0.0, 2020-10-20\n  read: 2"),
                    ContainsRegex("budgets.draw-calls +max 19 \\(warning\\)\n")));
  const Outcome unknown = in("", {"presets", "shopfy"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("Did you mean 'shopify'?"));
}

TEST_F(Budgets, MeasuresAreListedAndExplained) {
  const auto all = nlohmann::json::parse(in("", {"measures", "--format", "json"}).out)["measures"];
  const std::string list = in("", {"measures"}).out;
  for (const auto& measure : all) EXPECT_THAT(list, HasSubstr(measure["name"].get<std::string>()));
  EXPECT_THAT(in("", {"measures", "triangles"}).out,
              AllOf(HasSubstr("Definition"), HasSubstr("on: asset, mesh, primitive"),
                    HasSubstr("BUDGET_TRIANGLES")));
  EXPECT_THAT(in("", {"measures", "triangels"}).err, HasSubstr("Did you mean 'triangles'?"));
}

TEST_F(Budgets, OfTheAuditorAreImported) {
  folder_.write("auditor.json", R"({"version": "1.0.0",
    "fileSizeInKb": {"maximum": 2, "minimum": -1},
    "materials": {"maximum": 0, "minimum": 1},
    "model": {"requireCleanRootNodeTransform": true, "requireManifoldEdges": false,
              "triangles": {"maximum": 0, "minimum": 4}},
    "product": {"dimensions": {"length": {"maximum": 1, "minimum": 0.5, "percentTolerance": 3}}},
    "textures": {"requireDimensionsBePowersOfTwo": true, "requireDimensionsBeQuadratic": "true"}})");
  const Outcome outcome = in("", {"config", "import", "auditor.json"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("[budgets]\nfile-size = { max = 2048 }  # from KiB"));
  EXPECT_THAT(outcome.out, HasSubstr("\nmaterials = { min = 1, max = 0 }\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\ntriangles = { min = 4 }\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\nsize-x = { min = 0.5, max = 1 }  # length\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\nproduct-deviation-x = 3  # %"));
  EXPECT_THAT(outcome.out, HasSubstr("[budgets.scene]\nroot-transform = true\n"));
  EXPECT_THAT(outcome.out, HasSubstr("[budgets.image]\npower-of-two = true\naspect = 1\n"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("manifold")));
  EXPECT_THAT(outcome.err, HasSubstr("a maximum of 0 for triangles is no limit"));
  const std::string out = with(outcome.out);
  EXPECT_THAT(out, HasSubstr("error[BUDGET_TRIANGLES]"));
  EXPECT_THAT(out, HasSubstr("error[BUDGET_MATERIALS]"));
  folder_.write("other.json", "{\"version\": 1}");
  EXPECT_EQ(in("", {"config", "import", "other.json"}).code, 2);
  folder_.write("broken.json", "{");
  EXPECT_EQ(in("", {"config", "import", "broken.json"}).code, 2);
}

TEST_F(Budgets, OfProductsCompareWithAList) {
  folder_.write("products.csv",
                "file,size-x,size-y,size-z\r\n\"a.gltf\",1 m,,50 cm\nprops/a.gltf,,,\n");
  folder_.write("data.bin", std::string("\0\0\0\0\0\0\0\0\0\0\0\0"
                                        "\0\0\0\x40\0\0\0\0\0\0\0\0"
                                        "\0\0\0\0\0\0\x80\x3f\0\0\0\0",
                                        36));
  const std::string asset = R"({"asset": {"version": "2.0"}, "scene": 0,
    "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "buffers": [{"byteLength": 36, "uri": "data.bin"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3,
                   "min": [0, 0, 0], "max": [2, 1, 0]}]})";
  folder_.write("a.gltf", asset);
  const std::string text = "product = \"products.csv\"\n[budgets]\nproduct-deviation-x = 3\n";
  EXPECT_THAT(with(text), HasSubstr("The product-deviation-x of the asset is 100 %; the limit is 3 "
                                    "% (gltfx.toml:3)."));
  EXPECT_EQ(in("", {"validate", "a.gltf", "--product", "none.csv"}).code, 2);
  folder_.write("products.csv", "file,size-x\n");
  EXPECT_THAT(said(text), HasSubstr("the first line names the columns"));
  folder_.write("products.csv", "file,size-x,size-y,size-z\na,-1,1,1\n");
  EXPECT_THAT(said(text), HasSubstr("products.csv:2: '-1' is not above 0"));
  folder_.write("one.json", R"({"dimensions": {"length": 2, "width": -1, "height": 1}})");
  EXPECT_THAT(with("budgets.product-deviation = 1\n", {"a.gltf", "--product", "one.json"}),
              Not(HasSubstr("BUDGET_")));
}

}  // namespace
}  // namespace gltfx::program
