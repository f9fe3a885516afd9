// SPDX-License-Identifier: Apache-2.0
/// --cache: what did not change is not checked again, and what did is.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

namespace fs = std::filesystem;
using container::test::TempFolder;
using testing::HasSubstr;
using testing::Not;

std::string with_buffer(const std::string& length) {
  return R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "a.bin", "byteLength": )" + length +
         "}]}";
}

class Cache : public testing::Test {
 protected:
  Outcome validate(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"validate", "assets",  "--isolated", "--format",
                                   "json",     "--cache", "cache"};
    words.insert(words.end(), more.begin(), more.end());
    return gltfx(words, setting_);
  }
  Outcome plain() const {
    return gltfx({"validate", "assets", "--isolated", "--format", "json"}, setting_);
  }
  std::uintmax_t bytes_kept() const {
    std::uintmax_t sum = 0;
    for (const auto& entry : fs::directory_iterator(folder_.path() / "cache")) {
      sum += entry.file_size();
    }
    return sum;
  }

  TempFolder folder_;
  Setting setting_{folder_.path().native(), {}, {}};
};

TEST_F(Cache, ASecondRunSaysTheSameAndKeepsNothingNew) {
  fs::create_directories(folder_.path() / "assets");
  fs::copy(fixture("bad"), folder_.path() / "assets/bad", fs::copy_options::recursive);
  fs::copy(fixture("good"), folder_.path() / "assets/good", fs::copy_options::recursive);
  const Outcome first = validate();
  EXPECT_EQ(first.out, plain().out);
  const std::uintmax_t kept = bytes_kept();
  const Outcome second = validate();
  EXPECT_EQ(second.out, first.out);
  EXPECT_EQ(second.code, first.code);
  EXPECT_EQ(bytes_kept(), kept);
}

TEST_F(Cache, AnAssetThatChangedIsCheckedAgain) {
  folder_.write("assets/a.gltf", kSound);
  ASSERT_EQ(validate().code, 0);
  folder_.write("assets/a.gltf", kFaulty);
  EXPECT_EQ(validate().code, 1);
  EXPECT_EQ(validate().out, plain().out);
}

TEST_F(Cache, AnAssetOfTheSameSizeAndTimeThatChangedIsCheckedAgain) {
  folder_.write("assets/a.gltf", with_buffer("4"));
  folder_.write("assets/a.bin", "1234");
  ASSERT_EQ(validate().code, 0);
  const fs::path asset = folder_.path() / "assets/a.gltf";
  const auto time = fs::last_write_time(asset);
  folder_.write("assets/a.gltf", with_buffer("5"));
  fs::last_write_time(asset, time);
  EXPECT_EQ(validate().code, 1);
}

TEST_F(Cache, ACompanionThatChangedMakesTheAssetBeCheckedAgain) {
  folder_.write("assets/a.gltf", with_buffer("4"));
  folder_.write("assets/a.bin", "1234");
  ASSERT_EQ(validate().code, 0);
  folder_.write("assets/a.bin", "123");
  EXPECT_EQ(validate().code, 1);
  fs::remove(folder_.path() / "assets/a.bin");
  EXPECT_EQ(validate().out, plain().out);
  folder_.write("assets/a.bin", "1234");
  EXPECT_EQ(validate().code, 0) << "that something was missing is not kept";
}

TEST_F(Cache, OtherOptionsAreOtherReports) {
  folder_.write("assets/a.gltf", kInfo);
  EXPECT_THAT(validate().out, HasSubstr("UNUSED_OBJECT"));
  EXPECT_THAT(validate({"--ignore", "UNUSED_OBJECT"}).out, Not(HasSubstr("UNUSED_OBJECT")));
  EXPECT_EQ(validate({"--severity", "UNUSED_OBJECT=error"}).code, 1);
  EXPECT_EQ(validate({"--max-file-size", "1"}).code, 1);
  EXPECT_EQ(validate().code, 0);
}

TEST_F(Cache, TheSameBytesElsewhereHaveTheSameReport) {
  folder_.write("assets/a.gltf", kFaulty);
  EXPECT_EQ(validate().code, 1);
  fs::create_directories(folder_.path() / "assets/copy");
  fs::copy_file(folder_.path() / "assets/a.gltf", folder_.path() / "assets/copy/a.gltf");
  EXPECT_EQ(validate().out, plain().out);
}

TEST_F(Cache, DamageMakesRunsSlowerNotWrong) {
  folder_.write("assets/a.gltf", kFaulty);
  folder_.write("assets/b.gltf", kInfo);
  const std::string right = validate().out;
  for (const auto& entry : fs::directory_iterator(folder_.path() / "cache")) {
    std::string bytes = read_file(entry.path().native());
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ 0x40);
      if (at % 31 == 0) damaged.resize(at);
      if (at % 41 != 0 && at % 31 != 0) continue;
      folder_.write("cache/" + entry.path().filename().native(), damaged);
      ASSERT_EQ(validate().out, right) << "byte " << at;
      for (const auto& file : fs::directory_iterator(folder_.path() / "cache")) {
        if (file.path() != entry.path()) fs::remove(file.path());
      }
    }
    break;
  }
}

TEST_F(Cache, ManySmallRunsEndUpInFewFiles) {
  for (int i = 0; i < 40; ++i) {
    folder_.write("assets/" + std::to_string(i) + ".gltf", kInfo);
    ASSERT_EQ(validate().code, 0);
  }
  const auto files =
      std::distance(fs::directory_iterator(folder_.path() / "cache"), fs::directory_iterator());
  EXPECT_LE(files, 17);
  const std::uintmax_t kept = bytes_kept();
  EXPECT_EQ(validate().out, plain().out);
  EXPECT_EQ(bytes_kept(), kept) << "nothing was forgotten";
}

TEST_F(Cache, TheNewestReportOfAnAssetCounts) {
  for (int i = 0; i < 40; ++i) {
    folder_.write("assets/a.bin", i % 2 == 0 ? "1234" : "12345");
    folder_.write("assets/a.gltf", with_buffer("4"));  // last: its age is waited for
    const std::string said = validate().out;
    const std::uintmax_t kept = bytes_kept();
    ASSERT_EQ(validate().out, said) << i;
    ASSERT_LE(bytes_kept(), kept) << "change " << i << " was looked at twice";
  }
}

TEST_F(Cache, AFolderThatCannotBeUsedIsAMistake) {
  folder_.write("cache", "a file");
  const Outcome outcome = validate();
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--cache: cannot"));
}

}  // namespace
}  // namespace gltfx::program
