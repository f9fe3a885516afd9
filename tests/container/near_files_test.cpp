// SPDX-License-Identifier: Apache-2.0
#include "container/near_files.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"

namespace gltfx::container {
namespace {

using test::TempFolder;
using testing::ElementsAre;
using testing::IsEmpty;

class NearFiles : public testing::Test {
 protected:
  // The nearest paths with the number of their nearness in front.
  std::vector<std::string> near(const std::string& path, const std::string& base = "asset") const {
    const Resolver resolver(folder_.path() / "asset", folder_.path() / base);
    std::vector<std::string> found;
    for (const NearFile& file : find_near_files(resolver, path)) {
      found.push_back(std::to_string(static_cast<int>(file.nearness)) + " " + file.path);
    }
    return found;
  }
  void add(const std::string& path) { folder_.write("asset/" + path, "x"); }

  TempFolder folder_;
};

TEST_F(NearFiles, DifferInCaseInFoldersAndNames) {
  add("Textures/Wood.PNG");
  EXPECT_THAT(near("textures/wood.png"), ElementsAre("0 Textures/Wood.PNG"));
  EXPECT_THAT(near("TEXTURES/WOOD.png"), ElementsAre("0 Textures/Wood.PNG"));
  EXPECT_THAT(near("textures/woods.png"), ElementsAre("3 Textures/Wood.PNG"));
  add("Textures/wood.PNG");
  EXPECT_THAT(near("textures/wood.png"), ElementsAre("0 Textures/Wood.PNG", "0 Textures/wood.PNG"));
}

TEST_F(NearFiles, AreInOtherFoldersOfTheAsset) {
  add("wood.png");
  add("maps/leaf.png");
  add("maps/deep/stone.png");
  EXPECT_THAT(near("textures/wood.png"), ElementsAre("1 wood.png"));
  EXPECT_THAT(near("leaf.png"), ElementsAre("1 maps/leaf.png"));
  EXPECT_THAT(near("C:\\Users\\me\\maps\\deep\\Stone.png"), ElementsAre("1 maps/deep/stone.png"));
  EXPECT_THAT(near("/home/me/wood.png"), ElementsAre("1 wood.png"));
  EXPECT_THAT(near("../maps/leaf.png"), ElementsAre("1 maps/leaf.png"));
  EXPECT_THAT(near("stone.png"), IsEmpty());
}

TEST_F(NearFiles, DifferInTheirEnding) {
  add("wood.jpg");
  add("wood.psd");
  EXPECT_THAT(near("wood.png"), ElementsAre("2 wood.jpg", "2 wood.psd"));
}

TEST_F(NearFiles, AreMisspeltOrNumbered) {
  add("lambert1.001.png");
  add("base_colour.png");
  EXPECT_THAT(near("lambert1.png"), ElementsAre("3 lambert1.001.png"));
  EXPECT_THAT(near("base_color.png"), ElementsAre("3 base_colour.png"));
  EXPECT_THAT(near("base color.png"), ElementsAre("3 base_colour.png"));
}

TEST_F(NearFiles, NumbersAndShortWordsTellFilesApart) {
  for (const char* name : {"wood_n.png", "tile1.png", "map.png", "left.png", "ao2.png"}) add(name);
  for (const char* name : {"wood_d.png", "tile2.png", "mop.png", "right.png", "ao1.png"}) {
    EXPECT_THAT(near(name), IsEmpty()) << name;
  }
}

TEST_F(NearFiles, AreNeverOutsideOfTheRoot) {
  folder_.write("wood.png", "x");
  folder_.write("other/leaf.png", "x");
  folder_.link("asset/linked", "../other");
  EXPECT_THAT(near("Wood.png"), IsEmpty());
  EXPECT_THAT(near("../Wood.png"), IsEmpty());
  EXPECT_THAT(near("Leaf.png"), IsEmpty());
  EXPECT_THAT(near("linked/Leaf.png"), IsEmpty());
  add("sub/stone.png");
  EXPECT_THAT(near("Stone.png", "asset/sub"), ElementsAre("0 stone.png"));
}

TEST(NearFilesWithoutARoot, AreNone) {
  EXPECT_THAT(find_near_files(Resolver(), "a.png"), IsEmpty());
  EXPECT_THAT(find_near_files(Resolver(), ""), IsEmpty());
}

TEST(UriOfPath, NamesTheSamePath) {
  EXPECT_EQ(uri_of_path("a b#1?%.png"), "a%20b%231%3F%25.png");
  EXPECT_EQ(uri_of_path("c:d/e:f"), "c%3Ad/e:f");
  EXPECT_EQ(uri_of_path("St\xC3\xBChle.png"), "St\xC3\xBChle.png");
  for (const std::string path : {"a b#1?%.png", "c:d/e:f", "St\xC3\xBChle.png", "a\\b", "[1]"}) {
    const Uri uri = classify_uri(uri_of_path(path));
    EXPECT_EQ(uri.kind, UriKind::relative_path) << path;
    EXPECT_EQ(uri.path, path);
  }
}

}  // namespace
}  // namespace gltfx::container
