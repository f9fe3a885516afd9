// SPDX-License-Identifier: Apache-2.0
/// Runs that were killed, and the ones after them.
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "container/temp_folder.hpp"
#include "process.hpp"
#include "upgrade_support.hpp"

namespace gltfx::program {
namespace {

namespace fs = std::filesystem;
using container::test::TempFolder;
using testing::HasSubstr;

constexpr int kKilled = 128 + 9;
constexpr int kTooLong = 128 + 25;  // SIGXFSZ: a file grew beyond the limit

class Resume : public testing::Test {
 protected:
  // Reads that many lines of the command's output, then kills it.
  Outcome kill_after(int lines, const std::string& command) const {
    return bash("exec 3< <(exec \"$GLTFX\" " + command + ")\npid=$!\nfor ((i = 0; i < " +
                    std::to_string(lines) +
                    "; i++)); do read -r line <&3; echo \"$line\"; done\nkill -9 $pid\nwait $pid",
                setting_);
  }
  // No file that the command writes may have more than that many times 1024 bytes.
  Outcome limited(std::uintmax_t kibibytes, const std::string& command) const {
    return bash(
        "ulimit -c 0; ulimit -f " + std::to_string(kibibytes) + "; exec \"$GLTFX\" " + command,
        setting_);
  }
  Outcome here(std::vector<std::string> words) const { return gltfx(std::move(words), setting_); }

  std::uintmax_t bytes_in(const std::string& folder) const {
    std::uintmax_t sum = 0;
    for (const auto& entry : fs::directory_iterator(folder_.path() / folder)) {
      sum += entry.file_size();
    }
    return sum;
  }
  // Names, contents and states of all files below a folder, to detect rewritten ones.
  std::map<std::string, std::string> files_in(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path() / folder)) {
      if (!entry.is_regular_file()) continue;
      const fs::path name = entry.path().lexically_relative(folder_.path() / folder);
      files[name.native()] = read_file(entry.path().native());
    }
    return files;
  }
  ino_t inode(const std::string& name) const {
    struct stat status {};
    ::stat((folder_.path() / name).c_str(), &status);
    return status.st_ino;
  }

  TempFolder folder_;
  Setting setting_{folder_.path().native(), {}, {}};
};

class ResumeValidate : public Resume {
 protected:
  static constexpr int kAssets = 300;

  void SetUp() override {
    for (int i = 0; i < kAssets; ++i) {
      folder_.write("assets/" + std::to_string(i) + ".gltf", i % 3 == 0 ? kInfo : kFaulty);
    }
  }
  Outcome validate(const std::string& cache, const std::string& format) const {
    return here({"validate", "assets", "--cache", cache, "--format", format});
  }
  // The next run has the output of a clean run, and does only the remaining work.
  void expect_the_rest(std::uintmax_t reported, const std::string& format) const {
    const Outcome clean = validate("clean", format);
    const std::uintmax_t all = bytes_in("clean");
    const std::uintmax_t before = bytes_in("cache");
    EXPECT_GE(before, all / kAssets * reported / 2) << "what was reported was kept";
    EXPECT_LT(before, all);
    const Outcome next = validate("cache", format);
    EXPECT_EQ(next.out, clean.out);
    EXPECT_EQ(next.code, clean.code);
    EXPECT_LE(bytes_in("cache"), all + 2 * all / kAssets) << "little was done twice";
    EXPECT_GE(bytes_in("cache"), all);
  }
};

TEST_F(ResumeValidate, ARunThatIsKilledGoesOnWhereItWas) {
  const Outcome killed = kill_after(40, "validate assets --jobs 1 --cache cache --format jsonl");
  EXPECT_EQ(killed.code, kKilled);
  EXPECT_EQ(std::count(killed.out.begin(), killed.out.end(), '\n'), 40);
  expect_the_rest(39, "jsonl");
}

TEST_F(ResumeValidate, OneThatDiesWhileItKeepsAReportLosesThatOne) {
  ASSERT_EQ(validate("measured", "agent").code, 1);
  const auto limit = bytes_in("measured") / 1024 / 2;
  const Outcome killed = limited(limit, "validate assets --jobs 1 --cache cache --format agent=r");
  EXPECT_EQ(killed.code, kTooLong);
  EXPECT_EQ(bytes_in("cache"), limit * 1024) << "in the middle of a file";
  EXPECT_FALSE(fs::exists(folder_.path() / "r")) << "a report is there when it is whole";
  expect_the_rest(kAssets / 2 - 2, "agent");
}

TEST_F(ResumeValidate, ManyKillsAreNoneInTheEnd) {
  for (int lines = 2; lines < 100; lines += 24) {
    kill_after(lines, "validate assets --cache cache --format jsonl");
  }
  EXPECT_EQ(validate("cache", "jsonl").out, validate("clean", "jsonl").out);
}

class ResumeUpgrade : public Resume {
 protected:
  void SetUp() override {
    const std::string long_one = kLegacy.substr(0, kLegacy.rfind('}')) + R"(, "extras": ")" +
                                 std::string(70000, 'x') + "\"}";
    for (const std::string folder : {"assets", "clean"}) {
      folder_.write(folder + "/1.gltf", kLegacy);
      folder_.write(folder + "/2.gltf", long_one);
      folder_.write(folder + "/3.gltf", kLegacy);
    }
  }
};

TEST_F(ResumeUpgrade, InPlaceEachFileIsOldOrNew) {
  const auto old = files_in("assets");
  EXPECT_EQ(limited(64, "upgrade assets --in-place --jobs 1").code, kTooLong);
  auto now = files_in("assets");
  EXPECT_EQ(now["1.gltf"], kUpgraded);
  EXPECT_EQ(now["2.gltf"], old.at("2.gltf"));
  EXPECT_EQ(now["3.gltf"], old.at("3.gltf"));
  EXPECT_EQ(now.size(), 4U) << "half a file is left beside them";
  const ino_t done = inode("assets/1.gltf");
  EXPECT_EQ(here({"upgrade", "assets", "--in-place"}).code, 0);
  EXPECT_EQ(here({"upgrade", "clean", "--in-place"}).code, 0);
  EXPECT_EQ(files_in("assets"), files_in("clean"));
  EXPECT_EQ(inode("assets/1.gltf"), done) << "what is done stays";
}

TEST_F(ResumeUpgrade, ElsewhereToo) {
  EXPECT_EQ(limited(64, "upgrade assets -o new/ --jobs 1").code, kTooLong);
  EXPECT_EQ(files_in("new").count("3.gltf"), 0U);
  EXPECT_EQ(here({"upgrade", "assets", "-o", "new/"}).code, 0);
  EXPECT_EQ(here({"upgrade", "clean", "--in-place"}).code, 0);
  EXPECT_EQ(files_in("new"), files_in("clean"));
}

class ResumeBake : public Resume {
 protected:
  void SetUp() override {
    for (const std::string name :
         {"bowl.glb", "leaf.gltf", "leaf.bin", "leaf_color.png", "leaf_transmission.png"}) {
      folder_.write("assets/" + name, read_file(fixture("good/" + name)));
    }
    TempFolder::wait_for_tick();
    for (const std::string& each : options_) line_ += " " + each;
  }
  Outcome bake(const std::string& output, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"bake", "assets", "-o", output};
    words.insert(words.end(), options_.begin(), options_.end());
    words.insert(words.end(), more.begin(), more.end());
    return here(words);
  }
  // The existing pictures among those of a run with these options.
  std::set<std::string> drawn(const std::vector<std::string>& more = {}) const {
    std::map<std::string, ino_t> before;
    for (const auto& [name, bytes] : files_in("out")) before[name] = inode("out/" + name);
    std::vector<std::string> words{"--cache", "cache"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(bake("out", words).code, 0);
    std::set<std::string> names;
    for (const auto& [name, number] : before) {
      if (name != "contact-sheet.png" && inode("out/" + name) != number) names.insert(name);
    }
    return names;
  }

  const std::vector<std::string> options_{"--size", "16", "--samples", "1"};
  std::string line_;
};

TEST_F(ResumeBake, WhatWasDrawnIsNotDrawnAgain) {
  const Outcome killed = kill_after(1, "bake assets -o out --cache cache" + line_);
  ASSERT_THAT(killed.out, HasSubstr("bowl.png"));
  const ino_t done = inode("out/bowl.png");
  const Outcome next = bake("out", {"--cache", "cache"});
  const Outcome clean = bake("clean");
  EXPECT_EQ(next.code, clean.code);
  EXPECT_EQ(inode("out/bowl.png"), done);
  EXPECT_EQ(files_in("out"), files_in("clean"));
  EXPECT_EQ(bake("out", {"--cache", "cache"}).out, next.out) << "it says the same";
}

TEST_F(ResumeBake, WhatIsNotAsItShouldBeIsDrawnAgain) {
  ASSERT_EQ(bake("out", {"--cache", "cache"}).code, 0);
  EXPECT_EQ(drawn(), std::set<std::string>());
  folder_.write("out/bowl.png", "no picture");
  EXPECT_EQ(drawn(), std::set<std::string>{"bowl.png"});
  fs::remove(folder_.path() / "out/leaf.png");
  EXPECT_EQ(drawn(), std::set<std::string>());
  EXPECT_TRUE(fs::exists(folder_.path() / "out/leaf.png"));
  EXPECT_EQ(drawn({"--seed", "1"}).size(), 2U);
  EXPECT_EQ(drawn({"--seed", "1"}), std::set<std::string>());
  const std::string leaf = read_file((folder_.path() / "assets/leaf.gltf").native());
  folder_.write("assets/leaf.gltf", leaf + "\n");
  EXPECT_EQ(drawn({"--seed", "1"}), std::set<std::string>{"leaf.png"});
}

TEST_F(ResumeBake, TheSheetOfPicturesThatWereThereIsTheSame) {
  for (const std::string format : {"webp", "exr"}) {
    bake("clean-" + format, {"--format", format, "--layer", "depth"});
    for (int run = 0; run < 2; ++run) {
      bake("out-" + format, {"--format", format, "--layer", "depth", "--cache", "cache"});
      EXPECT_EQ(files_in("out-" + format), files_in("clean-" + format)) << format << run;
    }
  }
}

TEST_F(ResumeBake, ShardsAndARunOverAllAreOneRun) {
  folder_.write("assets/bowl.gltf", read_file((folder_.path() / "assets/leaf.gltf").native()));
  bake("clean");
  for (const std::string shard : {"1/3", "2/3", "3/3"}) {
    EXPECT_EQ(bake("out", {"--cache", "cache", "--shard", shard}).code, 0);
    EXPECT_FALSE(fs::exists(folder_.path() / "out/contact-sheet.png")) << "of some pictures only";
  }
  auto pictures = files_in("clean");
  EXPECT_EQ(pictures.count("bowl.glb.png") + pictures.count("bowl.gltf.png"), 2U);
  pictures.erase("contact-sheet.png");
  EXPECT_EQ(files_in("out"), pictures);
  EXPECT_EQ(drawn(), std::set<std::string>());
  EXPECT_EQ(files_in("out"), files_in("clean"));
}

TEST_F(ResumeBake, WhatCannotBeKeptGoesWithoutACache) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--embed"},
                                                {"--time-budget", "1"},
                                                {"--compare", "assets/leaf.gltf"}}) {
    std::vector<std::string> all{"--cache", "cache"};
    all.insert(all.end(), words.begin(), words.end());
    EXPECT_EQ(bake("out", all).code, 2) << words.front();
  }
  EXPECT_THAT(bake("out", {"--sheet", "s.png", "--shard", "1/2"}).err,
              HasSubstr("--sheet needs all"));
}

class UpgradeShards : public Resume {};

TEST_F(UpgradeShards, TwoInputsForOneOutputAreSeenAcrossShards) {
  for (int i = 0; i < 8; ++i) {
    folder_.write("a/" + std::to_string(i) + ".gltf", kLegacy);
    folder_.write("b/" + std::to_string(i + 8) + ".gltf", kLegacy);
  }
  EXPECT_EQ(here({"upgrade", "a", "b", "-o", "out/", "--shard", "1/2"}).code, 0);
  folder_.write("list", "c/x/1.gltf\n../1.gltf\n1.gltf\n");
  int refused = 0;
  for (const std::string shard : {"1/9", "2/9", "3/9", "4/9", "5/9", "6/9", "7/9", "8/9", "9/9"}) {
    const Outcome outcome =
        here({"upgrade", "--files-from", "list", "-o", "out/", "--shard", shard});
    refused += outcome.err.find("two inputs would be written") != std::string::npos ? 1 : 0;
  }
  EXPECT_GE(refused, 1);
}

}  // namespace
}  // namespace gltfx::program
