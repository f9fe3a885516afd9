// SPDX-License-Identifier: Apache-2.0
// Limits on measures.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "measure/limit.hpp"
#include "rules/textured.hpp"

namespace gltfx::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Limits as the command line has them.
std::vector<Limit> limits(const std::vector<std::string>& texts) {
  std::vector<Limit> all;
  for (const std::string& text : texts) {
    const auto changes = measure::read_budget(text, "test");
    EXPECT_TRUE(changes) << text << ": " << (changes ? std::string() : changes.error().message);
    if (!changes) continue;
    for (const measure::LimitChange& change : *changes) measure::apply(all, change);
  }
  return all;
}

ValidateOptions against(const std::vector<std::string>& texts) {
  ValidateOptions options;
  options.limits = limits(texts);
  return options;
}

FileReport report_on(const std::string& asset, const ValidateOptions& options) {
  return validate_bytes(asset, "test", options);
}

Lines limit_findings(const std::string& asset, const std::vector<std::string>& texts) {
  Lines lines;
  for (const std::string& line : verdict(asset, against(texts))) {
    if (line.starts_with("BUDGET_")) lines.push_back(line);
  }
  return lines;
}

// The first message about a limit.
std::string limit_message(const std::string& asset, const std::string& text) {
  for (const Diagnostic& found : report_on(asset, against({text})).diagnostics) {
    if (found.code.starts_with("BUDGET_")) return found.message;
  }
  return "nothing";
}

std::string image_of(std::uint32_t width, std::uint32_t height) {
  return png({}, {width, height, 8, 2, 0});
}

std::string two_images() { return Textured{base_color(), {image_of(4, 2), image_of(2, 8)}}.text(); }

// Two triangles of a mesh that two nodes draw, and three of one that is not drawn.
std::string two_meshes(const std::string& names = R"("A", "A")") {
  const std::size_t comma = names.find(", ");
  return asset_with(
      R"("scene": 0, "scenes": [{"nodes": [0, 1]}],
      "nodes": [{"mesh": 0}, {"mesh": 0}],
      "meshes": [{"name": )" +
      names.substr(0, comma) + R"(, "primitives": [{"attributes": {"POSITION": 0}}]},
                 {"name": )" +
      names.substr(comma + 2) +
      R"(, "primitives": [{"attributes": {"POSITION": 1}, "mode": 1}, {"attributes": {"POSITION": 1}}]}],
      "accessors": [{"componentType": 5126, "type": "VEC3", "count": 6, "min": [0, 0, 0], "max": [0, 0, 0]},
                    {"componentType": 5126, "type": "VEC3", "count": 9, "min": [0, 0, 0], "max": [0, 0, 0]}])");
}

TEST(Budget, NoneByDefault) {
  EXPECT_THAT(limit_findings(two_images(), {}), IsEmpty());
  EXPECT_THAT(report_on(two_images(), {}).requirements, IsEmpty());
}

TEST(Budget, OfEachElement) {
  EXPECT_THAT(limit_findings(two_images(), {"image.texture-size=8"}), IsEmpty());
  EXPECT_THAT(limit_findings(two_images(), {"image.texture-size=7"}),
              ElementsAre("BUDGET_TEXTURE_SIZE /images/1"));
  EXPECT_THAT(limit_findings(two_images(), {"image.texture-size=3"}),
              ElementsAre("BUDGET_TEXTURE_SIZE /images/0 x2"));
  EXPECT_THAT(limit_findings(two_meshes(), {"mesh.triangles=2"}),
              ElementsAre("BUDGET_TRIANGLES /meshes/1"));
  EXPECT_THAT(limit_findings(two_meshes(), {"primitive.mode.allow=TRIANGLES"}),
              ElementsAre("BUDGET_MODE /meshes/1/primitives/0"));
}

TEST(Budget, OfTheAssetStandsWhereItsValueIsFrom) {
  EXPECT_THAT(limit_findings(two_images(), {"total-pixels=24"}), IsEmpty());
  EXPECT_THAT(limit_findings(two_images(), {"total-pixels=23"}),
              ElementsAre("BUDGET_TOTAL_PIXELS "));
  EXPECT_THAT(limit_findings(two_meshes(), {"triangles=5"}), IsEmpty());
  EXPECT_THAT(limit_findings(two_meshes(), {"triangles=4"}),
              ElementsAre("BUDGET_TRIANGLES /meshes"));
  EXPECT_THAT(limit_findings(two_meshes(), {"meshes=1"}), ElementsAre("BUDGET_MESHES /meshes"));
  EXPECT_THAT(limit_findings(two_meshes(), {"draw-calls=2"}), IsEmpty());
  EXPECT_THAT(limit_findings(two_meshes(), {"draw-calls=1"}),
              ElementsAre("BUDGET_DRAW_CALLS /scenes/0"));
  EXPECT_THAT(limit_findings(two_meshes(), {"materials.min=1"}), ElementsAre("BUDGET_MATERIALS "));
}

TEST(Budget, OfBytesIncludesFilesOnce) {
  const container::test::TempFolder folder;
  const std::string asset = asset_with(
      R"("buffers": [{"byteLength": 8, "uri": "a.bin"}, {"byteLength": 8, "uri": "./a.bin"}])");
  folder.write("a.gltf", asset);
  folder.write("a.bin", "12345678");
  const auto found = [&](std::size_t limit) {
    ValidateOptions options = against({"file-size=" + std::to_string(limit)});
    options.select = {"BUDGET_FILE_SIZE"};
    return validate_file((folder.path() / "a.gltf").string(), options).diagnostics.size();
  };
  EXPECT_EQ(found(asset.size() + 8), 0U);
  EXPECT_EQ(found(asset.size() + 7), 1U);
}

TEST(Budget, SaysValueLimitAndSource) {
  EXPECT_EQ(limit_message(two_meshes(), "mesh.triangles=1"),
            "The mesh has 2 triangles; the limit is 1 (test).");
  EXPECT_EQ(limit_message(two_meshes(), "mesh.triangles=3.."),
            "The mesh has 2 triangles; the minimum is 3 (test).");
  EXPECT_EQ(limit_message(two_meshes(), "meshes.equal=1"),
            "The asset has 2 meshes; exactly 1 is required (test).");
  EXPECT_EQ(limit_message(two_images(), "image.texture-size=1"),
            "The texture-size of the image is 4 px; the limit is 1 px (test).");
  EXPECT_EQ(limit_message(two_images(), "image.pixels=1"),
            "The pixels of the image are 8 px; the limit is 1 px (test).");
  EXPECT_EQ(limit_message(two_images(), "image.channels.match=^L"),
            "The channels of the image are 'rgb'; they must match '^L' (test).");
  EXPECT_EQ(limit_message(two_images(), "image.channels.unique=true"),
            "The channels of the image are 'rgb', as are those of image 0 (test).");
  EXPECT_EQ(limit_message(two_images(), "image.channels.deny=rgb"),
            "The channels of the image are 'rgb'; they are not allowed (test).");
  EXPECT_EQ(limit_message(two_images(), "image.power-of-two.equal=false"),
            "For the image, power-of-two is true; it must be false (test).");
  EXPECT_EQ(limit_message(two_meshes(), "mesh.name.match=^SM_"),
            "The name of the mesh is 'A'; it must match '^SM_' (test).");
  EXPECT_EQ(limit_message(two_meshes(), "mesh.name.deny-match=A"),
            "The name of the mesh is 'A'; it must not match 'A' (test).");
  EXPECT_EQ(limit_message(two_meshes(), "mesh.name.unique=true"),
            "The name of the mesh is 'A', as is that of mesh 0 (test).");
  EXPECT_EQ(limit_message(two_meshes(), "primitive.mode.allow=POINTS,LINE_*"),
            "The mode of the primitive is 'TRIANGLES'; it must be POINTS or LINE_* (test).");
  EXPECT_EQ(limit_message(two_meshes(), "primitive.mode.deny=TRI*"),
            "The mode of the primitive is 'TRIANGLES'; it is not allowed (test).");
  EXPECT_EQ(limit_message(two_meshes(), "primitive.attributes.deny=POS*"),
            "The attributes of the primitive include 'POSITION', which is not allowed (test).");
  EXPECT_THAT(limit_message(two_meshes(), "file-size=0.1 kB"), HasSubstr("the limit is 100 bytes"));
}

// Ratios and amounts with a unit are values, whatever their name ends in.
TEST(Budget, OnlyCountsAreThingsThatAnElementHas) {
  EXPECT_EQ(limit_message(two_meshes(), "gpu-bytes=1"),
            "The gpu-bytes of the asset are 180 bytes; the limit is 1 byte (test).");
  EXPECT_EQ(limit_message(two_meshes(), "primitive.vertex-bytes=1"),
            "The vertex-bytes of the primitive are 12 bytes; the limit is 1 byte (test).");
  EXPECT_EQ(limit_message(two_meshes(), "unnamed=1"),
            "The asset has 2 objects without a name; the limit is 1 (test).");
  EXPECT_EQ(limit_message(two_meshes(R"("A", "")"), "unnamed=2"),
            "The asset has 3 objects without a name; the limit is 2 (test).");
}

// The value of the asset is that of one element.
TEST(Budget, TheLargestOfAllElementsIsThatOfOne) {
  EXPECT_EQ(limit_message(two_meshes(), "morph-targets=1.."),
            "A mesh of the asset has 0 morph targets; the minimum is 1 (test).");
  EXPECT_EQ(limit_message(two_meshes(), "mesh.morph-targets=1.."),
            "The mesh has 0 morph targets; the minimum is 1 (test).");
  EXPECT_EQ(limit_message(two_images(), "levels=0"),
            "An image of the asset has 1 level; the limit is 0 (test).");
}

TEST(Budget, NamesAreUniqueWhereTheyDiffer) {
  EXPECT_THAT(limit_findings(two_meshes(R"("A", "B")"), {"mesh.name.unique=true"}), IsEmpty());
}

TEST(Budget, OfTwoTiersAreTwoFindings) {
  ValidateOptions options = against({"mesh.triangles=1"});
  options.limits.push_back(options.limits.front());
  options.limits.back().number = 2;
  options.limits.front().severity = Severity::warning;
  options.select = {"BUDGET_TRIANGLES"};
  const FileReport report = report_on(two_meshes(), options);
  EXPECT_EQ(report.counts.warnings, 2U);
  EXPECT_EQ(report.counts.errors, 1U);
}

TEST(Budget, OfTwoParametersAreTwoFindings) {
  ValidateOptions options = against({"mesh.triangles=1"});
  options.limits.push_back(options.limits.front());
  options.limits.back().parameters.weld = 0.001;
  options.select = {"BUDGET_TRIANGLES"};
  const FileReport report = report_on(two_meshes(), options);
  EXPECT_THAT(report.diagnostics, testing::SizeIs(2));
  ASSERT_THAT(report.requirements, testing::SizeIs(4));
  EXPECT_EQ(report.requirements[0].parameters, "");
  EXPECT_EQ(report.requirements[2].parameters, "weld 0.001 m");
}

TEST(Budget, SeverityOfTheCodeComesFirst) {
  ValidateOptions options = against({"mesh.triangles=1"});
  options.severity.emplace("BUDGET_TRIANGLES", Severity::info);
  options.select = {"BUDGET_TRIANGLES"};
  EXPECT_EQ(report_on(two_meshes(), options).counts.infos, 2U);
  EXPECT_EQ(report_on(two_meshes(), options).requirements.front().severity, Severity::info);
  options.limits = limits({"mesh.triangles=9"});
  EXPECT_EQ(report_on(two_meshes(), options).requirements.front().severity, Severity::info);
  options.ignore.emplace("BUDGET_TRIANGLES");
  EXPECT_THAT(report_on(two_meshes(), options).requirements, IsEmpty());
}

// What is measured is made of many lines.
TEST(Budget, CountsWhenAnyLineChanged) {
  ValidateOptions options = against({"mesh.triangles=1"});
  options.select = {"BUDGET_TRIANGLES"};
  options.changed_lines.emplace();
  EXPECT_THAT(verdict(two_meshes(), options), IsEmpty());
  options.changed_lines = {{1, 1}};
  EXPECT_THAT(verdict(two_meshes(), options), ElementsAre("BUDGET_TRIANGLES /meshes/0 x2"));
}

TEST(Budget, ALongListOfWordsIsInFewRows) {
  std::string meshes, words;
  for (int i = 0; i < 1000; ++i) {
    meshes += i == 0 ? "{}" : ", {}";
    words += (i == 0 ? "w" : ",w") + std::to_string(i);
  }
  const FileReport report =
      report_on(asset_with("\"meshes\": [" + meshes + "]"), against({"mesh.name.allow=" + words}));
  EXPECT_LE(report.requirements.size(), 16U);
  EXPECT_EQ(report.requirements.size() + report.unlisted_requirements, 1000U);
}

TEST(Budget, TheKhronosProfileHasNone) {
  ValidateOptions options = against({"mesh.triangles=1"});
  options.profile = Profile::khronos;
  EXPECT_THAT(report_on(two_meshes(), options).requirements, IsEmpty());
}

TEST(Budget, ThatCannotBeCheckedIsAWarning) {
  ValidateOptions options = against({"file-size=100"});
  options.root = ".";
  options.select = {"BUDGET_NOT_MEASURED"};
  const FileReport report =
      report_on(asset_with(R"("buffers": [{"byteLength": 8, "uri": "missing.bin"}])"), options);
  ASSERT_EQ(report.requirements.size(), 1U);
  EXPECT_EQ(report.requirements[0].verdict, Verdict::not_measured);
  EXPECT_EQ(report.diagnostics.back().code, "BUDGET_NOT_MEASURED");
  EXPECT_EQ(report.diagnostics.back().message,
            "The limit on file-size of the asset (test) is not checked: the file of buffer 0 could "
            "not be read.");
}

std::vector<std::string> verdicts(const std::string& asset, const std::vector<std::string>& texts) {
  std::vector<std::string> rows;
  for (const Requirement& row : report_on(asset, against(texts)).requirements) {
    rows.push_back(row.on + '.' + row.measure + ' ' + row.op + ' ' + row.pointer + ' ' +
                   std::string(verdict_name(row.verdict)));
  }
  return rows;
}

TEST(Budget, RequirementsListWhatFailsElseTheNearest) {
  EXPECT_THAT(verdicts(two_meshes(), {"mesh.triangles=2"}),
              ElementsAre("mesh.triangles max /meshes/1 fail"));
  EXPECT_THAT(
      verdicts(two_meshes(), {"mesh.triangles=1"}),
      ElementsAre("mesh.triangles max /meshes/0 fail", "mesh.triangles max /meshes/1 fail"));
  EXPECT_THAT(
      verdicts(two_meshes(), {"mesh.triangles=1..9"}),
      ElementsAre("mesh.triangles min /meshes/0 pass", "mesh.triangles max /meshes/1 pass"));
  EXPECT_THAT(verdicts(two_meshes(), {"triangles=9", "image.texture-size=1"}),
              ElementsAre("asset.triangles max  pass", "image.texture-size max  not-applicable"));
}

TEST(Budget, FindingsCarryTheirLimit) {
  const FileReport report = report_on(two_meshes(), against({"mesh.triangles=1"}));
  ASSERT_FALSE(report.diagnostics.empty());
  const auto& limit = report.diagnostics.back().requirement;
  ASSERT_TRUE(limit);
  EXPECT_EQ(limit->value, CheckedValue(2.0));
  EXPECT_EQ(limit->limit, CheckedValue(1.0));
  EXPECT_EQ(limit->from, "test");
}

TEST(Budget, AThousandElementsMakeFewRows) {
  std::string images;
  for (int i = 0; i < 10'000; ++i) images += i == 0 ? "{}" : ", {}";
  const FileReport report = report_on(asset_with("\"meshes\": [" + images + "]"),
                                      against({"mesh.primitives=1..", "mesh.triangles=1.."}));
  EXPECT_LE(report.requirements.size(), 512U);
  EXPECT_EQ(report.requirements.size() + report.unlisted_requirements, 20'000U);
  EXPECT_LT(report.diagnostics.size(), 10U);
}

TEST(Budget, RoundingIsNoViolation) {
  const std::string asset = two_images();
  EXPECT_THAT(limit_findings(asset, {"image.aspect=1.9999999..4.0000001"}), IsEmpty());
  EXPECT_THAT(limit_findings(asset, {"image.aspect=3.9999990"}), IsEmpty());
  EXPECT_THAT(limit_findings(asset, {"image.aspect=3.99999"}),
              ElementsAre("BUDGET_ASPECT /images/1"));
}

TEST(Budget, OfProducts) {
  auto products = std::make_shared<ProductList>();
  products->others = {1, 0, 0};
  products->by_name["other"] = {2, 0, 0};
  const std::string asset(find_measure("product-deviation")->example);
  ValidateOptions options = against({"product-deviation=3 %"});
  options.select = {"BUDGET_PRODUCT_DEVIATION", "BUDGET_NOT_MEASURED"};
  EXPECT_THAT(verdict(example_bytes(asset), options), ElementsAre(HasSubstr("BUDGET_NOT_MEASURED")))
      << "no product";
  options.products = products;
  EXPECT_THAT(verdict(example_bytes(asset), options),
              ElementsAre("BUDGET_PRODUCT_DEVIATION /scenes/0"));
  EXPECT_THAT(validate_bytes(example_bytes(asset), "a/other", options).diagnostics, IsEmpty());
}

}  // namespace
}  // namespace gltfx::test
