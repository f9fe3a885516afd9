// SPDX-License-Identifier: Apache-2.0
/// `gltfx edit --delete`: its lists, files and refusals.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const std::string kModel = R"({
  "asset": { "version": "2.0" },
  "scenes": [ { "nodes": [0, 1] } ],
  "nodes": [
    { "camera": 1 },
    { "camera": 0, "name": "second" }
  ],
  "cameras": [
    { "type": "perspective", "perspective": { "yfov": 1, "znear": 0.10 } },
    { "type": "orthographic", "orthographic": { "xmag": 1, "ymag": 1, "zfar": 9, "znear": 0 } }
  ]
})";
const std::string kWithoutSecond = R"({
  "asset": { "version": "2.0" },
  "scenes": [ { "nodes": [0] } ],
  "nodes": [
    { "camera": 1 }
  ],
  "cameras": [
    { "type": "perspective", "perspective": { "yfov": 1, "znear": 0.10 } },
    { "type": "orthographic", "orthographic": { "xmag": 1, "ymag": 1, "zfar": 9, "znear": 0 } }
  ]
})";
const std::string kOneCamera = R"({
  "asset": { "version": "2.0" },
  "scenes": [ { "nodes": [0, 1] } ],
  "nodes": [
    { "camera": 0 },
    { "name": "second" }
  ],
  "cameras": [
    { "type": "orthographic", "orthographic": { "xmag": 1, "ymag": 1, "zfar": 9, "znear": 0 } }
  ]
})";

class EditTest : public testing::Test {
 protected:
  EditTest() { folder_.write("a.gltf", kModel); }
  Outcome here(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "edit");
    return gltfx(std::move(arguments), {folder_.path().native(), {}, {}});
  }
  std::string content(const std::string& name) const {
    return read_file((folder_.path() / name).native());
  }

  container::test::TempFolder folder_;
};

TEST_F(EditTest, ListsWhatRefersToAnObjectAndWritesNothing) {
  const Outcome outcome = here({"a.gltf", "--delete", "/cameras/0", "--in-place"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("/nodes/1/camera refers to /cameras/0"));
  EXPECT_THAT(outcome.err, HasSubstr("--cascade"));
  EXPECT_EQ(content("a.gltf"), kModel);
}

TEST_F(EditTest, IsADryRunUnlessTold) {
  const Outcome outcome = here({"a.gltf", "--delete", "/cameras/0", "--cascade"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("delete /cameras/0"));
  EXPECT_THAT(outcome.out, HasSubstr("delete /nodes/1/camera with /cameras/0"));
  EXPECT_THAT(outcome.out, HasSubstr("1 reference renumbered"));
  EXPECT_EQ(content("a.gltf"), kModel);
}

TEST_F(EditTest, RewritesInPlaceAndRestores) {
  const std::vector<std::string> rest{"--delete", "/cameras/0", "--cascade"};
  EXPECT_EQ(here({"a.gltf", "--in-place", "--backup", rest[0], rest[1], rest[2]}).code, 0);
  EXPECT_EQ(content("a.gltf"), kOneCamera);
  EXPECT_EQ(content("a.gltf.bak"), kModel);
  EXPECT_EQ(here({"a.gltf", "--restore"}).code, 0);
  EXPECT_EQ(content("a.gltf"), kModel);
}

TEST_F(EditTest, WritesElsewhereAndPrintsAPatch) {
  const Outcome outcome =
      here({"a.gltf", "--delete", "/nodes/1", "--cascade", "-o", "b.gltf", "--diff"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(content("b.gltf"), kWithoutSecond);
  EXPECT_THAT(outcome.out, HasSubstr("-    { \"camera\": 0, \"name\": \"second\" }"));
  EXPECT_EQ(content("a.gltf"), kModel);
}

TEST_F(EditTest, CheckExitsWithOneWhereSomethingWouldGo) {
  EXPECT_EQ(here({"a.gltf", "--delete", "/nodes/1", "--cascade", "--check"}).code, 1);
}

TEST_F(EditTest, PlansAreReadByPrograms) {
  const Outcome outcome =
      here({"a.gltf", "--delete", "/cameras/0", "--cascade", "--format", "json"});
  EXPECT_THAT(outcome.out, HasSubstr(R"("pointer":"/nodes/1/camera","cause":"/cameras/0")"));
  EXPECT_THAT(outcome.out, HasSubstr(R"("renumbered":1)"));
  const Outcome refused = here({"a.gltf", "--delete", "/cameras/0", "--format", "json"});
  EXPECT_THAT(refused.out, HasSubstr(R"("problem":"refused")"));
  EXPECT_THAT(refused.out,
              HasSubstr(R"("pointer":"/nodes/1/camera","target":"/cameras/0","mustHave":false)"));
}

TEST_F(EditTest, HostilePointersAreRefused) {
  for (const char* pointer :
       {"/meshes/99999999999", "/cameras/-", "/cameras/2", "/", "/asset", "/asset/version",
        "cameras/0", "/nodes/\xff\xfe", "/scenes/0/nodes"}) {
    const Outcome outcome = here({"a.gltf", "--delete", pointer, "--in-place"});
    const bool member = std::string(pointer) == "/scenes/0/nodes";
    EXPECT_EQ(outcome.code, member ? 0 : 1) << pointer << outcome.err;
  }
  EXPECT_THAT(content("a.gltf"), HasSubstr(R"("scenes": [ {} ])"));
  EXPECT_EQ(here({"a.gltf"}).code, 2);
  EXPECT_EQ(here({"a.gltf", "--delete", ""}).code, 2);
}

TEST_F(EditTest, FilesThatAreNoAssetsAreNotChanged) {
  for (const std::string text : {"", "{", "glTF", R"({"asset":{"version":"1.0"},"nodes":{}})",
                                 R"({"asset":{"version":"2.0"},"nodes":[{},{}],"nodes":[{}]})"}) {
    folder_.write("bad.gltf", text);
    const Outcome outcome = here({"bad.gltf", "--delete", "/nodes/0", "--in-place"});
    EXPECT_THAT(outcome.code, testing::AnyOf(1, 3)) << text;
    EXPECT_EQ(content("bad.gltf"), text);
  }
}

TEST_F(EditTest, AFileThatWouldHaveANewErrorIsRefused) {
  const Outcome outcome =
      here({"a.gltf", "--delete", "/cameras/0/perspective", "--cascade", "--in-place"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("would have the new error"));
  EXPECT_EQ(content("a.gltf"), kModel);
}

TEST_F(EditTest, GlbsKeepTheirDataAndLoseWhatNobodyNeeds) {
  const auto copy = [&](const std::string& name) {
    folder_.write("bowl.glb", read_file(fixture("good/" + name)));
  };
  copy("bowl.glb");
  const Outcome outcome =
      here({"bowl.glb", "--delete", "/buffers/0", "--cascade", "-o", "empty.glb"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string glb = content("empty.glb");
  EXPECT_THAT(glb, Not(HasSubstr(std::string("BIN\0", 4))));
  const Outcome valid = gltfx({"validate", "empty.glb"}, {folder_.path().native(), {}, {}});
  EXPECT_EQ(valid.code, 0) << valid.out;
}

TEST_F(EditTest, DeletingTwiceInOneRunIsOnceAndOrderDoesNotMatter) {
  EXPECT_EQ(here({"a.gltf", "--cascade", "--delete", "/nodes/1", "--delete", "/cameras/0",
                  "--delete", "/nodes/1", "-o", "b.gltf"})
                .code,
            0);
  EXPECT_EQ(here({"a.gltf", "--cascade", "--delete", "/cameras/0", "--delete", "/nodes/1", "-o",
                  "c.gltf"})
                .code,
            0);
  EXPECT_EQ(content("b.gltf"), content("c.gltf"));
}

}  // namespace
}  // namespace gltfx::program
