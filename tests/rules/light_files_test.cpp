// SPDX-License-Identifier: Apache-2.0
// Lights with data in other files: cube maps of an environment, measured profiles.
#include <gtest/gtest.h>

#include "rules/part.hpp"
#include "rules/textured.hpp"

namespace gltfx::test {
namespace {

std::string face(std::uint32_t width, std::uint32_t height) {
  const std::string texels(std::size_t{width} * height, '\x80');
  return "data:image/png;base64," +
         base64(encode_png({width, height, PngColor::grey, 8, texels, {}}));
}

Lines environment(const std::string& size, const std::string& levels, const Lines& images) {
  std::string list;
  for (const std::string& image : images) {
    list += (list.empty() ? "" : ", ") + (R"({"uri": ")" + image + "\"}");
  }
  return findings(R"("extensionsUsed": ["EXT_lights_image_based"], "extensions":
    {"EXT_lights_image_based": {"lights": [{"specularImageSize": )" +
                      size + R"(, "specularImages": [)" + levels + R"(]}]}}, "images": [)" + list +
                      "]",
                  {"IMAGE_BASED"});
}
const std::string kLevels =
    "IMAGE_BASED_LIGHT_FACE_SIZE /extensions/EXT_lights_image_based/lights/0/specularImages/";

TEST(Environment, LevelsHalve) {
  const Lines images{face(4, 4), face(2, 2), face(1, 1)};
  EXPECT_EQ(environment("4", "[0, 0, 0, 0, 0, 0], [1, 1, 1, 1, 1, 1], [2, 2, 2, 2, 2, 2]", images),
            Lines{});
  EXPECT_EQ(environment("4", "[0, 0, 0, 1, 0, 0]", images), Lines{kLevels + "0/3"});
  EXPECT_EQ(environment("4", "[0, 0, 0, 0, 0, 0], [2, 1, 1, 1, 1, 1]", images),
            Lines{kLevels + "1/0"});
  EXPECT_EQ(environment("2", "[0, 0, 0, 0, 0, 0]", images), Lines{kLevels + "0/0 x6"});
}

TEST(Environment, FacesAreSquareAndOfAPowerOfTwo) {
  EXPECT_EQ(environment("4", "[0]", {face(4, 2)}), Lines{kLevels + "0/0"});
  EXPECT_EQ(environment("3", "[0]", {face(3, 3)}), Lines{kLevels + "0/0"});
  EXPECT_EQ(environment("\"4\"", "[0]", {face(8, 8)}), Lines{}) << "the size is told elsewhere";
  EXPECT_EQ(environment("4", "[0]", {"data:image/png;base64,AAAA"}), Lines{});
}

Lines profile(const std::string& text, const std::string& codes = "IES") {
  return findings(R"("extensionsUsed": ["EXT_lights_ies"], "extensions": {"EXT_lights_ies":
    {"lights": [{"uri": "data:application/x-ies-lm-63;base64,)" +
                      base64(text) + R"("}]}})",
                  {codes});
}
const std::string kNumbers = "1 100 1 2 1 1 2 0 0 0\n1 1 0\n0 90\n0\n10 5\n";

TEST(Profiles, AreOfAVersionThatReadersKnow) {
  const Lines wrong{"IES_PROFILE_INVALID /extensions/EXT_lights_ies/lights/0"};
  for (const std::string version : {"IESNA:LM-63-1995", "IESNA:LM-63-2002\r", "IES:LM-63-2019"}) {
    EXPECT_EQ(profile(version + "\n[TEST] 1\nTILT=NONE\n" + kNumbers), Lines{}) << version;
  }
  EXPECT_EQ(profile("IESNA91\nTILT=NONE\n" + kNumbers), wrong);
  EXPECT_EQ(profile(""), Lines{"IES_PROFILE_INVALID /extensions/EXT_lights_ies/lights/0"});
  EXPECT_EQ(profile("IES:LM-63-2019\n" + kNumbers), wrong) << "without TILT";
  EXPECT_EQ(profile("IES:LM-63-2019\nTILT=NONE"), wrong);
}

TEST(Profiles, HaveAKindOfPhotometry) {
  const Lines wrong{"IES_PROFILE_INVALID /extensions/EXT_lights_ies/lights/0"};
  const std::string head = "IES:LM-63-2019\nTILT=NONE\n";
  EXPECT_EQ(profile(head + "1 100 1 2 1 3 2 0 0 0"), Lines{}) << "A";
  EXPECT_EQ(profile(head + "1 100 1 2 1 4 2 0 0 0"), wrong);
  EXPECT_EQ(profile(head + "1 100 1 2 1"), wrong);
  EXPECT_EQ(profile(head + "+1, 100, 1, 2, 1, 2"), Lines{});
}

TEST(Profiles, MayHaveATilt) {
  const Lines wrong{"IES_PROFILE_INVALID /extensions/EXT_lights_ies/lights/0"};
  const std::string head = "IES:LM-63-2019\nTILT=INCLUDE\n";
  EXPECT_EQ(profile(head + "1\n2\n0 90\n1 1\n" + kNumbers), Lines{});
  EXPECT_EQ(profile(head + "1\n2\n0 90\n1"), wrong);
  EXPECT_EQ(profile(head + "1\n1e300\n0 90\n1"), wrong);
  EXPECT_EQ(profile(head + "1\n-1\n"), wrong);
}

TEST(Profiles, ThatCannotBeHadAreReported) {
  EXPECT_EQ(findings(R"("extensionsUsed": ["EXT_lights_ies"], "extensions": {"EXT_lights_ies":
    {"lights": [{"uri": "../../lamp.ies"}]}})",
                     {"URI", "IO", "RESOURCE"}),
            Lines{"RESOURCE_NOT_CHECKED /extensions/EXT_lights_ies/lights/0/uri"});
}

}  // namespace
}  // namespace gltfx::test
