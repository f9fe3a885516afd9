// SPDX-License-Identifier: Apache-2.0
/// Which assets of a folder are left out: --exclude and .gitignore.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class LeftOut : public testing::Test {
 protected:
  void add(const std::vector<std::string>& names) {
    for (const std::string& name : names) folder_.write(name, kInfo);
  }
  Outcome validate(std::vector<std::string> words) const {
    words.insert(words.begin(), "validate");
    words.insert(words.end(), {"--isolated", "--allow-empty", "--format", "github"});
    return gltfx(words, {folder_.path().native(), {}, {}});
  }
  // The files that were checked, by their finding.
  std::vector<std::string> checked(const std::vector<std::string>& words) const {
    std::vector<std::string> files;
    const std::string out = validate(words).out;
    for (std::size_t at = out.find("file="); at != std::string::npos;
         at = out.find("file=", at + 1)) {
      files.push_back(out.substr(at + 5, out.find(',', at) - at - 5));
    }
    return files;
  }

  TempFolder folder_;
};

TEST_F(LeftOut, ExcludeFitsNamesFoldersAndPaths) {
  add({"a/x.gltf", "a/old/y.gltf", "b/x.gltf", "b/z.glb.gltf"});
  EXPECT_THAT(checked({".", "--exclude", "x.gltf"}),
              ElementsAre("./a/old/y.gltf", "./b/z.glb.gltf"));
  EXPECT_THAT(checked({".", "--exclude", "old/"}),
              ElementsAre("./a/x.gltf", "./b/x.gltf", "./b/z.glb.gltf"));
  EXPECT_THAT(checked({".", "--exclude", "a/**/*.gltf", "--exclude", "*.glb.*"}),
              ElementsAre("./b/x.gltf"));
  EXPECT_THAT(checked({"a", "--exclude", "a/x.gltf"}), ElementsAre("a/old/y.gltf"));
  EXPECT_THAT(checked({"a", "--exclude", "old"}), ElementsAre("a/x.gltf"));
  EXPECT_THAT(checked({"*/*.gltf", "--exclude", "b/"}), ElementsAre("a/x.gltf"));
}

TEST_F(LeftOut, AFileThatIsNamedCounts) {
  add({"a/x.gltf"});
  folder_.write(".git/HEAD", "");
  folder_.write(".gitignore", "*.gltf\n");
  EXPECT_THAT(checked({"a/x.gltf", "--exclude", "x.gltf"}), ElementsAre("a/x.gltf"));
}

TEST_F(LeftOut, GitignoreCountsInsideARepository) {
  add({"keep.gltf", "out/a.gltf", "tmp.gltf", "sub/tmp.gltf", "sub/a.gltf", "sub/deep/b.gltf",
       "sub/deep/keep.gltf"});
  folder_.write(".gitignore", "# built\n/tmp.gltf\nout/\n\\#x\n");
  folder_.write("sub/.gitignore", "deep/*\n!deep/keep.gltf  \r\n");
  EXPECT_EQ(checked({"."}).size(), 7U) << "no repository";
  folder_.write(".git/HEAD", "");
  EXPECT_THAT(checked({"."}),
              ElementsAre("./keep.gltf", "./sub/a.gltf", "./sub/deep/keep.gltf", "./sub/tmp.gltf"));
  EXPECT_THAT(checked({"sub"}), ElementsAre("sub/a.gltf", "sub/deep/keep.gltf", "sub/tmp.gltf"));
  EXPECT_THAT(checked({"sub/deep"}), ElementsAre("sub/deep/keep.gltf")) << "files above count";
  EXPECT_EQ(checked({".", "--no-ignore"}).size(), 7U);
  EXPECT_THAT(validate({"."}).err, HasSubstr("2 assets are left out, as .gitignore asks"));
  EXPECT_THAT(validate({"sub", "--no-ignore"}).err, Not(HasSubstr("gitignore")));
}

TEST_F(LeftOut, TheNearestFileDecides) {
  add({"a/x.gltf", "a/y.gltf"});
  folder_.write(".git/HEAD", "");
  folder_.write(".gitignore", "*.gltf\n");
  folder_.write("a/.gitignore", "!x.gltf\n");
  EXPECT_THAT(checked({"."}), ElementsAre("./a/x.gltf"));
}

TEST_F(LeftOut, EveryVerbThatSearchesFoldersLooksAlike) {
  add({"old/a.gltf"});
  for (const std::string verb : {"upgrade", "inspect", "bake"}) {
    std::vector<std::string> words{verb, ".", "--exclude", "old/"};
    if (verb == "bake") words.insert(words.end(), {"-o", "out/"});
    const Outcome outcome = gltfx(words, {folder_.path().native(), {}, {}});
    EXPECT_EQ(outcome.code, 2) << verb;
    EXPECT_THAT(outcome.err, HasSubstr("no .gltf, .glb or .vrm in '.'")) << verb;
  }
}

TEST_F(LeftOut, HostilePatternsCostLittle) {
  add({std::string(200, 'a') + ".gltf"});
  folder_.write(".git/HEAD", "");
  std::string stars;
  for (int i = 0; i < 150; ++i) stars += "*a";
  folder_.write(".gitignore", stars + "b\n" + std::string(100'000, '*') + "\n");
  EXPECT_THAT(checked({"."}), Not(IsEmpty()));
}

}  // namespace
}  // namespace gltfx::program
