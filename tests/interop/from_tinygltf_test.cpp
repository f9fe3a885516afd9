// SPDX-License-Identifier: Apache-2.0
// Models of tinygltf become assets: the written files, and refused models.
#include <array>
#include <cmath>

#include <gmock/gmock.h>

#include "container/temp_folder.hpp"
#include "support.hpp"

namespace gltfx::test {
namespace {

using container::test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

tinygltf::Model triangle() {
  tinygltf::Model model;
  const std::array<float, 9> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
  tinygltf::Buffer buffer;
  buffer.data.resize(sizeof(corners));
  std::memcpy(buffer.data.data(), corners.data(), sizeof(corners));
  model.buffers.push_back(buffer);
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteLength = sizeof(corners);
  model.bufferViews.push_back(view);
  tinygltf::Accessor accessor;
  accessor.bufferView = 0;
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.type = TINYGLTF_TYPE_VEC3;
  accessor.count = 3;
  accessor.minValues = {0, 0, 0};
  accessor.maxValues = {1, 1, 0};
  model.accessors.push_back(accessor);
  tinygltf::Primitive primitive;
  primitive.attributes["POSITION"] = 0;
  model.meshes.emplace_back();
  model.meshes[0].primitives.push_back(primitive);
  return model;
}

tinygltf::Image pixels(int component) {
  tinygltf::Image image;
  image.width = 2;
  image.height = 1;
  image.component = component;
  image.bits = 8;
  image.pixel_type = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
  for (int i = 0; i < 2 * component; ++i) {
    image.image.push_back(static_cast<unsigned char>(10 * (i + 1)));
  }
  return image;
}

struct Written {
  MemoryAsset asset;
  TinygltfReport report;
};

Written write(const tinygltf::Model& model, const std::string& name,
              const FromTinygltfOptions& options = {}) {
  Written written;
  written.asset.name = name;
  written.report = from_tinygltf(model, written.asset, options);
  return written;
}

TEST(FromTinygltf, WritesAGlb) {
  const Written back = write(triangle(), "a.GLB");
  ASSERT_TRUE(back.report.done) << problems(back.report);
  EXPECT_THAT(back.asset.files, IsEmpty());
  EXPECT_EQ(back.asset.bytes.substr(0, 4), "glTF");
  EXPECT_EQ(json_of(back.asset.bytes)["buffers"][0], nlohmann::json({{"byteLength", 36}}));
}

TEST(FromTinygltf, WritesBuffersBesideAGltf) {
  tinygltf::Model model = triangle();
  model.buffers.push_back(model.buffers[0]);
  model.buffers.push_back(model.buffers[0]);
  model.buffers[2].uri = "data/own%20name.bin";
  const Written back = write(model, "folder/a b.gltf");
  ASSERT_TRUE(back.report.done) << problems(back.report);
  const nlohmann::json buffers = json_of(back.asset.bytes)["buffers"];
  EXPECT_EQ(buffers[0]["uri"], "a%20b.bin");
  EXPECT_EQ(buffers[1]["uri"], "a%20b-1.bin");
  EXPECT_EQ(buffers[2]["uri"], "data/own%20name.bin");
  EXPECT_EQ(back.asset.files.count("a b.bin"), 1U);
  EXPECT_EQ(back.asset.files.count("data/own name.bin"), 1U);
}

TEST(FromTinygltf, EmbedsWhenAskedTo) {
  FromTinygltfOptions options;
  options.embed = true;
  tinygltf::Model model = triangle();
  model.buffers[0].uri = "a.bin";
  const Written back = write(model, "a.gltf", options);
  ASSERT_TRUE(back.report.done) << problems(back.report);
  EXPECT_THAT(back.asset.files, IsEmpty());
  EXPECT_THAT(std::string(json_of(back.asset.bytes)["buffers"][0]["uri"]),
              testing::StartsWith("data:application/octet-stream;base64,"));
}

TEST(FromTinygltf, NothingLeavesTheFolder) {
  for (const char* uri : {"../a.bin", "/a.bin", "file:///a.bin", "https://example.com/a.bin",
                          "a/../../a.bin", "data:,", "%2e%2e/a.bin"}) {
    tinygltf::Model model = triangle();
    model.buffers[0].uri = uri;
    const Written back = write(model, "a.gltf");
    ASSERT_TRUE(back.report.done) << uri << problems(back.report);
    EXPECT_THAT(back.asset.files, IsEmpty()) << uri;
    EXPECT_THAT(std::string(json_of(back.asset.bytes)["buffers"][0]["uri"]),
                testing::StartsWith("data:"));
  }
}

TEST(FromTinygltf, TwoBuffersInOneFileMustAgree) {
  tinygltf::Model model = triangle();
  model.buffers.push_back(model.buffers[0]);
  for (tinygltf::Buffer& buffer : model.buffers) buffer.uri = "one.bin";
  model.buffers[1].data.resize(12);
  const Written shared = write(model, "a.gltf");
  ASSERT_TRUE(shared.report.done) << problems(shared.report);
  EXPECT_THAT(shared.asset.files, SizeIs(1));
  model.buffers[1].data[0] = 7;
  EXPECT_THAT(write(model, "a.gltf").report.error, HasSubstr("/buffers/1"));
}

TEST(FromTinygltf, RefusesWhatIsNoValidGltf) {
  tinygltf::Model model = triangle();
  model.bufferViews[0].byteLength = 40;
  const Written back = write(model, "a.glb");
  EXPECT_FALSE(back.report.done);
  EXPECT_GT(back.report.validation.counts.errors, 0U);
  EXPECT_THAT(back.asset.bytes, IsEmpty());
}

TEST(FromTinygltf, AnEmptyModelIsAnEmptyAsset) {
  const Written back = write(tinygltf::Model(), "a.gltf");
  ASSERT_TRUE(back.report.done) << problems(back.report);
  EXPECT_EQ(back.asset.bytes, R"({"asset":{"version":"2.0"}})");
}

TEST(FromTinygltf, RefusesNumbersThatAreNone) {
  tinygltf::Model model = triangle();
  model.nodes.emplace_back();
  model.nodes[0].translation = {0, NAN, 0};
  EXPECT_FALSE(write(model, "a.gltf").report.done);
}

TEST(FromTinygltf, WritesNothingWhenItRefuses) {
  const TempFolder folder;
  tinygltf::Model model = triangle();
  model.accessors[0].count = 4;
  const std::string path = (folder.path() / "a.gltf").native();
  EXPECT_FALSE(from_tinygltf(model, path, {}).done);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(FromTinygltf, WritesFilesTheAssetLast) {
  const TempFolder folder;
  tinygltf::Model model = triangle();
  model.buffers[0].uri = "deep/er/a.bin";
  const std::string path = (folder.path() / "a.gltf").native();
  const TinygltfReport report = from_tinygltf(model, path, {});
  ASSERT_TRUE(report.done) << problems(report);
  EXPECT_THAT(report.written, ElementsAre((folder.path() / "deep/er/a.bin").native(), path));
  const tinygltf::Model again = model_of(path);
  EXPECT_TRUE(again.buffers.at(0).data == model.buffers[0].data);
}

TEST(FromTinygltf, AFolderThatCannotBeWrittenToIsNamed) {
  const TinygltfReport report = from_tinygltf(triangle(), "/dev/null/a.glb", {});
  EXPECT_FALSE(report.done);
  EXPECT_THAT(report.error, HasSubstr("/dev/null"));
}

TEST(FromTinygltf, PixelsBecomePng) {
  tinygltf::Model model = triangle();
  for (int component = 1; component <= 4; ++component) {
    model.images.push_back(pixels(component));
    model.images.back().uri = "wood" + std::to_string(component) + ".jpg";
  }
  const Written back = write(model, "a.gltf");
  ASSERT_TRUE(back.report.done) << problems(back.report);
  EXPECT_EQ(json_of(back.asset.bytes)["images"][2]["uri"], "wood3.png");
  EXPECT_EQ(pointers(back.report.notes, false), "/images/0\n/images/1\n/images/2\n/images/3\n");
  tinygltf::Model again;
  ASSERT_TRUE(to_tinygltf(back.asset, again, {}).done);
  EXPECT_THAT(again.images.at(0).image, ElementsAre(10, 10, 10, 255, 20, 20, 20, 255));
  EXPECT_THAT(again.images.at(1).image, ElementsAre(10, 10, 10, 20, 30, 30, 30, 40));
  EXPECT_THAT(again.images.at(2).image, ElementsAre(10, 20, 30, 255, 40, 50, 60, 255));
  EXPECT_THAT(again.images.at(3).image, ElementsAre(10, 20, 30, 40, 50, 60, 70, 80));
}

TEST(FromTinygltf, PixelsThatAreNoneAreRefused) {
  tinygltf::Model model = triangle();
  model.images.push_back(pixels(3));
  model.images[0].height = 2;
  EXPECT_THAT(write(model, "a.gltf").report.error, HasSubstr("/images/0 has other bytes"));
}

TEST(FromTinygltf, LightsBecomeTheirExtension) {
  tinygltf::Model model = triangle();
  model.lights.emplace_back();
  model.lights[0].type = "spot";
  model.lights[0].intensity = 4;
  model.extensions["KHR_lights_punctual"] = tinygltf::Value(tinygltf::Value::Object{
      {"lights", tinygltf::Value(tinygltf::Value::Array{})}, {"extras", tinygltf::Value(3)}});
  const Written back = write(model, "a.glb");
  ASSERT_TRUE(back.report.done) << problems(back.report);
  const nlohmann::json document = json_of(back.asset.bytes);
  EXPECT_THAT(document["extensionsUsed"], ElementsAre("KHR_lights_punctual"));
  const nlohmann::json& extension = document["extensions"]["KHR_lights_punctual"];
  EXPECT_EQ(extension["extras"], 3);
  EXPECT_EQ(extension["lights"][0]["intensity"], 4);
  EXPECT_TRUE(extension["lights"][0]["spot"].is_object());
}

TEST(FromTinygltf, ValuesThatJsonHasNoFormForAreNoted) {
  tinygltf::Model model = triangle();
  tinygltf::Value deep(1);
  for (int i = 0; i < 300; ++i) deep = tinygltf::Value(tinygltf::Value::Array{deep});
  model.extras = tinygltf::Value(tinygltf::Value::Object{
      {"binary", tinygltf::Value(std::vector<unsigned char>{1, 2})}, {"deep", deep}});
  const Written back = write(model, "a.glb");
  ASSERT_TRUE(back.report.done) << problems(back.report);
  ASSERT_THAT(back.report.notes, SizeIs(2));
  EXPECT_EQ(back.report.notes[0].pointer, "/extras/binary");
  EXPECT_TRUE(back.report.notes[1].lost);
}

}  // namespace
}  // namespace gltfx::test
