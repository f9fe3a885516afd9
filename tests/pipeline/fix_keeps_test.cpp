// SPDX-License-Identifier: Apache-2.0
// What safe fixes leave as it is: what is drawn, and what is written in only one place.
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

// The text of an asset after all safe fixes.
std::string after_safe_fixes(const std::string& text) {
  const container::test::TempFolder folder;
  const auto path = folder.write("a.gltf", text);
  FixOptions options;
  options.in_place = true;
  EXPECT_EQ(fix_file(path.native(), options).error, "");
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A camera at a place.
std::string node_with(const std::string& members) {
  return fmt::format(R"({{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],
"nodes":[{{"camera":0{}}}],
"cameras":[{{"type":"perspective","perspective":{{"yfov":1,"znear":1}}}}]}})",
                     members);
}

constexpr const char* kIdentity = R"(,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1])";
constexpr const char* kMoved = R"(,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 2,0,0,1])";

TEST(FixKeeps, TheFormOfATransformThatIsDrawn) {
  const struct {
    std::string before, after;
  } kCases[] = {
      {std::string(kIdentity) + R"(,"scale":[3,1,1])",
       std::string(kIdentity) + R"(,"scale":[3,1,1])"},
      {std::string(kMoved) + R"(,"scale":[3,1,1])", std::string(kMoved) + R"(,"scale":[3,1,1])"},
      {std::string(kMoved) + R"(,"scale":[1,1,1])", kMoved},
      {std::string(kMoved) + R"(,"translation":[2,0,0])", R"(,"translation":[2,0,0])"},
      {std::string(kIdentity) + R"(,"scale":[1,1,1])", ""},
      {kIdentity, ""},
      // The rotation is malformed, and drawn by others.
      {std::string(kIdentity) + R"(,"scale":[1,1,1],"rotation":[0,0,2,1])",
       std::string(kIdentity) + R"(,"scale":[1,1,1],"rotation":[0,0,2,1])"},
      {std::string(kMoved) + R"(,"scale":[1,1,1],"rotation":[0,0,2,1])",
       std::string(kMoved) + R"(,"scale":[1,1,1],"rotation":[0,0,2,1])"},
      // The last row of the matrix, too.
      {R"(,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 2,0,0,2],"translation":[2,0,0])",
       R"(,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 2,0,0,2],"translation":[2,0,0])"},
  };
  for (const auto& [before, after] : kCases) {
    const std::string text = after_safe_fixes(node_with(before));
    // What moves nothing may go by itself, too.
    const bool scale_goes = after.empty();
    if (scale_goes) {
      EXPECT_EQ(text.find("matrix"), text.npos) << before;
    } else {
      EXPECT_EQ(text, node_with(after)) << before;
    }
  }
}

std::string extras_with(const std::string& members) {
  return fmt::format(R"({{"asset":{{"version":"2.0"}},"extras":{{{}}}}})", members);
}

TEST(FixKeeps, ValuesThatAreNotExactlyEqual) {
  for (const char* const members : {
           R"("a":9007199254740993,"a":9007199254740992)",
           R"("a":[1,9007199254740993],"a":[1,9007199254740992])",
           R"("a":0.1,"a":0.10000000000000000001)",
           R"("a":1e-400,"a":2e-400)",
           R"("a":-0.0,"a":0)",
           R"("a":"\ud800","a":"\ud801")",
           R"("a":"\ud800","a":"\ufffd")",
           R"("\ud800":1,"\ud801":1)",
           R"("a":{"\ud800":1},"a":{"\ud801":1})",
           R"("a":{"b":1,"b":2},"a":{"b":2})",
           R"("a":1,"a":"1")",
           R"("a":1,"a":2,"a":1)",
       }) {
    EXPECT_EQ(after_safe_fixes(extras_with(members)), extras_with(members));
  }
}

TEST(FixKeeps, TheLastOfEqualValues) {
  const struct {
    const char *before, *after;
  } kCases[] = {
      {R"("a":1,"b":2,"a":1.0)", R"("b":2,"a":1.0)"},
      {R"("a":"A","a":"\u0041")", R"("a":"\u0041")"},
      {R"("a":9007199254740993,"a":9007199254740993)", R"("a":9007199254740993)"},
      {R"("a":"\ud800","a":"\ud800")", R"("a":"\ud800")"},
      {R"("a":{"x":1,"y":[2]},"a":{"y":[2.0],"x":1e0})", R"("a":{"y":[2.0],"x":1e0})"},
      {R"("a":1,"a":1.0,"a":1e0)", R"("a":1e0)"},
      {R"("a":2,"a":1.0,"a":1)", R"("a":2,"a":1)"},
      {R"("a":{"b":1,"b":1},"a":{"b":1})", R"("a":{"b":1})"},
  };
  for (const auto& [before, after] : kCases) {
    EXPECT_EQ(after_safe_fixes(extras_with(before)), extras_with(after));
  }
}

// Five of six positions are replaced; `stride` belongs to the view of their values.
std::string sparse_with(unsigned count, const std::string& stride) {
  const std::string bytes = std::string("\0\1\2\3\4\0\0\0", 8) + std::string(60, '\0');
  return fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
"accessors":[{{"componentType":5126,"type":"VEC3","count":6,"min":[0,0,0],"max":[0,0,0],"sparse":{{
"count":{},"indices":{{"bufferView":0,"componentType":5121}},"values":{{"bufferView":1}}}}}}],
"bufferViews":[{{"buffer":0,"byteLength":5}},{{"buffer":0,"byteOffset":8,"byteLength":60{}}}],
"buffers":[{{"byteLength":68,"uri":"data:application/octet-stream;base64,{}"}}]}})",
                     count, stride, container::encode_base64(bytes));
}

TEST(FixKeeps, AStrideThatMovesSparseValues) {
  const auto changes = [](unsigned count, const std::string& stride) {
    const std::string text = after_safe_fixes(sparse_with(count, stride));
    EXPECT_TRUE(text == sparse_with(count, stride) || text == sparse_with(count, "")) << text;
    return text == sparse_with(count, "");
  };
  EXPECT_FALSE(changes(5, R"(,"byteStride":4)"));
  EXPECT_FALSE(changes(5, R"(,"byteStride":16)"));
  EXPECT_TRUE(changes(5, R"(,"byteStride":12)"));
  EXPECT_TRUE(changes(1, R"(,"byteStride":16)"));
}

// Before its root it is drawn without its ancestors; after its root it is drawn below the root.
TEST(FixKeeps, ANodeThatIsListedBeforeItsRoot) {
  const auto roots = [](const char* list) {
    return fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[{}]}}],
"nodes":[{{"children":[1],"translation":[5,0,0]}},{{"camera":0}}],
"cameras":[{{"type":"perspective","perspective":{{"yfov":1,"znear":1}}}}]}})",
                       list);
  };
  EXPECT_EQ(after_safe_fixes(roots("1, 0")), roots("1, 0"));
  EXPECT_EQ(after_safe_fixes(roots("0, 1")), roots("0"));
}

TEST(FixKeeps, TheNameOfAnExtensionWithAnObjectInAWrongPlace) {
  const auto with = [](const char* member) {
    return fmt::format(R"({{"asset":{{"version":"2.0"}},"extensionsUsed":["KHR_materials_unlit"],
"{}":[{{"extensions":{{"KHR_materials_unlit":{{}}}}}}]}})",
                       member);
  };
  EXPECT_EQ(after_safe_fixes(with("materals")), with("materals"));
}

}  // namespace
}  // namespace gltfx
