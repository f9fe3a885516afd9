// SPDX-License-Identifier: Apache-2.0
// A thumbnail is put into an asset: what is there already stays.
#include <gltfx/pipeline.hpp>

#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/base64.hpp"
#include "container/temp_folder.hpp"

namespace gltfx {
namespace {

using testing::HasSubstr;

const std::string kPixel =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR42mP4DwABAQEAHLCM"
    "mQAAAABJRU5ErkJggg==";

// A triangle and an image that is the thumbnail, and whatever else the members make of it.
std::string asset_with(const std::string& members, const std::string& image = "") {
  const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string bytes(reinterpret_cast<const char*>(corners), sizeof corners);
  return fmt::format(R"({{"asset":{{"version":"2.0","thumbnail":0}},"scene":0,
"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":3,"min":[0,0,0],"max":[1,1,0]}}],
"bufferViews":[{{"buffer":0,"byteLength":36}}],
"buffers":[{{"byteLength":36,"uri":"data:application/octet-stream;base64,{}"}}],
"images":[{{"uri":"{}"{}}}]{}}})",
                     container::encode_base64(bytes), kPixel, image, members);
}

std::string whole_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

BakeReport embed_into(const std::filesystem::path& path) {
  BakeOptions options;
  options.sizes = {{8, 8}};
  options.samples = 1;
  options.jobs = 1;
  options.embed = true;
  return bake_file(path.native(), options);
}

nlohmann::json embedded(const std::string& text) {
  const container::test::TempFolder folder;
  const auto path = folder.write("a.gltf", text);
  EXPECT_EQ(embed_into(path).error, "");
  return nlohmann::json::parse(whole_file(path));
}

TEST(BakeEmbed, TheOldThumbnailMakesRoom) {
  const nlohmann::json document = embedded(asset_with(""));
  EXPECT_EQ(document["images"].size(), 1U);
  EXPECT_NE(document["images"][0]["uri"], kPixel);
}

TEST(BakeEmbed, AnImageThatMayBeUsedElsewhereStays) {
  const std::string faces = "[0,0,0,0,0,0]";
  const std::string colors =
      "[[1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1],[1,1,1]]";
  for (const std::string& members : {
           std::string(R"(,"textures":[{"source":0}])"),
           fmt::format(R"(,"extensionsUsed":["EXT_lights_image_based"],"extensions":{{
"EXT_lights_image_based":{{"lights":[{{"irradianceCoefficients":{},"specularImageSize":1,
"specularImages":[{}]}}]}}}})",
                       colors, faces),
           std::string(R"(,"extensionsUsed":["KHR_lights_image_based"],"extensions":{
"KHR_lights_image_based":{"lights":[{"specularEnvironmentTexture":0,"image":0}]}})"),
           std::string(R"(,"extensionsUsed":["ACME_decals"],"extensions":{
"ACME_decals":{"decals":[{"image":0}]}})"),
           std::string(R"(,"textures":[{"extensions":{"EXT_texture_webp":{"source":0}}}],
"extensionsUsed":["EXT_texture_webp"])"),
       }) {
    const nlohmann::json document = embedded(asset_with(members));
    ASSERT_EQ(document["images"].size(), 2U) << members;
    EXPECT_EQ(document["images"][0], nlohmann::json({{"uri", kPixel}})) << members;
    EXPECT_EQ(document["asset"]["thumbnail"], 1) << members;
  }
}

TEST(BakeEmbed, WhatTheOldThumbnailSaysStays) {
  for (const char* const said : {R"(,"name":"front")", R"(,"extras":{"by":"me"})"}) {
    const nlohmann::json document = embedded(asset_with("", said));
    ASSERT_EQ(document["images"].size(), 2U) << said;
    EXPECT_EQ(document["images"][0]["uri"], kPixel) << said;
    EXPECT_EQ(document["asset"]["thumbnail"], 1) << said;
  }
}

TEST(BakeEmbed, AnIndexThatLeadsNowhereDoesNotGetThePicture) {
  const container::test::TempFolder folder;
  const std::string text =
      asset_with(R"(,"textures":[{"source":1}])", R"(,"name":"so that another one is added")");
  const auto path = folder.write("a.gltf", text);
  const BakeReport report = embed_into(path);
  EXPECT_FALSE(report.embedded);
  EXPECT_THAT(report.error, HasSubstr("an index of images leads nowhere"));
  EXPECT_EQ(whole_file(path), text);
}

}  // namespace
}  // namespace gltfx
