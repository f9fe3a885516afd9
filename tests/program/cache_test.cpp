// SPDX-License-Identifier: Apache-2.0
/// --cache: what did not change is not checked again, and what did is.
#include <cstdint>
#include <cstring>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

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
  TempFolder::wait_for_tick();
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

// The finding about it need not be in the report, for instance with --ignore.
TEST_F(Cache, AReportThatAMissingDecoderShapedIsNotKept) {
  fs::create_directories(folder_.path() / "assets");
  fs::copy(fixture("good/bowl.glb"), folder_.path() / "assets");
  Setting without = setting_;
  without.environment.emplace_back("GLTFX_CODEC_WORKERS", (folder_.path() / "none").native());
  const std::vector<std::string> words{"validate", "assets",  "--isolated", "--format",
                                       "json",     "--cache", "cache"};
  EXPECT_THAT(gltfx(words, without).out, HasSubstr("DRACO_NOT_CHECKED"));
  EXPECT_EQ(validate().out, plain().out);
  EXPECT_THAT(plain().out, Not(HasSubstr("DRACO_NOT_CHECKED")));
}

// As in a job that may use the cache of others but not add to it. Only what is kept can say that
// the bitstream is sound, since the second run has no decoder.
TEST_F(Cache, OneThatIsReadOnlyIsRead) {
  fs::create_directories(folder_.path() / "assets");
  fs::copy(fixture("good/bowl.glb"), folder_.path() / "assets");
  const Outcome first = validate();
  const std::string root = ::geteuid() == 0 ? "setpriv --bounding-set=-dac_override " : "";
  const Outcome second =
      bash("chmod 0444 cache/*.results && chmod 0555 cache && export GLTFX_CODEC_WORKERS=none && " +
               root +
               "\"$GLTFX\" validate assets --isolated --format json --cache cache; "
               "status=$?; chmod -R u+w cache; exit $status",
           setting_);
  EXPECT_EQ(second.out, first.out) << second.err;
  EXPECT_EQ(second.code, first.code) << second.err;
}

TEST_F(Cache, OtherOptionsAreOtherReports) {
  folder_.write("assets/a.gltf", kInfo);
  EXPECT_THAT(validate().out, HasSubstr("UNUSED_OBJECT"));
  EXPECT_THAT(validate({"--ignore", "UNUSED_OBJECT"}).out, Not(HasSubstr("UNUSED_OBJECT")));
  EXPECT_EQ(validate({"--severity", "UNUSED_OBJECT=error"}).code, 1);
  EXPECT_EQ(validate({"--max-file-size", "1"}).code, 1);
  EXPECT_EQ(validate().code, 0);
}

// A limit on pixels wants them, unless the user says the opposite.
TEST_F(Cache, AnotherNoteOfALimitIsAnotherReport) {
  folder_.write("assets/a.gltf", R"({"asset": {"version": "2.0"}, "nodes": [{}]})");
  TempFolder::wait_for_tick();
  const auto with_note = [&](const std::string& note) {
    folder_.write("gltfx.toml", "[budgets]\nnodes = { max = 0, note = \"" + note + "\" }\n");
    return gltfx({"validate", "assets", "--cache", "cache", "--format", "agent"}, setting_).out;
  };
  EXPECT_THAT(with_note("props"), HasSubstr("gltfx.toml:2: props"));
  EXPECT_THAT(with_note("doors"), HasSubstr("gltfx.toml:2: doors"));
}

TEST_F(Cache, AskingForHeadersIsAnotherReport) {
  const std::string page = read_file(fixture("../schema/measures/albedo-max.md"));
  const std::string fence = "```json\n";
  const std::size_t begin = page.find(fence) + fence.size();
  folder_.write("assets/a.gltf", page.substr(begin, page.find("```", begin) - begin));
  const std::vector<std::string> limit{"--budget", "material.albedo-max=9"};
  EXPECT_THAT(validate(limit).out, HasSubstr("BUDGET_ALBEDO_MAX"));
  std::vector<std::string> headers = limit;
  headers.insert(headers.end(), {"--pixels", "headers"});
  EXPECT_THAT(validate(headers).out,
              testing::AllOf(HasSubstr("BUDGET_NOT_MEASURED"), Not(HasSubstr("BUDGET_ALBEDO"))));
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

// The records of the only file of results: a head of 24 bytes, then for each 40 bytes, of which the
// first eight are its length, and its value.
std::vector<std::string> records_of(const std::string& file) {
  std::vector<std::string> records;
  for (std::size_t at = 24; at + 40 <= file.size();) {
    std::uint64_t length = 0;
    std::memcpy(&length, file.data() + at, sizeof length);
    records.push_back(file.substr(at, 40 + length));
    at += 40 + length;
  }
  return records;
}

class Forgery : public Cache {
 protected:
  fs::path results() const { return fs::directory_iterator(folder_.path() / "cache")->path(); }
  // A run of another user with another key.
  Setting other_user() const {
    return {setting_.folder, {}, {{"XDG_STATE_HOME", (folder_.path() / "other").native()}}};
  }
  Outcome validate_as(const Setting& setting, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"validate", "assets",  "--isolated", "--format",
                                   "json",     "--cache", "cache"};
    words.insert(words.end(), more.begin(), more.end());
    return gltfx(words, setting);
  }
};

TEST_F(Forgery, AVerdictUnderTheKeyOfAnotherAssetIsNotBelieved) {
  folder_.write("assets/a.gltf", kFaulty);
  ASSERT_EQ(validate().code, 1);
  const std::string bad = read_file(results().native());
  fs::remove(results());
  folder_.write("assets/a.gltf", kSound);
  ASSERT_EQ(validate().code, 0);
  const std::string good = read_file(results().native());
  const auto bad_records = records_of(bad), good_records = records_of(good);
  ASSERT_EQ(bad_records.size(), 3U);
  std::string forged = bad.substr(0, 24);
  for (std::size_t i = 0; i < bad_records.size(); ++i) {
    // The key of the bad asset with the value of the good one, and its seal.
    std::string head = good_records[i].substr(0, 40);
    head.replace(8, 16, bad_records[i], 8, 16);
    forged += i == 2 ? bad_records[i] : head + good_records[i].substr(40);
  }
  folder_.write("cache/" + results().filename().native(), forged);
  folder_.write("assets/a.gltf", kFaulty);
  EXPECT_EQ(validate().code, 1);
}

TEST_F(Forgery, WhatWasSealedWithAnotherKeyIsNotReadAndSaidToBe) {
  folder_.write("assets/a.gltf", kFaulty);
  ASSERT_EQ(validate_as(other_user()).code, 1);
  const std::uintmax_t kept = bytes_kept();
  const Outcome here = validate();
  EXPECT_EQ(here.code, 1);
  EXPECT_GT(bytes_kept(), kept);
  EXPECT_THAT(here.err, HasSubstr("note: --cache: 1 file of 'cache' is not used"));
  EXPECT_THAT(validate({"--quiet"}).err, Not(HasSubstr("note")));
}

TEST_F(Forgery, TheKeyIsForThisUserOnly) {
  folder_.write("assets/a.gltf", kSound);
  ASSERT_EQ(validate_as(other_user()).code, 0);
  const fs::path key = folder_.path() / "other/gltfx/cache.key";
  EXPECT_EQ(fs::status(key).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(fs::status(key.parent_path()).permissions(), fs::perms::owner_all);
  EXPECT_EQ(std::distance(fs::directory_iterator(key.parent_path()), fs::directory_iterator()), 1);
  const std::uintmax_t kept = bytes_kept();
  ASSERT_EQ(validate_as(other_user()).code, 0);
  EXPECT_EQ(bytes_kept(), kept) << "the key is used again";
  fs::permissions(key, fs::perms::others_read, fs::perm_options::add);
  const Outcome open = validate_as(other_user());
  EXPECT_EQ(open.code, 2);
  EXPECT_THAT(open.err, HasSubstr("others must not have access"));
  fs::remove(key);
  fs::create_symlink("/dev/zero", key);
  EXPECT_EQ(validate_as(other_user()).code, 2);
}

TEST_F(Forgery, ASharedKeyHitsOnOtherMachines) {
  folder_.write("assets/a.gltf", kInfo);
  const fs::path key = folder_.write("key", "0123456789abcdef0123456789abcdef\n");
  fs::permissions(key, fs::perms::owner_read | fs::perms::owner_write);
  ASSERT_EQ(validate({"--cache-key", "key"}).code, 0);
  const std::uintmax_t kept = bytes_kept();
  Setting elsewhere = other_user();
  EXPECT_EQ(validate_as(elsewhere, {"--cache-key", "key"}).code, 0);
  elsewhere.environment.emplace_back("GLTFX_CACHE_KEY", "0123456789abcdef0123456789abcdef");
  EXPECT_EQ(validate_as(elsewhere).code, 0);
  EXPECT_EQ(bytes_kept(), kept);
  EXPECT_FALSE(fs::exists(folder_.path() / "other")) << "no key is made where none is needed";
  elsewhere.environment.back().second = "0123456789abcdef0123456789abcdeF";
  EXPECT_EQ(validate_as(elsewhere).code, 0);
  EXPECT_GT(bytes_kept(), kept);
}

TEST_F(Forgery, AKeyThatOthersCanWriteIsRefused) {
  folder_.write("assets/a.gltf", kSound);
  const fs::path key = folder_.write("key", "0123456789abcdef0123456789abcdef\n");
  for (const fs::perms others : {fs::perms::group_write, fs::perms::others_write}) {
    fs::permissions(key, fs::perms::owner_read | fs::perms::owner_write | others);
    const Outcome outcome = validate({"--cache-key", "key"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("other users can write 'key'"));
  }
  fs::permissions(key, fs::perms::owner_read | fs::perms::group_read);
  EXPECT_EQ(validate({"--cache-key", "key"}).code, 0);
}

TEST_F(Forgery, KeysThatCannotBeUsedAreMistakes) {
  folder_.write("assets/a.gltf", kSound);
  folder_.write("short", "0123456789abcdef");
  folder_.write("empty", "");
  EXPECT_THAT(validate({"--cache-key", "short"}).err, HasSubstr("at least 32 bytes"));
  for (const char* const file : {"short", "empty", "missing", "/dev/zero", "assets"}) {
    EXPECT_EQ(validate({"--cache-key", file}).code, 2) << file;
  }
  EXPECT_EQ(gltfx({"validate", "assets", "--cache-key", "short"}, setting_).code, 2);
  Setting nowhere = setting_;
  nowhere.environment = {{"XDG_STATE_HOME", ""}, {"HOME", ""}};
  const Outcome homeless = validate_as(nowhere);
  EXPECT_EQ(homeless.code, 2);
  EXPECT_THAT(homeless.err, HasSubstr("GLTFX_CACHE_KEY"));
}

TEST_F(Forgery, AFolderThatGitTracksIsRefused) {
  folder_.write("assets/a.gltf", kSound);
  folder_.write("cache/forged.results", "");
  const auto git = [&](const std::string& words) { return bash("git " + words, setting_).code; };
  ASSERT_EQ(git("init -q ."), 0);
  EXPECT_EQ(validate().code, 0) << "not tracked yet";
  ASSERT_EQ(git("add cache/forged.results"), 0);
  const Outcome tracked = validate();
  EXPECT_EQ(tracked.code, 2);
  EXPECT_THAT(tracked.err, HasSubstr("git tracks files in 'cache'"));
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
  for (int i = 0; i < 20; ++i) {
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
