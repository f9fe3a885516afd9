// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rules/part.hpp"

namespace gltfx::test {
namespace {

Lines cameras(const std::string& camera, Profile profile = Profile::standard) {
  return findings("\"cameras\": [" + camera + "]", {"CAMERA_"}, profile);
}

std::string perspective(const std::string& members) {
  return R"({"type": "perspective", "perspective": {)" + members + "}}";
}
std::string orthographic(const std::string& members) {
  return R"({"type": "orthographic", "orthographic": {)" + members + "}}";
}

TEST(Camera, FarPlaneLiesBehindTheNearOne) {
  const Lines wrong{"CAMERA_ZFAR_LEQUAL_ZNEAR /cameras/0/perspective"};
  EXPECT_EQ(cameras(perspective(R"("yfov": 1, "znear": 1, "zfar": 1)")), wrong);
  EXPECT_EQ(cameras(perspective(R"("yfov": 1, "znear": 1, "zfar": 0.5)")), wrong);
  EXPECT_EQ(cameras(perspective(R"("yfov": 1, "znear": 1, "zfar": 1.001)")), Lines{});
  EXPECT_EQ(cameras(perspective(R"("yfov": 1, "znear": 1)")), Lines{});
  EXPECT_EQ(cameras(orthographic(R"("xmag": 1, "ymag": 1, "znear": 0, "zfar": 1)")), Lines{});
  EXPECT_EQ(cameras(orthographic(R"("xmag": 1, "ymag": 1, "znear": 2, "zfar": 1)")),
            Lines{"CAMERA_ZFAR_LEQUAL_ZNEAR /cameras/0/orthographic"});
}

TEST(Camera, PlaneOutOfRangeIsReportedOnce) {
  EXPECT_EQ(cameras(perspective(R"("yfov": 1, "znear": -1, "zfar": -2)")), Lines{});
  EXPECT_EQ(cameras(perspective(R"("yfov": 1, "znear": 0, "zfar": -2)")), Lines{});
}

TEST(Camera, AngleIsLessThanHalfATurn) {
  const Lines wrong{"CAMERA_YFOV_GEQUAL_PI /cameras/0/perspective"};
  EXPECT_EQ(cameras(perspective(R"("yfov": 3.141592653589793, "znear": 1)")), wrong);
  EXPECT_EQ(cameras(perspective(R"("yfov": 3.14159, "znear": 1)")), Lines{});
}

TEST(Camera, MagnificationIsPositive) {
  EXPECT_EQ(cameras(orthographic(R"("xmag": 0, "ymag": -1, "znear": 0, "zfar": 1)")),
            (Lines{"CAMERA_XMAG_YMAG_ZERO /cameras/0/orthographic/xmag",
                   "CAMERA_XMAG_YMAG_NEGATIVE /cameras/0/orthographic/ymag"}));
  EXPECT_EQ(cameras(orthographic(R"("xmag": "0", "ymag": 1, "znear": 0, "zfar": 1)")), Lines{});
}

TEST(Camera, OnlyTheProjectionOfItsTypeCounts) {
  EXPECT_EQ(cameras(R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 1},
   "orthographic": {"xmag": 0, "ymag": 0, "znear": 0, "zfar": 1}})"),
            Lines{});
}

}  // namespace
}  // namespace gltfx::test
