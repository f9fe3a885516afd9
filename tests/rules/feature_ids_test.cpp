// SPDX-License-Identifier: Apache-2.0
// Feature IDs: in attributes, in textures, by the order of vertices.
#include <algorithm>

#include <gtest/gtest.h>

#include "rules/data_asset.hpp"
#include "rules/metadata_findings.hpp"
#include "rules/textured.hpp"

namespace gltfx::test {
namespace {

/// A triangle with a set of feature IDs.
std::string id_features(const std::string& set, const std::string& ids = floats({0, 1, 1}),
                        const std::string& table = {}, const std::string& format = {}) {
  DataAsset data;
  data.accessor("VEC3", kFloat, 3, floats({0, 0, 0, 1, 0, 0, 0, 1, 0}),
                R"(, "min": [0, 0, 0], "max": [1, 1, 0])");
  data.accessor("SCALAR", kFloat, 3, ids, format);
  const std::string tables =
      table.empty() ? ""
                    : R"(, "extensions": {"EXT_structural_metadata": {"schema": {"id": "s",
                      "classes": {"c": {}}}, "propertyTables": [{"class": "c", "count": )" +
                          table + "}]}}";
  return data.text(
      R"("extensionsUsed": ["EXT_mesh_features", "EXT_structural_metadata"],
    "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], )" +
      mesh(R"("POSITION": 0, "_FEATURE_ID_0": 1)",
           R"(, "extensions": {"EXT_mesh_features": {"featureIds": [{)" + set + "}]}}") +
      tables);
}
const std::string kIdSet = "/meshes/0/primitives/0/extensions/EXT_mesh_features/featureIds/0";

TEST(FeatureIds, AreCounted) {
  EXPECT_EQ(metadata_findings(id_features(R"("featureCount": 2, "attribute": 0)")), Lines{});
  EXPECT_EQ(metadata_findings(id_features(R"("featureCount": 9, "attribute": 0)")), Lines{});
  const Lines wrong{"FEATURE_ID_COUNT_MISMATCH " + kIdSet + "/featureCount"};
  EXPECT_EQ(metadata_findings(id_features(R"("featureCount": 1, "attribute": 0)")), wrong);
  EXPECT_EQ(
      metadata_findings(id_features(R"("featureCount": 1, "attribute": 0, "nullFeatureId": 0)")),
      Lines{});
  EXPECT_EQ(
      metadata_findings(id_features(R"("featureCount": 1, "attribute": 0, "nullFeatureId": 7)")),
      wrong);
  EXPECT_EQ(metadata_findings(id_features(R"("featureCount": 3)")), Lines{}) << "by vertex";
  EXPECT_EQ(metadata_findings(id_features(R"("featureCount": 2)")), wrong);
}

TEST(FeatureIds, AreRowsOfTheTable) {
  const std::string set = R"("featureCount": 3, "attribute": 0, "propertyTable": 0)";
  const Lines wrong{"FEATURE_ID_OOB " + kIdSet + "/propertyTable"};
  EXPECT_EQ(metadata_findings(id_features(set, floats({0, 1, 2}), "3")), Lines{});
  EXPECT_EQ(metadata_findings(id_features(set, floats({0, 1, 2}), "2")), wrong);
  EXPECT_EQ(metadata_findings(id_features(set + R"(, "nullFeatureId": 2)", floats({0, 1, 2}), "2")),
            Lines{});
  EXPECT_EQ(metadata_findings(
                id_features(R"("featureCount": 3, "propertyTable": 0)", floats({0, 1, 2}), "2")),
            wrong);
}

TEST(FeatureIds, AreWholeNumbers) {
  const Lines wrong{"FEATURE_ID_NOT_INTEGER " + kIdSet + "/attribute"};
  const std::string set = R"("featureCount": 3, "attribute": 0)";
  EXPECT_EQ(metadata_findings(id_features(set, floats({0, 0.5, 1}))), wrong);
  EXPECT_EQ(metadata_findings(id_features(set, floats({0, -1, 1}))), wrong);
  EXPECT_EQ(metadata_findings(id_features(set, floats({0, 1, 16777216}))), Lines{});
  EXPECT_EQ(metadata_findings(id_features(set, floats({0, 1, 16777218}))), wrong)
      << "the next integer is not a float";
}

TEST(FeatureIds, AttributesExist) {
  EXPECT_EQ(metadata_findings(id_features(R"("featureCount": 3, "attribute": 1)")),
            Lines{"FEATURE_ID_ATTRIBUTE_MISSING " + kIdSet + "/attribute"});
  EXPECT_EQ(metadata_findings(
                id_features(R"("featureCount": 3, "attribute": 0, "texture": {"index": 0})"))
                .front(),
            "ONE_OF_MISMATCH " + kIdSet);
}

std::string id_texture(const std::string& set, const std::string& image,
                       const std::string& sampler = "{}", const std::string& uv = "TEXCOORD_0") {
  DataAsset data;
  data.accessor("VEC3", kFloat, 3, floats({0, 0, 0, 1, 0, 0, 0, 1, 0}),
                R"(, "min": [0, 0, 0], "max": [1, 1, 0])");
  data.accessor("VEC2", kFloat, 3, floats({0, 0, 1, 0, 0, 1}));
  return data.text(
      R"("extensionsUsed": ["EXT_mesh_features"], "scene": 0, "scenes": [{"nodes":
    [0]}], "nodes": [{"mesh": 0}], "textures": [{"source": 0, "sampler": 0}], "samplers": [)" +
      sampler + R"(], "images": [{"uri": "data:image/png;base64,)" + base64(image) + R"("}], )" +
      mesh(R"("POSITION": 0, ")" + uv + R"(": 1)",
           R"(, "extensions": {"EXT_mesh_features": {"featureIds": [{)" + set + "}]}}"));
}

TEST(FeatureIds, TexturesHaveTheirChannels) {
  const std::string set = R"("featureCount": 9, "texture": {"index": 0, "channels": )";
  EXPECT_EQ(metadata_findings(id_texture(set + "[0, 1]}", rgb_png())), Lines{});
  EXPECT_EQ(metadata_findings(id_texture(set + "[3]}", rgb_png())),
            Lines{"DATA_TEXTURE_CHANNEL_MISSING " + kIdSet + "/texture/channels"});
  EXPECT_EQ(metadata_findings(id_texture(set + "[0, 1, 2, 0]}", rgb_png())),
            Lines{"DATA_TEXTURE_CHANNEL_MISSING " + kIdSet + "/texture/channels"});
  EXPECT_EQ(metadata_findings(id_texture(set + "[0]}", rgb_png(), R"({"magFilter": 9729})")),
            Lines{"DATA_TEXTURE_FILTER_INVALID " + kIdSet + "/texture/index"});
  const Lines lines = metadata_findings(id_texture(set + R"([0], "texCoord": 1})", rgb_png()));
  EXPECT_EQ(lines, Lines{"DATA_TEXTURE_TEXCOORD_MISSING " + kIdSet + "/texture"});
}

TEST(FeatureIds, TexturesHaveAnImageThatCanBeRead) {
  const std::string set = R"("featureCount": 9, "texture": {"index": 0, "channels": [0]})";
  const std::string finding = "DATA_TEXTURE_UNREADABLE " + kIdSet + "/texture/index";
  const auto has = [&](const std::string& image, PixelLevel pixels) {
    const Lines lines = metadata_findings(id_texture(set, image), pixels);
    return std::find(lines.begin(), lines.end(), finding) != lines.end();
  };
  const std::string image = rgb_png();
  EXPECT_FALSE(has(image, PixelLevel::needed));
  EXPECT_TRUE(has("no image", PixelLevel::headers));
  EXPECT_TRUE(has(image.substr(0, 20), PixelLevel::headers));
  std::string damaged = image;
  damaged[damaged.find("IDAT") + 5] ^= 0x55;
  EXPECT_TRUE(has(damaged, PixelLevel::needed));
}

TEST(FeatureIds, AnImageThatIsTooLargeIsNotDecoded) {
  const std::string set = R"("featureCount": 9, "texture": {"index": 0, "channels": [0]})";
  const std::string image = encode_png({8192, 8192, PngColor::rgba, 8, {}, {}});
  ValidateOptions options;
  options.pixels = PixelLevel::needed;
  EXPECT_EQ(validate_bytes(id_texture(set, image), "test", options).images_wanted, 0U);
}

TEST(FeatureIds, TexturesAreNotShownAsColors) {
  const std::string set = R"("featureCount": 9, "texture": {"index": 0, "channels": )";
  const auto shown_as = [&](const std::string& channels, const std::string& slot) {
    std::string text = id_texture(set + channels + "}", rgba_png());
    text.insert(1,
                R"("materials": [{"pbrMetallicRoughness": {")" + slot + R"(": {"index": 0}}}], )");
    const Lines lines = metadata_findings(text);
    return std::count(lines.begin(), lines.end(),
                      "DATA_TEXTURE_COLOR_SPACE " + kIdSet + "/texture/index");
  };
  EXPECT_EQ(shown_as("[0]", "baseColorTexture"), 1);
  EXPECT_EQ(shown_as("[0]", "metallicRoughnessTexture"), 0);
  EXPECT_EQ(shown_as("[3]", "baseColorTexture"), 0) << "alpha is linear";
}

TEST(FeatureIds, TexelsAreLookedAtWhenAskedFor) {
  const std::string set = R"("featureCount": 1, "texture": {"index": 0, "channels": [1]})";
  const std::string image = rgb_png("\1\2\3\1\4\3");
  EXPECT_EQ(metadata_findings(id_texture(set, image)), Lines{});
  EXPECT_EQ(metadata_findings(id_texture(set, image), PixelLevel::needed),
            Lines{"FEATURE_ID_COUNT_MISMATCH " + kIdSet + "/featureCount"});
  EXPECT_EQ(
      metadata_findings(id_texture(set + R"(, "nullFeatureId": 4)", image), PixelLevel::needed),
      Lines{});
}

}  // namespace
}  // namespace gltfx::test
