// SPDX-License-Identifier: Apache-2.0
// Fixes of the text alone, and those that take objects out.
#include <gltfx/pipeline.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "container/base64.hpp"
#include "container/temp_folder.hpp"

namespace gltfx {
namespace {

using container::test::TempFolder;

std::string content_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

FixOptions written_back() {
  FixOptions options;
  options.in_place = true;
  return options;
}

TEST(FixDocument, ReplacesATargetThatIsNone) {
  const auto with = [](const char* target) {
    return fmt::format(R"({{"asset":{{"version":"2.0"}},
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":3,"min":[0,0,0],"max":[0,0,0]}}],
"bufferViews":[{{"buffer":0,"byteLength":36,"target":{}}}],
"buffers":[{{"byteLength":36,"uri":"data:application/octet-stream;base64,{}"}}]}})",
                       target, container::encode_base64(std::string(36, '\0')));
  };
  const TempFolder folder;
  FixOptions options = written_back();
  options.only = {"BUFFER_VIEW_TARGET_MISSING",
                  "BUFFER_VIEW_TARGET_OVERRIDE"};  // the one is a hint
  for (const char* const none : {"34961", "\"x\""}) {
    const auto path = folder.write("a.gltf", with(none));
    EXPECT_EQ(fix_file(path.native(), options).error, "");
    EXPECT_EQ(content_of(path), with("34962"));
  }
}

TEST(FixDocument, DeclaresKnownExtensionsOnly) {
  const TempFolder folder;
  const auto path = folder.write("a.gltf", R"({"asset":{"version":"2.0"},"materials":[
{"extensions":{"KHR_materials_unlit":{}}},{"extensions":{"KHR_materials_unlti":{}}},{"extensions":{"name":{}}}]})");
  EXPECT_EQ(fix_file(path.native(), written_back()).error, "");
  EXPECT_NE(content_of(path).find(R"("extensionsUsed":["KHR_materials_unlit"]})"),
            std::string::npos)
      << content_of(path);
}

FixOptions by_name(const std::string& code) {
  FixOptions options = written_back();
  options.unsafe = true;
  options.only = {code};
  return options;
}

TEST(FixDocument, DeletesUnusedObjectsWithWhatOnlyTheyReferTo) {
  const TempFolder folder;
  const auto path =
      folder.write("a.gltf", fmt::format(R"({{"asset":{{"version":"2.0"}},
"materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}},
{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":1}}}}}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":1}}]}}],"nodes":[{{"mesh":0}}],
"scenes":[{{"nodes":[0]}}],
"accessors":[{{"componentType":5126,"type":"VEC3","count":3,"min":[0,0,0],"max":[0,0,0]}}],
"textures":[{{"sampler":0,"source":0}},{{"sampler":1,"source":0}}],"samplers":[{{}},{{"wrapS":33071}}],
"images":[{{"uri":"data:image/png;base64,{}"}}]}})",
                                         "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR42"
                                         "mP4DwABAQEAHLCMmQAAAABJRU5ErkJggg=="));
  const FixReport report = fix_file(path.native(), by_name("UNUSED_OBJECT"));
  EXPECT_EQ(report.error, "");
  const std::string text = content_of(path);
  EXPECT_NE(text.find(R"("baseColorTexture":{"index":0})"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("textures":[{"sampler":0,"source":0}])"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("samplers":[{"wrapS":33071}])"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("material":0)"), std::string::npos) << text;
}

// The second channel has no sampler and is deleted; the elements after it move up.
TEST(FixDocument, DeletesReferencesToNothingWithWhatNeedsThem) {
  const TempFolder folder;
  const std::string channel = R"({{"sampler":{},"target":{{"node":0,"path":"translation"}}}})";
  const auto path = folder.write(
      "a.gltf",
      fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":4,"scenes":[{{"nodes":[0,7]}}],
"nodes":[{{"extras":{{"mark":1}}}}],"animations":[{{"channels":[{},{}],"samplers":[{{"input":0,"output":1}}]}}],
"accessors":[{{"componentType":5126,"type":"SCALAR","count":1,"min":[0],"max":[0]}},
{{"componentType":5126,"type":"VEC3","count":1}}]}})",
                  fmt::format(fmt::runtime(channel), 0), fmt::format(fmt::runtime(channel), 3)));
  EXPECT_EQ(fix_file(path.native(), by_name("UNRESOLVED_REFERENCE")).error, "");
  const std::string text = content_of(path);
  EXPECT_EQ(text.find("\"scene\""), std::string::npos) << text;
  EXPECT_NE(text.find(R"("nodes":[0])"), std::string::npos) << text;
  EXPECT_EQ(text.find(R"("sampler":3)"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("sampler":0)"), std::string::npos) << text;
}

// The order of joints counts, so that they stay; of the two members with them the last one does.
TEST(FixDocument, WhatIsFoundInTheOtherCopyOfAMemberIsLeft) {
  const TempFolder folder;
  const auto path = folder.write("a.gltf", R"({"asset":{"version":"2.0"},"nodes":[{}],
"skins":[{"joints":[0,0]}],"skins":[{"joints":[0,0]}]})");
  const FixReport report = fix_file(path.native(), written_back());
  EXPECT_EQ(content_of(path),
            R"({"asset":{"version":"2.0"},"nodes":[{}],"skins":[{"joints":[0,0]}]})");
  ASSERT_EQ(report.actions.size(), 2U);
  EXPECT_EQ(report.actions[0].code, "JSON_DUPLICATE_KEY");
  EXPECT_TRUE(report.actions[0].done);
  EXPECT_EQ(report.actions[1].code, "DUPLICATE_ELEMENTS");
  EXPECT_FALSE(report.actions[1].done);
}

TEST(FixDocument, RemovesAllRepeatedNamesOfAList) {
  const TempFolder folder;
  const auto path = folder.write("a.gltf", R"({"asset":{"version":"2.0"},
"extensionsUsed":["KHR_materials_unlit", "KHR_materials_unlit", "KHR_texture_transform",
  "KHR_materials_unlit", "KHR_texture_transform"],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{}}}},
"extensions":{"KHR_materials_unlit":{}}}],"textures":[{}]})");
  EXPECT_EQ(fix_file(path.native(), written_back()).fixed(), 3U);
  EXPECT_NE(content_of(path).find(R"(["KHR_materials_unlit", "KHR_texture_transform"],)"),
            std::string::npos)
      << content_of(path);
}

TEST(FixDocument, DeletesNothingWhereAnUnknownExtensionMayHoldIndices) {
  const TempFolder folder;
  const auto path = folder.write("a.gltf", R"({"asset":{"version":"2.0"},"scene":4,
"extensionsUsed":["ACME_marks"],"scenes":[{"extensions":{"ACME_marks":{"scene":0}}}]})");
  const FixReport report = fix_file(path.native(), by_name("UNRESOLVED_REFERENCE"));
  EXPECT_FALSE(report.changes);
  ASSERT_EQ(report.actions.size(), 1U);
  EXPECT_NE(report.actions[0].why_not.find("ACME_marks"), std::string::npos);
}

}  // namespace
}  // namespace gltfx
