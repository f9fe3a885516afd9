// SPDX-License-Identifier: Apache-2.0
// Normals without a direction are computed from the faces.
#include <gltfx/pipeline.hpp>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"

namespace gltfx {
namespace {

using container::test::TempFolder;
using testing::ElementsAreArray;
using testing::FloatNear;
using testing::Pointwise;
using Floats = std::vector<float>;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

std::string raw_floats(const Floats& values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// A mesh of floats without indices; its normals are stored after its positions.
struct Mesh {
  Floats positions = {}, normals = {};
  std::string mode = "4";
  std::string more_primitives = {}, more_of_primitive = {}, more_accessors = {};
};

std::string text_of_mesh(const Mesh& mesh) {
  const std::size_t size = mesh.positions.size() * sizeof(float);
  return fmt::format(
      R"({{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "NORMAL": 1}}, "mode": {}{}}}{}]}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": {}, "min": [0, 0, 0], "max": [1, 1, 1]}},
{{"bufferView": 1, "componentType": 5126, "type": "VEC3", "count": {}}}{}],
"bufferViews": [{{"buffer": 0, "byteLength": {}, "target": 34962}},
{{"buffer": 0, "byteOffset": {}, "byteLength": {}, "target": 34962}}],
"buffers": [{{"byteLength": {}, "uri": "a.bin"}}]}})",
      mesh.mode, mesh.more_of_primitive, mesh.more_primitives, mesh.positions.size() / 3,
      mesh.positions.size() / 3, mesh.more_accessors, size, size, size, 2 * size);
}

// The normals after a run; `unsafe` ones of this rule are allowed. Nothing but they changes.
Floats normals_of(const Mesh& mesh, const char* unsafe = nullptr) {
  const TempFolder folder;
  const std::string before = raw_floats(mesh.positions) + raw_floats(mesh.normals);
  folder.write("a.bin", before);
  const auto path = folder.write("a.gltf", text_of_mesh(mesh));
  FixOptions options;
  options.in_place = true;
  options.only = {"ACCESSOR_VECTOR3_NON_UNIT", "ACCESSOR_INVALID_FLOAT"};
  options.unsafe = unsafe != nullptr;
  if (unsafe != nullptr) options.only = {unsafe};
  EXPECT_EQ(fix_file(path.native(), options).error, "");
  EXPECT_FALSE(fix_file(path.native(), options).changes);
  std::ifstream in(folder.path() / "a.bin", std::ios::binary);
  const std::string after{std::istreambuf_iterator<char>(in), {}};
  const std::size_t begin = before.size() / 2;
  EXPECT_EQ(after.substr(0, begin), before.substr(0, begin));
  Floats normals(mesh.normals.size());
  std::memcpy(normals.data(), after.data() + begin, begin);
  return normals;
}

// Two triangles that meet in the edge from vertex 0 to vertex 1: one looks along z, one along x.
const Floats kFold{0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1};
// A square as a strip.
const Floats kStrip{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
const Floats kUp{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};

TEST(FixNormals, ComeFromTheFacesIfNoneHasADirection) {
  const Floats unit{0, 0, 1, 0, 0, 1, 0, 0, 1};
  for (const float broken : {0.0F, kNaN}) {
    const Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0}, Floats(9, broken)};
    EXPECT_EQ(normals_of(mesh), unit);
  }
}

TEST(FixNormals, OfStripsAndFansFaceOneWay) {
  Mesh mesh{kStrip, Floats(12), "5"};
  EXPECT_EQ(normals_of(mesh), kUp);
  mesh.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  mesh.mode = "6";
  EXPECT_EQ(normals_of(mesh), kUp);
}

TEST(FixNormals, AreMeansByAngle) {
  Mesh mesh{kFold, Floats(12)};
  mesh.more_of_primitive = R"(, "indices": 2)";
  mesh.more_accessors =
      R"(,{"bufferView": 2, "componentType": 5121, "type": "SCALAR", "count": 6})";
  const TempFolder folder;
  std::string text = text_of_mesh(mesh);
  const std::string kViews = R"("target": 34962}],)";
  text.replace(text.find(kViews), kViews.size(),
               R"("target": 34962}, {"buffer": 1, "byteLength": 6, "target": 34963}],)");
  text.replace(text.find(R"("uri": "a.bin"})"), 15,
               R"("uri": "a.bin"}, {"byteLength": 6, "uri": "i.bin"})");
  folder.write("a.bin", raw_floats(mesh.positions) + raw_floats(mesh.normals));
  folder.write("i.bin", std::string("\0\2\1\0\1\3", 6));
  const auto path = folder.write("a.gltf", text);
  FixOptions options;
  options.in_place = true;
  EXPECT_EQ(fix_file(path.native(), options).error, "");
  std::ifstream in(folder.path() / "a.bin", std::ios::binary);
  const std::string after{std::istreambuf_iterator<char>(in), {}};
  Floats normals(12);
  std::memcpy(normals.data(), after.data() + 48, 48);
  const float diagonal = std::sqrt(0.5F);
  EXPECT_THAT(normals, Pointwise(FloatNear(1e-6F), Floats{diagonal, 0, diagonal, diagonal, 0,
                                                          diagonal, 0, 0, 1, 1, 0, 0}));
}

TEST(FixNormals, StayBesideSoundOnesUnlessAskedFor) {
  for (const float broken : {0.0F, kNaN}) {
    const Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 0, broken, broken, broken, 0, 1, 0}};
    const Floats left = normals_of(mesh);
    EXPECT_EQ(std::memcmp(left.data(), mesh.normals.data(), 36), 0);
    const char* const code = broken == 0 ? "ACCESSOR_VECTOR3_NON_UNIT" : "ACCESSOR_INVALID_FLOAT";
    EXPECT_EQ(normals_of(mesh, code), (Floats{0, 1, 0, 0, 0, 1, 0, 1, 0}));
  }
}

TEST(FixNormals, StayWhereNothingTellsThem) {
  const Floats zeros(12);
  // Points; faces that look both ways; a second primitive with positions of its own.
  EXPECT_EQ(normals_of({kStrip, zeros, "0"}), zeros);
  const Floats three{0, 0, 0, 1, 0, 0, 0, 1, 0};
  Mesh twice{three, Floats(9)};
  twice.mode = "5";
  twice.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0};
  twice.normals = zeros;
  EXPECT_EQ(normals_of(twice), zeros);
  Mesh other{kStrip, zeros, "5"};
  other.more_primitives = R"(, {"attributes": {"POSITION": 2, "NORMAL": 1}, "mode": 5})";
  other.more_accessors =
      R"(,{"componentType": 5126, "type": "VEC3", "count": 4, "min": [0, 0, 0], "max": [0, 0, 0]})";
  EXPECT_EQ(normals_of(other), zeros);
}

TEST(FixNormals, SumOverAllPrimitivesOfTheSameVertices) {
  Mesh mesh{kStrip, Floats(12), "5"};
  mesh.more_primitives = R"(, {"attributes": {"POSITION": 0, "NORMAL": 1}, "mode": 5})";
  EXPECT_EQ(normals_of(mesh), kUp);
}

}  // namespace
}  // namespace gltfx
