// SPDX-License-Identifier: Apache-2.0
#include <gltfx/version.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "report/support.hpp"

namespace gltfx::report::testing {
namespace {

using nlohmann::ordered_json;

ordered_json khronos(const FileReport& report) {
  return ordered_json::parse(run(ReportFormat::khronos, {report}));
}

std::vector<std::string> members(const ordered_json& object) {
  std::vector<std::string> names;
  for (const auto& item : object.items()) names.push_back(item.key());
  return names;
}

AssetInfo full_info() {
  AssetInfo info;
  info.version = "2.0";
  info.min_version = "2.0";
  info.generator = "a tool";
  info.extensions_used = {"KHR_a", "KHR_b"};
  info.extensions_required = {"KHR_a"};
  ResourceInfo buffer{"/buffers/0", "application/gltf-buffer", "glb", "", 1024, {}};
  ResourceInfo image{"/images/0", "image/png", "external", "a.png", {}, ResourceInfo::Image{}};
  image.image = ResourceInfo::Image{4, 8, 16, "rgba", "srgb", "linear"};
  info.resources = {buffer, image, ResourceInfo{"/buffers/1", "", "", "", {}, {}}};
  info.material_count = 3;
  info.has_skins = true;
  return info;
}

TEST(Khronos, PrintsOneObjectForOneFile) {
  EXPECT_EQ(run(ReportFormat::khronos, {file("leaf.gltf", {wrong_type()})}),
            fmt::format(R"({{
  "uri": "leaf.gltf",
  "mimeType": "model/gltf+json",
  "validatorVersion": "{}",
  "issues": {{
    "numErrors": 42,
    "numWarnings": 0,
    "numInfos": 0,
    "numHints": 0,
    "messages": [
      {{
        "code": "TYPE_MISMATCH",
        "message": "'metallicFactor' is a string; a number is expected.",
        "severity": 0,
        "pointer": "/materials/0/pbrMetallicRoughness/metallicFactor"
      }}
    ],
    "truncated": false
  }}
}}
)",
                        version()));
}

TEST(Khronos, PrintsAnArrayForSeveralFiles) {
  EXPECT_EQ(run(ReportFormat::khronos, {file("a", {}, ""), file("b", {}, "")}),
            fmt::format(R"([
  {{
    "uri": "a",
    "validatorVersion": "{0}",
    "issues": {{
      "numErrors": 0,
      "numWarnings": 0,
      "numInfos": 0,
      "numHints": 0,
      "messages": [],
      "truncated": false
    }}
  }},
  {{
    "uri": "b",
    "validatorVersion": "{0}",
    "issues": {{
      "numErrors": 0,
      "numWarnings": 0,
      "numInfos": 0,
      "numHints": 0,
      "messages": [],
      "truncated": false
    }}
  }}
]
)",
                        version()));
}

TEST(Khronos, KeepsTheOrderOfFilesAndPrintsNoneAsNone) {
  const auto parsed = ordered_json::parse(run(ReportFormat::khronos, sample_run()));
  std::vector<std::string> uris;
  for (const auto& report : parsed) uris.push_back(report["uri"]);
  EXPECT_THAT(uris, ::testing::ElementsAre("models/leaf.gltf", "clean.gltf", "tree.glb",
                                           "gone.gltf", "big.gltf"));
  EXPECT_EQ(run(ReportFormat::khronos, {}), "[]\n");
}

TEST(Khronos, WritesTheOffsetOfAContainerIssueInsteadOfAPointer) {
  const auto message = khronos(file("a.glb", {bad_chunk()}))["issues"]["messages"][0];
  EXPECT_THAT(members(message), ::testing::ElementsAre("code", "message", "severity", "offset"));
  EXPECT_EQ(message["offset"], 12);
}

TEST(Khronos, NumbersSeverities) {
  const auto issues =
      khronos(file("a", {finding("A", Severity::hint, "M."), finding("B", Severity::info, "M."),
                         finding("C", Severity::warning, "M.")}))["issues"];
  EXPECT_EQ(issues["messages"][0]["severity"], 3);
  EXPECT_EQ(issues["messages"][1]["severity"], 2);
  EXPECT_EQ(issues["messages"][2]["severity"], 1);
  EXPECT_EQ(issues["numHints"], 1);
  EXPECT_EQ(issues["numInfos"], 1);
  EXPECT_EQ(issues["numWarnings"], 1);
  EXPECT_EQ(issues["numErrors"], 0);
}

TEST(Khronos, CountsOnlyMessagesThatAreThereWhenCutShort) {
  const auto issues = khronos(sample_run().back())["issues"];
  EXPECT_EQ(issues["truncated"], true);
  EXPECT_EQ(issues["numInfos"], 1);
}

TEST(Khronos, TrimsMessagesOnTheRight) {
  const auto report = khronos(file("a", {finding("A", Severity::hint, " spaced out \n")}));
  EXPECT_EQ(report["issues"]["messages"][0]["message"], " spaced out");
}

std::string root_pointer(std::string_view code, std::string mime_type) {
  const auto report =
      khronos(file("a", {finding(code, Severity::error, "M.")}, std::move(mime_type)));
  return report["issues"]["messages"][0]["pointer"];
}

TEST(Khronos, PointsAtTheRootObjectWithASlash) {
  EXPECT_EQ(root_pointer("UNDEFINED_PROPERTY", "model/gltf+json"), "/");
  EXPECT_EQ(root_pointer("UNDEFINED_PROPERTY", "model/gltf-binary"), "/");
}

TEST(Khronos, PointsAtTheTextWithNothing) {
  EXPECT_EQ(root_pointer("INVALID_JSON", ""), "");
  EXPECT_EQ(root_pointer("INVALID_JSON", "model/gltf+json"), "") << "a byte order mark";
  EXPECT_EQ(root_pointer("INVALID_JSON", "model/gltf-binary"), "");
  EXPECT_EQ(root_pointer("TYPE_MISMATCH", ""), "");
  EXPECT_EQ(root_pointer("TYPE_MISMATCH", "model/gltf-binary"), "");
}

TEST(Khronos, WritesInfoInItsOrder) {
  FileReport report = file("a.glb", {}, "model/gltf-binary");
  report.info = full_info();
  const auto parsed = khronos(report);
  EXPECT_THAT(members(parsed),
              ::testing::ElementsAre("uri", "mimeType", "validatorVersion", "issues", "info"));
  EXPECT_THAT(members(parsed["info"]),
              ::testing::ElementsAre(
                  "version", "minVersion", "generator", "extensionsUsed", "extensionsRequired",
                  "resources", "animationCount", "materialCount", "hasMorphTargets", "hasSkins",
                  "hasTextures", "hasDefaultScene", "drawCallCount", "totalVertexCount",
                  "totalTriangleCount", "maxUVs", "maxInfluences", "maxAttributes"));
  EXPECT_EQ(parsed["info"]["extensionsUsed"], (ordered_json{"KHR_a", "KHR_b"}));
  EXPECT_EQ(parsed["info"]["materialCount"], 3);
  EXPECT_EQ(parsed["info"]["hasSkins"], true);
  EXPECT_EQ(parsed["info"]["hasTextures"], false);
}

TEST(Khronos, WritesResourcesWithWhatIsKnownOfThem) {
  FileReport report = file("a.glb");
  report.info = full_info();
  const auto resources = khronos(report)["info"]["resources"];
  EXPECT_EQ(resources[0].dump(),
            R"({"pointer":"/buffers/0","mimeType":"application/gltf-buffer","storage":"glb",)"
            R"("byteLength":1024})");
  EXPECT_EQ(resources[1].dump(),
            R"({"pointer":"/images/0","mimeType":"image/png","storage":"external","uri":"a.png",)"
            R"("image":{"width":4,"height":8,"format":"rgba","primaries":"srgb",)"
            R"("transfer":"linear","bits":16}})");
  EXPECT_EQ(resources[2].dump(), R"({"pointer":"/buffers/1"})");
}

TEST(Khronos, LeavesOutWhatIsNotKnownOfAnImage) {
  FileReport report = file("a.glb");
  report.info.emplace();
  ResourceInfo image{"/images/0", "", "", "", {}, ResourceInfo::Image{1, 2, 1, "", "", ""}};
  report.info->resources = {image, image};
  report.info->resources[1].image->bits = 0;
  const auto resources = khronos(report)["info"]["resources"];
  EXPECT_EQ(resources[0]["image"].dump(), R"({"width":1,"height":2,"bits":1})");
  EXPECT_EQ(resources[1]["image"].dump(), R"({"width":1,"height":2})");
}

TEST(Khronos, LeavesEmptyInfoMembersOut) {
  FileReport report = file("a");
  report.info.emplace();
  report.info->version = "2.0";
  EXPECT_THAT(members(khronos(report)["info"]),
              ::testing::ElementsAre(
                  "version", "animationCount", "materialCount", "hasMorphTargets", "hasSkins",
                  "hasTextures", "hasDefaultScene", "drawCallCount", "totalVertexCount",
                  "totalTriangleCount", "maxUVs", "maxInfluences", "maxAttributes"));
}

}  // namespace
}  // namespace gltfx::report::testing
