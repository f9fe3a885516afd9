// SPDX-License-Identifier: Apache-2.0
// Sizes, cameras and options at their limits, and files that are put together oddly.
#include <gmock/gmock.h>

#include "pipeline/baking.hpp"

namespace gltfx::test {
namespace {

using render::cube;
using render::quad;
using testing::HasSubstr;

using BakeLimits = Baking;

// What is drawn fills a good part of the picture whatever its size.
TEST_F(BakeLimits, EverySizeIsFramedAlike) {
  options.cameras.clear();
  options.background = {BakeBackground::Kind::transparent};
  std::vector<std::uint8_t> usual;
  for (const float size : {1.0F, 1e-12F, 1e-3F, 1e4F, 1e12F}) {
    AssetText asset;
    asset.draw(scaled(cube(), size), plastic());
    const BakeReport done = report(asset);
    ASSERT_EQ(done.problem, BakeProblem::none) << done.error;
    if (usual.empty()) usual = done.pixels.bytes;
    for (std::size_t i = 3; i < usual.size(); i += 4) {
      EXPECT_NEAR(usual[i], done.pixels.bytes[i], 40) << size;
    }
  }
}

TEST_F(BakeLimits, CamerasAtTheirLimits) {
  for (const Json& lens :
       {Json{{"yfov", 1e-30}, {"znear", 1e-30}},
        Json{{"yfov", 3.14159}, {"znear", 1e30}, {"zfar", 2e30}},
        Json{{"yfov", 0.5}, {"znear", 1}, {"zfar", 1.0000001}, {"aspectRatio", 1e-30}}}) {
    AssetText asset;
    asset.draw(cube(), plastic());
    asset.camera({{"type", "perspective"}, {"perspective", lens}}, {{"scale", {0, 0, 0}}});
    EXPECT_EQ(report(asset).problem, BakeProblem::none) << lens;
  }
  for (const double magnification : {0.0, -1.0, 1e-30, 1e30}) {
    AssetText asset;
    asset.draw(cube(), plastic());
    asset.camera({{"type", "orthographic"},
                  {"orthographic",
                   {{"xmag", magnification}, {"ymag", magnification}, {"znear", 0}, {"zfar", 0}}}},
                 {{"translation", {0, 0, 3}}});
    const BakeProblem problem = report(asset).problem;
    const bool drawn = problem == BakeProblem::none;
    EXPECT_TRUE(drawn || problem == BakeProblem::refused);
  }
}

TEST_F(BakeLimits, SizesAtTheirLimits) {
  AssetText asset;
  asset.draw(cube(), plastic());
  options.cameras.clear();
  options.samples = 1;
  for (const BakeSize size : {BakeSize{1, 1}, BakeSize{2048, 1}, BakeSize{1, 2048}}) {
    for (const bool denoise : {false, true}) {
      options.sizes = {size};
      options.denoise = denoise;
      EXPECT_EQ(report(asset).pixels.bytes.size(), std::size_t{size.width} * size.height * 3);
    }
  }
}

TEST_F(BakeLimits, WhatIsLeftOutIsSaidFirstAndRefusedWhenStrict) {
  AssetText asset;
  asset.draw(cube(), plastic());
  const int far = asset.add("nodes", {{"mesh", 0}, {"scale", {1e30, 1e30, 1e30}}});
  asset.node({{"children", {far}}, {"scale", {1e30, 1e30, 1e30}}});
  asset.json().erase("scene");
  asset.json()["scenes"].push_back({{"name", "another"}});
  options.cameras = {""};
  const BakeReport drawn = report(asset);
  EXPECT_EQ(drawn.problem, BakeProblem::none) << drawn.error;
  EXPECT_THAT(drawn.notes,
              testing::ElementsAre(HasSubstr("lies at infinity"), HasSubstr("the first one")));
  options.strict = true;
  const BakeReport refused = report(asset);
  EXPECT_EQ(refused.problem, BakeProblem::invalid);
  EXPECT_THAT(refused.error, HasSubstr("left out"));
  EXPECT_EQ(refused.notes, drawn.notes);
}

// What a caller of the library may hand over without a program that looks at it first.
TEST_F(BakeLimits, NumbersThatMakeNoPictureAreRefused) {
  AssetText asset;
  asset.draw(cube(), plastic());
  options.cameras.clear();
  const auto refused = [&](const auto& change, const char* expected) {
    const BakeOptions usual = options;
    change(options);
    const BakeReport done = report(asset);
    EXPECT_EQ(done.problem, BakeProblem::refused) << expected;
    EXPECT_THAT(done.error, HasSubstr(expected));
    options = usual;
  };
  refused([](BakeOptions& o) { o.sizes = {{0, 8}}; }, "size");
  refused([](BakeOptions& o) { o.sizes = {{8, 8}, {100000, 100000}}; }, "size");
  refused([](BakeOptions& o) { o.sizes = {{16384, 16384}}; }, "67108864 pixels in all");
  refused([](BakeOptions& o) { o.sizes.clear(); }, "size");
  refused([](BakeOptions& o) { o.samples = 0; }, "samples");
  refused([](BakeOptions& o) { o.samples = kMostBakeSamples + 1; }, "samples");
  refused([](BakeOptions& o) { o.exposure = NAN; }, "exposure");
  refused([](BakeOptions& o) { o.exposure = 1e9; }, "exposure");
}

// Chunks of odd length, twice, unknown, and bytes after the end: a thumbnail is written after the
// data that the asset refers to, and moves none of it.
TEST_F(BakeLimits, AThumbnailGoesIntoAGlbWithOddChunks) {
  options.cameras.clear();
  options.embed = true;
  const std::string kBin("BIN\0", 4);
  const auto chunk = [](const std::string& type, std::string data, char filler) {
    while (data.size() % 4 != 0) data += filler;
    return packed<std::uint32_t>({static_cast<std::uint32_t>(data.size())}) + type + data;
  };
  const std::string bin = packed(quad().positions) + packed(quad().triangles);
  const std::string json_text =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},)"
      R"({"bufferView":1,"componentType":5125,"count":6,"type":"SCALAR"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],)"
      R"("buffers":[{"byteLength":72}]})";
  const std::string json = chunk("JSON", json_text, ' ');
  const std::string second = chunk(kBin, "other", '\0');
  for (const std::string& rest :
       {std::string(), chunk("WHAT", "ever", ' '), second, second + "uncounted"}) {
    for (const std::string& more : {std::string(), std::string("!"), std::string("!!!!!")}) {
      const std::string first =
          packed<std::uint32_t>({static_cast<std::uint32_t>(bin.size() + more.size())}) + kBin +
          bin + more;
      std::string file = "glTF" + packed<std::uint32_t>({2, 0}) + json + first + rest;
      const auto length = static_cast<std::uint32_t>(file.size());
      std::memcpy(file.data() + 8, &length, 4);
      const std::string path = folder.write("odd.glb", file).native();
      const BakeReport done = bake_file(path, options);
      if (!done.embedded) {  // refused as it is: not a byte has changed
        EXPECT_FALSE(done.error.empty());
        EXPECT_EQ(file_content(path), file);
        continue;
      }
      const std::string now = file_content(path);
      std::uint32_t size = 0;
      std::memcpy(&size, now.data() + 12, 4);
      const Json document = Json::parse(now.substr(20, size));
      const std::string data = now.substr(20 + size + 8);
      EXPECT_EQ(data.substr(0, bin.size()), bin);
      const Json& view = document["bufferViews"].back();
      EXPECT_GE(view["byteOffset"].get<std::size_t>(), bin.size());
      EXPECT_EQ(data.substr(view["byteOffset"], 4), "\x89PNG");
      EXPECT_EQ(bake_file(path, options).pixels.bytes, done.pixels.bytes);
    }
  }
}

}  // namespace
}  // namespace gltfx::test
