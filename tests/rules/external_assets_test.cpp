// SPDX-License-Identifier: Apache-2.0
// Files and external assets of glTF 2.1: findings on them, and reports on the assets below an
// asset.
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/base64.hpp"
#include "container/glb3_builder.hpp"
#include "rules/verdict.hpp"

namespace gltfx::test {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

using Files = std::map<std::string, std::string>;

// An asset whose external assets are these files.
std::string parent(const std::vector<std::string>& uris, const std::string& more = {}) {
  std::string files;
  std::string assets;
  for (std::size_t i = 0; i < uris.size(); ++i) {
    const std::string comma = i == 0 ? "" : ",";
    files += comma + R"({"uri":")" + uris[i] + R"(","mimeType":"model/gltf+json")" + more + "}";
    assets += comma + R"({"file":)" + std::to_string(i) + "}";
  }
  return R"({"asset":{"version":"2.1"},"files":[)" + files + R"(],"externalAssets":[)" + assets +
         "]}";
}

const std::string kLeaf = R"({"asset":{"version":"2.1"}})";
const std::string kWrong = R"({"asset":{"version":"2.1"},"scenes":[{"nodes":[7]}]})";

std::string embedded(const std::string& text) {
  return "data:model/gltf+json;base64," + container::encode_base64(text);
}

FileReport check(const Files& files, const std::string& name = "a.gltf",
                 const ValidateOptions& options = {}) {
  MemoryAsset asset{files.at(name), name, AssetFormat::detect, {}};
  const auto known = std::make_shared<const Files>(files);
  asset.read = [known](const std::string& path) -> std::optional<std::string> {
    const auto file = known->find(path);
    return file == known->end() ? std::nullopt : std::optional(file->second);
  };
  asset.names = MemoryAsset::Names::paths;
  return validate_bytes(std::move(asset), options);
}

std::vector<std::string> problems_of(const FileReport& report) {
  std::vector<std::string> lines;
  for (const Diagnostic& each : report.diagnostics) {
    if (each.severity == Severity::info) continue;
    lines.push_back(std::string(each.code) + " " + each.pointer);
  }
  return lines;
}

std::vector<std::string> problems(const Files& files, const std::string& name = "a.gltf") {
  return problems_of(check(files, name));
}

std::string message_of(const FileReport& report, std::string_view code) {
  for (const Diagnostic& each : report.diagnostics) {
    if (each.code == code) return each.message;
  }
  return "none";
}

std::vector<std::string> paths_below(const FileReport& report) {
  std::vector<std::string> paths;
  for (const FileReport& each : report.external_assets) paths.push_back(each.path);
  return paths;
}

std::string file_of(const std::string& type, const std::string& uri) {
  return R"({"asset":{"version":"2.1"},"files":[{"uri":")" + uri + R"(","mimeType":")" + type +
         R"("}]})";
}

const std::string kMismatch = "FILE_MIME_TYPE_MISMATCH /files/0";

TEST(Files21, HaveTheirMediaType) {
  const std::string jpeg = "data:,%FF%D8%FF%E0%00%10JFIF%00%01%01%00";
  EXPECT_THAT(problems({{"a.gltf", file_of("image/jpeg", jpeg)}}), IsEmpty());
  for (const char* const type :
       {"image/png", "image/webp", "model/gltf-binary", "model/gltf+json", "application/json"}) {
    EXPECT_THAT(problems({{"a.gltf", file_of(type, jpeg)}}), ElementsAre(kMismatch)) << type;
  }
  for (const char* const type : {"text/plain", "application/x-mine", "application/gltf-buffer"}) {
    EXPECT_THAT(problems({{"a.gltf", file_of(type, jpeg)}}), IsEmpty()) << type;
  }
  EXPECT_THAT(problems({{"a.gltf", file_of("application/json", "data:,%20%5B1%5D")}}), IsEmpty());
  EXPECT_THAT(problems({{"a.gltf", file_of("model/gltf+json", "data:,%20%5B1%5D")}}),
              ElementsAre(kMismatch));
  EXPECT_THAT(problems({{"a.gltf", file_of("model/gltf+json", "data:,")}}), ElementsAre(kMismatch));
}

TEST(Files21, HaveTheMediaTypeOfTheirDataUri) {
  EXPECT_THAT(problems({{"a.gltf", file_of("text/plain", "data:image/png,a")}}),
              ElementsAre(kMismatch));
  EXPECT_THAT(problems({{"a.gltf", file_of("text/plain", "data:text/css,a")}}), IsEmpty());
}

TEST(Files21, AreReportedAsBuffersWhereTheyAreMissing) {
  EXPECT_THAT(problems({{"a.gltf", file_of("text/plain", "b.txt")}}),
              ElementsAre("IO_ERROR /files/0/uri"));
  EXPECT_THAT(problems({{"a.gltf", parent({"b.gltf"})}}), ElementsAre("IO_ERROR /files/0/uri"));
  EXPECT_THAT(problems({{"a.gltf", file_of("text/plain", "../b.txt")}}),
              ElementsAre("URI_OUTSIDE_ROOT /files/0/uri"));
  EXPECT_THAT(problems({{"a.gltf", file_of("text/plain", "data:;base64,@")}}),
              ElementsAre("INVALID_URI /files/0/uri"));
}

TEST(Files21, TakeAllOfTheirView) {
  const auto view = [](const std::string& members) {
    return R"({"asset":{"version":"2.1"},"files":[{"bufferView":0,"mimeType":"text/plain"}],)"
           R"("buffers":[{"byteLength":8,"uri":"data:application/octet-stream;base64,YWJjZGVmZ2g="}],)"
           R"("bufferViews":[{"buffer":0,"byteLength":8)" +
           members + "}]}";
  };
  EXPECT_THAT(problems({{"a.gltf", view("")}}), IsEmpty());
  EXPECT_THAT(problems({{"a.gltf", view(R"(,"byteStride":4)")}}),
              ElementsAre("BUFFER_VIEW_INVALID_BYTE_STRIDE /files/0/bufferView"));
  EXPECT_THAT(problems({{"a.gltf", view(R"(,"target":34962)")}}),
              ElementsAre("BUFFER_VIEW_TARGET_OVERRIDE /files/0/bufferView"));
}

TEST(ExternalAssetRules, AreCheckedUnderTheirOwnPath) {
  const FileReport report = check(
      {{"a.gltf", parent({"sub/b.gltf", "c.gltf"})}, {"sub/b.gltf", kWrong}, {"c.gltf", kLeaf}});
  EXPECT_THAT(problems_of(report), ElementsAre("EXTERNAL_ASSET_INVALID /externalAssets/0/file"));
  EXPECT_EQ(message_of(report, "EXTERNAL_ASSET_INVALID"),
            "The external asset 'sub/b.gltf' has 1 error.");
  EXPECT_THAT(paths_below(report), ElementsAre("sub/b.gltf", "c.gltf"));
  ASSERT_EQ(report.external_assets.size(), 2U);
  EXPECT_THAT(problems_of(report.external_assets[0]),
              ElementsAre("UNRESOLVED_REFERENCE /scenes/0/nodes/0"));
}

TEST(ExternalAssetRules, MakeAllAboveThemInvalid) {
  const FileReport report =
      check({{"a.gltf", parent({"b.gltf"})}, {"b.gltf", parent({"c.gltf"})}, {"c.gltf", "{"}});
  const auto found = ElementsAre("EXTERNAL_ASSET_INVALID /externalAssets/0/file");
  EXPECT_THAT(problems_of(report), found);
  EXPECT_THAT(paths_below(report), ElementsAre("b.gltf", "c.gltf"));
  EXPECT_THAT(problems_of(report.external_assets[0]), found);
}

TEST(ExternalAssetRules, OfVersion20HaveItsRules) {
  const std::string old = R"({"asset":{"version":"2.0"},"externalAssets":[{"file":0}],)"
                          R"("files":[{"uri":"b.gltf","mimeType":"model/gltf+json"}]})";
  const FileReport report = check({{"a.gltf", parent({"b.gltf"})}, {"b.gltf", old}});
  EXPECT_THAT(problems_of(report), IsEmpty());
  ASSERT_EQ(report.external_assets.size(), 1U);
  EXPECT_THAT(problems_of(report.external_assets[0]),
              ElementsAre("UNEXPECTED_PROPERTY /externalAssets", "UNEXPECTED_PROPERTY /files"));
}

TEST(ExternalAssetRules, InsideAFileHaveItsPlaceAndFolder) {
  const FileReport report =
      check({{"x/a.gltf", parent({embedded(parent({"b.gltf"}))})}, {"b.gltf", kWrong}}, "x/a.gltf");
  EXPECT_THAT(problems_of(report), ElementsAre("EXTERNAL_ASSET_INVALID /externalAssets/0/file"));
  EXPECT_THAT(paths_below(report), ElementsAre("x/a.gltf#/files/0", "x/b.gltf"));
}

TEST(ExternalAssetRules, AreNothingInTheKhronosProfile) {
  ValidateOptions options;
  options.profile = Profile::khronos;
  const FileReport report =
      check({{"a.gltf", parent({"b.gltf"})}, {"b.gltf", kWrong}}, "a.gltf", options);
  EXPECT_THAT(report.external_assets, IsEmpty());
  EXPECT_EQ(report.counts.errors, 0U);
}

const auto kCycle = ElementsAre("EXTERNAL_ASSET_CYCLE /externalAssets/0");

TEST(ExternalCycles, AreFoundWhateverTheNameOfTheFile) {
  for (const char* const name : {"a.gltf", "./a.gltf", "sub/../a.gltf", "%61.gltf"}) {
    EXPECT_THAT(problems({{"a.gltf", parent({"b.gltf"})}, {"b.gltf", parent({name})}}), kCycle)
        << name;
  }
  EXPECT_THAT(problems({{"a.gltf", parent({"a.gltf"})}}), kCycle);
  EXPECT_THAT(problems({{"a.gltf", parent({"b/a.gltf"})}, {"b/a.gltf", parent({"../a.gltf"})}}),
              kCycle);
}

TEST(ExternalCycles, BelowTheAssetMakeItInvalid) {
  const FileReport report = check({{"a.gltf", parent({"b.gltf", "d.gltf"})},
                                   {"b.gltf", parent({"c.gltf"})},
                                   {"c.gltf", parent({"b.gltf"})},
                                   {"d.gltf", kLeaf}});
  EXPECT_THAT(problems_of(report), kCycle);
  EXPECT_EQ(message_of(report, "EXTERNAL_ASSET_CYCLE"),
            "The external asset leads into a cycle: 'b.gltf' > 'c.gltf' > 'b.gltf'.");
}

TEST(ExternalCycles, RunThroughEmbeddedAssetsAndAliases) {
  EXPECT_THAT(problems({{"a.gltf", parent({embedded(parent({"a.gltf"}))})}}), kCycle);
  const std::string alias = R"(,"aliases":[{"alias":"x.gltf","file":0}])";
  EXPECT_THAT(problems({{"a.gltf", parent({"b.gltf"}, alias)}, {"b.gltf", parent({"x.gltf"})}}),
              kCycle);
}

TEST(ExternalCycles, AreNoDiamondsNorNamesakes) {
  EXPECT_THAT(problems({{"a.gltf", parent({"b.gltf", "c.gltf", "b.gltf"})},
                        {"b.gltf", parent({"d.gltf"})},
                        {"c.gltf", parent({"d.gltf"})},
                        {"d.gltf", kLeaf}}),
              IsEmpty());
  EXPECT_THAT(problems({{"a.gltf", parent({"s/a.gltf"})}, {"s/a.gltf", kLeaf}}), IsEmpty());
  // The alias leads elsewhere.
  const std::string away =
      R"({"asset":{"version":"2.1"},"externalAssets":[{"file":0}],"files":[)"
      R"({"uri":"b.gltf","mimeType":"model/gltf+json","aliases":[)"
      R"({"alias":"a.gltf","file":1}]},{"uri":"d.gltf","mimeType":"model/gltf+json"}]})";
  EXPECT_THAT(problems({{"a.gltf", away}, {"b.gltf", parent({"a.gltf"})}, {"d.gltf", kLeaf}}),
              IsEmpty());
}

TEST(ExternalCycles, OfManyFilesAreNamedInShort) {
  Files files;
  constexpr int kFiles = 1000;
  for (int i = 0; i < kFiles; ++i) {
    const std::string name = i == 0 ? "a" : std::to_string(i);
    const int next = (i + 1) % kFiles;
    files[name + ".gltf"] = parent({(next == 0 ? "a" : std::to_string(next)) + ".gltf"});
  }
  const FileReport report = check(files);
  EXPECT_THAT(problems_of(report), kCycle);
  EXPECT_EQ(report.external_assets.size(), kFiles - 1);
  EXPECT_THAT(message_of(report, "EXTERNAL_ASSET_CYCLE"),
              EndsWith("'3.gltf' > (992 more) > '996.gltf' > '997.gltf' > '998.gltf' > "
                       "'999.gltf' > 'a.gltf'."));
}

// A GLB inside a GLB, and so on.
std::string package(int depth) {
  if (depth == 0) return kLeaf;
  const std::string inner = package(depth - 1);
  const std::string size = std::to_string(inner.size());
  const std::string type = depth == 1 ? "model/gltf+json" : "model/gltf-binary";
  const std::string text = R"({"asset":{"version":"2.1"},"buffers":[{"byteLength":)" + size +
                           R"(,"chunk":1}],"bufferViews":[{"buffer":0,"byteLength":)" + size +
                           R"(}],"files":[{"bufferView":0,"mimeType":")" + type +
                           R"("}],"externalAssets":[{"file":0}]})";
  return container::test::glb3({{container::kChunkJson, text}, {container::kChunkBin, inner}});
}

TEST(ExternalLimits, HoldForDeepPackages) {
  const FileReport whole = check({{"a.glb", package(5)}}, "a.glb");
  EXPECT_THAT(problems_of(whole), IsEmpty());
  ASSERT_EQ(whole.external_assets.size(), 5U);
  EXPECT_EQ(whole.external_assets[1].path, "a.glb#/files/0#/files/0");
  const FileReport deep = check({{"a.glb", package(70)}}, "a.glb");
  EXPECT_EQ(deep.counts.errors, 0U);
  ASSERT_EQ(deep.external_assets.size(), 64U);
  EXPECT_THAT(message_of(deep.external_assets.back(), "EXTERNAL_ASSET_INVALID"),
              HasSubstr("inside more than 64 others"));
}

TEST(ExternalLimits, HoldForTheSameFileWithOtherAliases) {
  std::string files;
  std::string assets;
  constexpr int kTimes = 40;
  for (int i = 0; i < kTimes; ++i) {
    files += R"({"uri":"b.gltf","mimeType":"model/gltf+json","aliases":[{"alias":")" +
             std::to_string(i) + R"(","file":)" + std::to_string(kTimes) + "}]},";
    assets += (i == 0 ? "" : ",") + (R"({"file":)" + std::to_string(i) + "}");
  }
  const std::string large =
      R"({"asset":{"version":"2.1"},"extras":")" + std::string(std::size_t{4} << 20U, 'a') + "\"}";
  const FileReport report = check(
      {{"a.gltf", R"({"asset":{"version":"2.1"},"externalAssets":[)" + assets + R"(],"files":[)" +
                      files + R"({"uri":"data:,a","mimeType":"text/plain"}]})"},
       {"b.gltf", large}});
  EXPECT_EQ(report.counts.errors, 0U);
  EXPECT_THAT(message_of(report, "EXTERNAL_ASSET_INVALID"), HasSubstr("16 times"));
  EXPECT_LT(report.external_assets.size(), kTimes);
}

TEST(Aliases21, WithoutEffectAreNamed) {
  const auto with = [](const std::string& type, const std::string& aliases) {
    return R"({"asset":{"version":"2.1"},"externalAssets":[{"file":0}],"files":[{"uri":"b.gltf",)"
           R"("mimeType":")" +
           type + R"(","aliases":[)" + aliases +
           R"(]},{"uri":"data:,a","mimeType":"text/plain"}]})";
  };
  const std::string child = file_of("text/plain", "x.txt");
  const std::string alias = R"({"alias":"x.txt","file":1})";
  EXPECT_THAT(problems({{"a.gltf", with("model/gltf+json", alias)}, {"b.gltf", child}}), IsEmpty());
  EXPECT_THAT(
      problems({{"a.gltf", with("model/gltf+json", alias + "," + alias)}, {"b.gltf", child}}),
      ElementsAre("ALIAS_WITHOUT_EFFECT /files/0/aliases/1/alias"));
  EXPECT_THAT(problems({{"a.gltf", with("text/plain", alias)}, {"b.gltf", child}}),
              testing::Contains("ALIAS_WITHOUT_EFFECT /files/0/aliases"));
  ValidateOptions strict;
  strict.profile = Profile::strict;
  const std::string other = R"({"alias":"./x.txt","file":1})";
  EXPECT_THAT(problems_of(check(
                  {{"a.gltf", with("model/gltf+json", alias + "," + other)}, {"b.gltf", child}},
                  "a.gltf", strict)),
              testing::Contains("ALIAS_WITHOUT_EFFECT /files/0/aliases/1/alias"));
}

}  // namespace
}  // namespace gltfx::test
