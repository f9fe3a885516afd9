// SPDX-License-Identifier: Apache-2.0
/// Geometry compressed by Draco, tested from outside: the findings of decoding, and their places.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/support/draco_encoder.hpp"
#include "model/packed_bytes.hpp"
#include "rules/selected.hpp"

namespace gltfx::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Kind = DracoSource::Kind;
using Type = DracoSource::Type;

const std::string kDracoPrimitive = "/meshes/0/primitives/0";
const std::string kExtension = kDracoPrimitive + "/extensions/KHR_draco_mesh_compression";

// An asset with one compressed primitive. Members are text that a test may change.
struct Compressed {
  std::string payload;
  std::string names = R"("POSITION": 0)";  // attributes of the primitive, with their accessors
  std::string ids = R"("POSITION": 0)";    // attributes of the extension
  std::string accessors =
      R"({"componentType": 5126, "type": "VEC3", "count": 4, "min": [0, 0, 0], "max": [1, 1, 0]})";
  // The last accessor; empty: none.
  std::string indices = R"({"componentType": 5123, "type": "SCALAR", "count": 6})";
  std::string more = {};  // members of the primitive
  std::string root = {};  // members of the root object

  std::string text() const {
    std::size_t count = 0;
    for (const char c : accessors) count += c == '{' ? 1 : 0;
    const std::string use = indices.empty() ? "" : ", \"indices\": " + std::to_string(count);
    return R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_draco_mesh_compression"],
 "extensionsRequired": ["KHR_draco_mesh_compression"],
 "meshes": [{"primitives": [{"attributes": {)" +
           names + "}" + use + more +
           R"(, "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {)" +
           ids + R"(}}}}]}], "accessors": [)" + accessors + (indices.empty() ? "" : ", ") +
           indices + R"(], "bufferViews": [{"buffer": 0, "byteLength": )" +
           std::to_string(payload.size()) + R"(}], "buffers": [{"byteLength": )" +
           std::to_string(payload.size()) + R"(, "uri": ")" + buffer_uri(payload) + "\"}]" + root +
           "}";
  }
};

Compressed square() { return {draco_bytes(draco_square())}; }

// Findings of decoding and on the decoded data, without those on the rest of the asset.
Lines found(const Compressed& asset, Profile profile = Profile::standard) {
  Lines lines = verdict(asset.text(), profile);
  std::erase_if(lines, [](const std::string& line) {
    return !line.starts_with("DRACO_") && !line.starts_with("ACCESSOR_");
  });
  return lines;
}

// The square with an additional attribute, accessor 1, id 1.
struct Extra {
  std::string name;
  Kind kind = Kind::generic;
  Type type = Type::float32;
  unsigned components = 1;
  std::string bytes;
  std::string accessor;
  int bits = 0;
};
Compressed square_with(const Extra& extra) {
  DracoSource source = draco_square();
  source.attributes.push_back(
      {extra.kind, extra.type, extra.components, extra.bytes, 1, extra.bits, false});
  Compressed asset{draco_bytes(source)};
  asset.names += ", \"" + extra.name + "\": 1";
  asset.ids += ", \"" + extra.name + "\": 1";
  asset.accessors += ", " + extra.accessor;
  return asset;
}

TEST(Draco, SoundGeometryRaisesNothing) {
  EXPECT_EQ(found(square(), Profile::strict), Lines{});
  Compressed many{draco_bytes(draco_grid(40))};
  many.accessors =
      R"({"componentType": 5126, "type": "VEC3", "count": 1600, "min": [0, 0, 0], "max": [1, 1, 0]})";
  many.indices = R"({"componentType": 5125, "type": "SCALAR", "count": 9126})";
  EXPECT_EQ(found(many), Lines{});
}

TEST(Draco, TheKhronosProfileDoesNotDecode) {
  Compressed asset = square();
  asset.payload.resize(20);
  EXPECT_EQ(found(asset, Profile::khronos), Lines{});
  EXPECT_EQ(found(asset), Lines{"DRACO_DECODE_FAILED " + kExtension + "/bufferView"});
}

TEST(Draco, BytesThatAreNoMeshAreFoundAtTheBufferView) {
  const std::string whole = square().payload;
  std::string wrong_method = whole;
  wrong_method[8] = 9;
  std::string wrong_version = whole;
  wrong_version[5] = 9;
  std::string wrong_index = whole;
  wrong_index[14] = 77;  // the first index; each index has one byte
  for (const std::string& payload :
       {std::string("not Draco at all"), whole.substr(0, 5), whole.substr(0, 12),
        whole.substr(0, whole.size() - 1), draco_cloud_bytes(draco_square()), wrong_method,
        wrong_version, std::string(64, '\0'), wrong_index}) {
    Compressed asset = square();
    asset.payload = payload;
    const Lines lines = found(asset);
    ASSERT_EQ(lines.size(), 1U) << base64(payload);
    EXPECT_EQ(lines[0], "DRACO_DECODE_FAILED " + kExtension + "/bufferView") << base64(payload);
  }
}

TEST(Draco, APayloadThatPromisesTooMuchIsRefused) {
  Compressed asset = square();
  asset.payload = asset.payload.substr(0, 12) + "\xFF\xFF\xFF\xFF\x07" + asset.payload.substr(13);
  EXPECT_EQ(found(asset), Lines{"DRACO_LIMIT_EXCEEDED " + kExtension + "/bufferView"});
}

TEST(Draco, AnIdThatIsNotInTheBitstream) {
  Compressed asset = square();
  asset.ids = R"("POSITION": 3)";
  EXPECT_EQ(found(asset),
            Lines{"DRACO_ATTRIBUTE_ID_UNKNOWN " + kExtension + "/attributes/POSITION"});
}

TEST(Draco, AnotherComponentTypeOrNumberOfComponents) {
  const Lines wanted{"DRACO_FORMAT_MISMATCH " + kExtension + "/attributes/_A"};
  const Extra bytes{"_A",
                    Kind::generic,
                    Type::uint8,
                    4,
                    packed<std::uint8_t>(std::vector<std::uint8_t>(16, 1)),
                    R"({"componentType": 5123, "type": "VEC4", "count": 4})"};
  EXPECT_EQ(found(square_with(bytes)), wanted);
  Extra floats_as_bytes = bytes;
  floats_as_bytes.accessor = R"({"componentType": 5126, "type": "VEC4", "count": 4})";
  EXPECT_EQ(found(square_with(floats_as_bytes)), wanted);
  Extra signed_bytes = bytes;
  signed_bytes.accessor = R"({"componentType": 5120, "type": "VEC4", "count": 4})";
  EXPECT_EQ(found(square_with(signed_bytes)), wanted);
  Extra three = bytes;
  three.accessor = R"({"componentType": 5121, "type": "VEC3", "count": 4})";
  EXPECT_EQ(found(square_with(three)), wanted);
  const Extra wide{
      "_A", Kind::generic,         Type::float64,
      1,    std::string(32, '\0'), R"({"componentType": 5126, "type": "SCALAR", "count": 4})"};
  EXPECT_EQ(found(square_with(wide)), wanted);
  const Extra five{
      "_A", Kind::generic,         Type::uint8,
      5,    std::string(20, '\0'), R"({"componentType": 5121, "type": "VEC4", "count": 4})"};
  EXPECT_EQ(found(square_with(five)), wanted);
}

TEST(Draco, NormalizedIsWhatTheAccessorSays) {
  const Extra colors{"COLOR_0",
                     Kind::color,
                     Type::uint8,
                     4,
                     std::string(16, '\x7f'),
                     R"({"componentType": 5121, "type": "VEC4", "count": 4, "normalized": true})"};
  EXPECT_EQ(found(square_with(colors)), Lines{});
}

TEST(Draco, MoreOrFewerPointsThanTheAccessorsAreOneError) {
  for (const char* count : {"3", "5"}) {
    Compressed asset = square();
    asset.accessors = std::string(R"({"componentType": 5126, "type": "VEC3", "count": )") + count +
                      R"(, "min": [0, 0, 0], "max": [1, 1, 0]})";
    EXPECT_EQ(found(asset), Lines{"DRACO_COUNT_MISMATCH " + kExtension + "/attributes/POSITION"});
  }
}

TEST(Draco, MoreOrFewerIndicesThanTheAccessor) {
  for (const char* count : {"3", "9"}) {
    Compressed asset = square();
    asset.indices =
        std::string(R"({"componentType": 5123, "type": "SCALAR", "count": )") + count + "}";
    EXPECT_EQ(found(asset), Lines{"DRACO_COUNT_MISMATCH " + kDracoPrimitive + "/indices"});
  }
}

TEST(Draco, AnIndexTypeThatCannotCountThePoints) {
  Compressed asset{draco_bytes(draco_grid(17))};
  asset.accessors =
      R"({"componentType": 5126, "type": "VEC3", "count": 289, "min": [0, 0, 0], "max": [1, 1, 0]})";
  asset.indices = R"({"componentType": 5121, "type": "SCALAR", "count": 1536})";
  EXPECT_EQ(found(asset), Lines{"DRACO_INDEX_TYPE_TOO_SMALL " + kDracoPrimitive + "/indices"});
}

TEST(Draco, BoundsAreThoseOfTheDecodedValues) {
  Compressed asset = square();
  asset.accessors =
      R"({"componentType": 5126, "type": "VEC3", "count": 4, "min": [0, 0.5, 0], "max": [1, 1, 2]})";
  EXPECT_EQ(found(asset), (Lines{"ACCESSOR_MIN_MISMATCH /accessors/0/min/1",
                                 "ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND /accessors/0/min/1",
                                 "ACCESSOR_MAX_MISMATCH /accessors/0/max/2"}));
}

TEST(Draco, BoundsOfExactValuesMayBeALittleTooWide) {
  Compressed asset = square();
  const std::string begin = R"({"componentType": 5126, "type": "VEC3", "count": 4, "min": )";
  asset.accessors = begin + R"([-0.0078, 0, 0], "max": [1, 1.0078, 0]})";
  EXPECT_EQ(found(asset), Lines{});
  asset.accessors = begin + R"([0.0039, -0.0081, 0], "max": [1, 0.9961, 0]})";
  EXPECT_EQ(found(asset), (Lines{"ACCESSOR_MIN_MISMATCH /accessors/0/min/0 x2",
                                 "ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND /accessors/0/min/0",
                                 "ACCESSOR_MAX_MISMATCH /accessors/0/max/1",
                                 "ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND /accessors/0/max/1"}));
}

// Severity and message of the first finding with that code.
std::pair<Severity, std::string> first(const Compressed& asset, const std::string& code) {
  ValidateOptions options;
  options.select = {code};
  const FileReport report = validate_bytes(asset.text(), "test", options);
  if (report.diagnostics.empty()) return {Severity::hint, "nothing found"};
  return {report.diagnostics.front().severity, report.diagnostics.front().message};
}

TEST(Draco, WhatTheEncoderMayHaveChangedIsAWarning) {
  Compressed exact = square();
  exact.accessors =
      R"({"componentType": 5126, "type": "VEC3", "count": 4, "min": [0, 0, 0], "max": [1, 1, 2]})";
  const auto bound = first(exact, "ACCESSOR_MAX_MISMATCH");
  EXPECT_EQ(bound.first, Severity::error);
  EXPECT_THAT(bound.second, HasSubstr("after Draco decoding"));

  Compressed indices = square();
  indices.indices =
      R"({"componentType": 5123, "type": "SCALAR", "count": 6, "min": [1], "max": [7]})";
  for (const char* const code :
       {"ACCESSOR_MIN_MISMATCH", "ACCESSOR_MAX_MISMATCH", "ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND"}) {
    const auto found = first(indices, code);
    EXPECT_EQ(found.first, Severity::warning) << code;
    EXPECT_THAT(found.second, HasSubstr("after Draco decoding")) << code;
  }

  DracoSource source = draco_square();
  source.attributes[0].bits = 6;
  Compressed lossy{draco_bytes(source)};
  lossy.accessors = exact.accessors;
  EXPECT_EQ(first(lossy, "ACCESSOR_MAX_MISMATCH").first, Severity::warning);
}

TEST(Draco, BoundsMayBeAStepOfQuantisationOff) {
  DracoSource source = draco_grid(20);
  source.attributes[0].bits = 6;  // a step is 1/63
  Compressed asset{draco_bytes(source)};
  asset.indices = R"({"componentType": 5123, "type": "SCALAR", "count": 2166})";
  const std::string begin = R"({"componentType": 5126, "type": "VEC3", "count": 400, "min": )";
  asset.accessors = begin + R"([-0.0158, 0, 0], "max": [1.0079, 0.99, 0]})";
  EXPECT_EQ(found(asset), Lines{});
  asset.accessors = begin + R"([-0.02, 0, 0], "max": [1, 0.97, 0]})";
  EXPECT_EQ(found(asset), (Lines{"ACCESSOR_MIN_MISMATCH /accessors/0/min/0",
                                 "ACCESSOR_MAX_MISMATCH /accessors/0/max/1",
                                 "ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND /accessors/0/max/1"}));
}

TEST(Draco, ValuesAreCheckedAsPlainOnesAre) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::string vec3 = R"({"componentType": 5126, "type": "VEC3", "count": 4})";
  const std::string vec4 = R"({"componentType": 5126, "type": "VEC4", "count": 4})";
  const auto at = [](const std::string& code, const std::string& name) {
    return Lines{code + " " + kDracoPrimitive + "/attributes/" + name};
  };
  EXPECT_EQ(found(square_with({"NORMAL", Kind::normal, Type::float32, 3,
                               floats({0, 0, 1, 0, 0, 1, 0, 0, 2, 0, 0, 1}), vec3})),
            at("ACCESSOR_VECTOR3_NON_UNIT", "NORMAL"));
  EXPECT_EQ(found(square_with({"COLOR_0", Kind::color, Type::float32, 3,
                               floats({0, 0, 1, 0, 0, 1, 0, 0, 1.5F, 0, 0, 1}), vec3})),
            at("ACCESSOR_NON_CLAMPED", "COLOR_0"));
  Extra tangent{"TANGENT",
                Kind::generic,
                Type::float32,
                4,
                floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0.5F, 1, 0, 0, -1}),
                vec4};
  EXPECT_EQ(found(square_with(tangent)), at("ACCESSOR_INVALID_SIGN", "TANGENT"));
  EXPECT_EQ(found(square_with({"_A", Kind::generic, Type::float32, 1, floats({0, nan, 0, 0}),
                               R"({"componentType": 5126, "type": "SCALAR", "count": 4})"})),
            Lines{"ACCESSOR_INVALID_FLOAT /accessors/1"});
}

TEST(Draco, QuantisedVectorsMayBeAStepOff) {
  const std::string vec4 = R"({"componentType": 5126, "type": "VEC4", "count": 4})";
  const Extra tangent{
      "TANGENT",
      Kind::generic,
      Type::float32,
      4,
      floats({0.6F, 0.8F, 0, 1, 0.36F, 0.48F, 0.8F, -1, -0.6F, 0, 0.8F, 1, 0, -1, 0, 1}),
      vec4,
      6};
  EXPECT_EQ(found(square_with(tangent)), Lines{});
}

// A mesh with a skin of two joints; accessors 1 and 2 are joints and weights.
Compressed skinned(const std::vector<std::uint8_t>& joints, const std::string& weights, int bits) {
  DracoSource source = draco_square();
  source.attributes.push_back({Kind::generic, Type::uint8, 4, packed(joints), 1, 0, false});
  source.attributes.push_back({Kind::generic, Type::float32, 4, weights, 2, bits, false});
  Compressed asset{draco_bytes(source)};
  asset.names += R"(, "JOINTS_0": 1, "WEIGHTS_0": 2)";
  asset.ids += R"(, "JOINTS_0": 1, "WEIGHTS_0": 2)";
  asset.accessors += R"(, {"componentType": 5121, "type": "VEC4", "count": 4},
    {"componentType": 5126, "type": "VEC4", "count": 4})";
  asset.root = R"(, "skins": [{"joints": [1, 2]}], "nodes": [{"mesh": 0, "skin": 0}, {}, {}],
    "scenes": [{"nodes": [0, 1, 2]}], "scene": 0)";
  return asset;
}

TEST(Draco, JointsAndWeightsAreCheckedAsPlainOnesAre) {
  const std::vector<std::uint8_t> joints{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
  const std::string halves =
      floats({0.5F, 0.5F, 0, 0, 0.5F, 0.5F, 0, 0, 0.5F, 0.5F, 0, 0, 0.5F, 0.5F, 0, 0});
  EXPECT_EQ(found(skinned(joints, halves, 0)), Lines{});
  std::vector<std::uint8_t> too_many = joints;
  too_many[5] = 2;
  EXPECT_EQ(found(skinned(too_many, halves, 0))[0],
            "ACCESSOR_JOINTS_INDEX_OOB " + kDracoPrimitive + "/attributes/JOINTS_0");
  std::vector<std::uint8_t> twice = joints;
  twice[1] = 0;
  EXPECT_EQ(found(skinned(twice, halves, 0))[0],
            "ACCESSOR_JOINTS_INDEX_DUPLICATE " + kDracoPrimitive + "/attributes/JOINTS_0");
  const std::string uneven =
      floats({0.5F, 0.4F, 0, 0, 0.5F, 0.5F, 0, 0, 0.5F, 0.5F, 0, 0, 0.5F, 0.5F, 0, 0});
  EXPECT_EQ(found(skinned(joints, uneven, 0)),
            Lines{"ACCESSOR_WEIGHTS_NON_NORMALIZED " + kDracoPrimitive + "/attributes/WEIGHTS_0"});
  const std::string negative =
      floats({1.5F, -0.5F, 0, 0, 0.5F, 0.5F, 0, 0, 0.5F, 0.5F, 0, 0, 0.5F, 0.5F, 0, 0});
  EXPECT_THAT(found(skinned(joints, negative, 0)),
              Contains("ACCESSOR_WEIGHTS_NEGATIVE " + kDracoPrimitive + "/attributes/WEIGHTS_0"));
}

TEST(Draco, QuantisedWeightsNeedNotSumUpExactly) {
  const std::vector<std::uint8_t> joints{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
  const std::string weights =
      floats({0.7F, 0.3F, 0, 0, 0.333F, 0.667F, 0, 0, 0.999F, 0.001F, 0, 0, 0.123F, 0.877F, 0, 0});
  EXPECT_EQ(found(skinned(joints, weights, 8)), Lines{});
  const std::string uneven =
      floats({0.7F, 0.1F, 0, 0, 0.333F, 0.667F, 0, 0, 0.999F, 0.001F, 0, 0, 0.123F, 0.877F, 0, 0});
  EXPECT_EQ(found(skinned(joints, uneven, 8)),
            Lines{"ACCESSOR_WEIGHTS_NON_NORMALIZED " + kDracoPrimitive + "/attributes/WEIGHTS_0"});
}

TEST(Draco, DegenerateTrianglesAreCounted) {
  DracoSource source = draco_square();
  source.indices = {0, 1, 1, 2, 1, 3};
  Compressed asset{draco_bytes(source)};
  EXPECT_EQ(found(asset, Profile::strict),
            Lines{"ACCESSOR_INDEX_TRIANGLE_DEGENERATE " + kDracoPrimitive + "/indices"});
}

TEST(Draco, APlainCopyIsCheckedByItself) {
  Compressed asset = square();
  const std::string plain = floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 2, 0});
  asset.payload.resize(asset.payload.size() + (4 - asset.payload.size() % 4) % 4);
  const std::string offset = std::to_string(asset.payload.size());
  asset.payload += plain;
  asset.accessors =
      R"({"bufferView": 1, "componentType": 5126, "type": "VEC3", "count": 4, "min": [0, 0, 0], "max": [1, 1, 0]})";
  std::string text = asset.text();
  const std::string views = R"("bufferViews": [)";
  const std::size_t end = text.find("}]", text.find(views)) + 1;
  text.insert(end, R"(, {"buffer": 0, "byteOffset": )" + offset + R"(, "byteLength": 48})");
  EXPECT_THAT(verdict(text), Contains("ACCESSOR_MAX_MISMATCH /accessors/0/max/1"));
}

TEST(Draco, PrimitivesKeepTheirOrderAndShareABitstream) {
  Compressed asset = square();
  std::string text = asset.text();
  const std::string primitive = R"({"attributes": {"POSITION": 0}, "indices": 1,
   "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 9}}}})";
  const std::size_t end = text.find("]}], \"accessors\"");
  for (int i = 0; i < 3; ++i) text.insert(end, ", " + primitive);
  EXPECT_EQ(places(text, "DRACO_ATTRIBUTE_ID_UNKNOWN"),
            Lines{"/meshes/0/primitives/1/extensions/KHR_draco_mesh_compression/attributes/"
                  "POSITION x3"});
}

TEST(Draco, WhatIsMissingIsSaidOfTheBuffer) {
  const std::string text = R"({"asset": {"version": "2.0"},
    "extensionsUsed": ["KHR_draco_mesh_compression"], "extensionsRequired": ["KHR_draco_mesh_compression"],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0},
      "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}],
    "accessors": [{"componentType": 5126, "type": "VEC3", "count": 4, "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 99}],
    "buffers": [{"byteLength": 99, "uri": "data:application/octet-stream;base64,AAAA"}]})";
  for (const std::string& line : verdict(text)) EXPECT_THAT(line, Not(HasSubstr("DRACO")));
}

}  // namespace
}  // namespace gltfx::test
