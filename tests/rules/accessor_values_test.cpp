// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "selected.hpp"

namespace gltfx::test {
namespace {

Lines of_values(const std::string& members, Profile profile = Profile::khronos) {
  return selected(
      asset_with(
          R"("buffers": [{"byteLength": 99}], "bufferViews": [{"buffer": 0, "byteLength": 99}],
        "accessors": [{"count": 1, )" +
          members + "}]"),
      {"ACCESSOR_MATRIX_ALIGNMENT", "ACCESSOR_NORMALIZED_INVALID", "INVALID_GL_VALUE",
       "ARRAY_LENGTH_NOT_IN_LIST", "ARRAY_TYPE_MISMATCH", "EMPTY_ENTITY"},
      profile);
}

TEST(AccessorBounds, HaveOneNumberForEachComponent) {
  const auto of_length = [](const char* type, const char* bound) {
    return of_values(std::string(R"("componentType": 5126, "type": ")") + type + R"(", "min": )" +
                     bound);
  };
  const Lines found{"ARRAY_LENGTH_NOT_IN_LIST /accessors/0/min"};
  EXPECT_EQ(of_length("SCALAR", "[1]"), Lines{});
  EXPECT_EQ(of_length("VEC2", "[1, 2]"), Lines{});
  EXPECT_EQ(of_length("VEC2", "[1]"), found);
  EXPECT_EQ(of_length("VEC2", "[1, 2, 3]"), found);
  EXPECT_EQ(of_length("MAT3", "[1, 2, 3, 4, 5, 6, 7, 8, 9]"), Lines{});
  EXPECT_EQ(of_length("MAT3", "[1, 2, 3, 4, 5, 6, 7, 8]"), found);
}

TEST(AccessorBounds, OfAnUnknownTypeAreNotJudged) {
  EXPECT_EQ(of_values(R"("componentType": 5126, "min": [1, 2])"), Lines{});
  EXPECT_EQ(of_values(R"("componentType": 1, "type": "VEC3", "min": [1, 2])"), Lines{});
}

TEST(AccessorBounds, OfIntegersAreIntegersThatTheTypeCanHold) {
  const auto of_type = [](const char* type, const char* bound) {
    return of_values(std::string(R"("type": "SCALAR", "componentType": )") + type + R"(, "max": )" +
                     bound);
  };
  const Lines out{"INVALID_GL_VALUE /accessors/0/max"};
  EXPECT_EQ(of_type("5120", "[127]"), Lines{});
  EXPECT_EQ(of_type("5120", "[128]"), out);
  EXPECT_EQ(of_type("5120", "[-128]"), Lines{});
  EXPECT_EQ(of_type("5120", "[-129]"), out);
  EXPECT_EQ(of_type("5121", "[255]"), Lines{});
  EXPECT_EQ(of_type("5121", "[256]"), out);
  EXPECT_EQ(of_type("5121", "[-1]"), out);
  EXPECT_EQ(of_type("5122", "[32767]"), Lines{});
  EXPECT_EQ(of_type("5122", "[-32769]"), out);
  EXPECT_EQ(of_type("5123", "[65535]"), Lines{});
  EXPECT_EQ(of_type("5123", "[65536]"), out);
  EXPECT_EQ(of_type("5125", "[4294967295]"), Lines{});
  EXPECT_EQ(of_type("5125", "[4294967296]"), out);
  EXPECT_EQ(of_type("5125", "[1.0]"), Lines{}) << "a zero fraction makes an integer";
  EXPECT_EQ(of_type("5125", "[1.5]"), Lines{"ARRAY_TYPE_MISMATCH /accessors/0/max"});
  EXPECT_EQ(of_type("5126", "[1.5e30]"), Lines{});
}

TEST(AccessorBounds, EachBadNumberIsSaid) {
  const Lines found = of_values(R"("type": "VEC3", "componentType": 5121, "min": [0.5, -1, 1000])");
  EXPECT_EQ(found,
            (Lines{"ARRAY_TYPE_MISMATCH /accessors/0/min", "INVALID_GL_VALUE /accessors/0/min",
                   "INVALID_GL_VALUE /accessors/0/min"}));
}

TEST(AccessorNormalized, IsForSmallIntegersOnly) {
  const Lines found{"ACCESSOR_NORMALIZED_INVALID /accessors/0/normalized"};
  for (const char* type : {"5120", "5121", "5122", "5123"}) {
    EXPECT_EQ(
        of_values(std::string(R"("type": "VEC2", "normalized": true, "componentType": )") + type),
        Lines{})
        << type;
  }
  for (const char* type : {"5125", "5126"}) {
    EXPECT_EQ(
        of_values(std::string(R"("type": "VEC2", "normalized": true, "componentType": )") + type),
        found)
        << type;
    EXPECT_EQ(
        of_values(std::string(R"("type": "VEC2", "normalized": false, "componentType": )") + type),
        Lines{})
        << type;
  }
}

TEST(AccessorMatrices, BeginAtMultiplesOfFourBytes) {
  const auto at = [](const char* type, const char* offset) {
    return of_values(std::string(R"("bufferView": 0, "componentType": 5121, "type": ")") + type +
                     R"(", "byteOffset": )" + offset);
  };
  const Lines found{"ACCESSOR_MATRIX_ALIGNMENT /accessors/0/byteOffset"};
  EXPECT_EQ(at("MAT2", "4"), Lines{});
  for (const char* type : {"MAT2", "MAT3", "MAT4"}) EXPECT_EQ(at(type, "2"), found) << type;
  EXPECT_EQ(at("VEC4", "2"), Lines{});
}

}  // namespace
}  // namespace gltfx::test
