// SPDX-License-Identifier: Apache-2.0
/// External assets of glTF 2.1 from outside: their place in reports, and what finds a changed one.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::string parent_of(const std::string& uri) {
  return R"({"asset":{"version":"2.1"},"externalAssets":[{"file":0}],"files":[{"uri":")" + uri +
         R"(","mimeType":"model/gltf+json"}]})";
}

const std::string kChild = R"({"asset":{"version":"2.1"}})";
const std::string kWrongChild = R"({"asset":{"version":"2.1"},"scenes":[{"nodes":[7]}]})";

class ExternalFiles : public testing::Test {
 protected:
  Outcome validate(std::vector<std::string> words) const {
    words.insert(words.begin(), {"validate", "--isolated", "--fail-on", "error"});
    return gltfx(std::move(words), {folder_.path().native(), {}, {}});
  }
  std::vector<std::string> paths(std::vector<std::string> words) const {
    words.insert(words.end(), {"--format", "json"});
    const nlohmann::json report = nlohmann::json::parse(validate(std::move(words)).out);
    std::vector<std::string> paths;
    for (const nlohmann::json& file : report["files"]) {
      paths.push_back(file["path"].get<std::string>());
    }
    return paths;
  }
  Outcome shell(const std::string& line) const {
    return bash(line, {folder_.path().native(),
                       {},
                       {{"HOME", folder_.path().native()}, {"GIT_CONFIG_NOSYSTEM", "1"}}});
  }
  void commit() const {
    ASSERT_EQ(shell("git init -q . && git add -A && git -c user.name=a "
                    "-c user.email=a@example.com commit -q -m x")
                  .code,
              0);
  }

  TempFolder folder_;
};

TEST_F(ExternalFiles, AreListedOnceAfterTheInputs) {
  folder_.write("a.gltf", parent_of("sub/c.gltf"));
  folder_.write("b.gltf", parent_of("a.gltf"));
  folder_.write("sub/c.gltf", kWrongChild);
  EXPECT_THAT(paths({"a.gltf"}), ElementsAre("a.gltf", "sub/c.gltf"));
  EXPECT_THAT(paths({"b.gltf", "./a.gltf"}), ElementsAre("b.gltf", "./a.gltf", "sub/c.gltf"));
  EXPECT_THAT(paths({"b.gltf", "sub/c.gltf"}), ElementsAre("b.gltf", "sub/c.gltf", "a.gltf"));
  EXPECT_THAT(paths({"."}), ElementsAre("./a.gltf", "./b.gltf", "./sub/c.gltf"));
}

TEST_F(ExternalFiles, AreInReportsOfEveryForm) {
  folder_.write("a.gltf", parent_of("c.gltf"));
  folder_.write("c.gltf", kWrongChild);
  for (const std::string format :
       {"text", "json", "jsonl", "github", "gitlab", "sarif", "junit", "agent"}) {
    const Outcome outcome = validate({"a.gltf", "--format", format});
    EXPECT_EQ(outcome.code, 1) << format;
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("EXTERNAL_ASSET_INVALID"), HasSubstr("c.gltf"),
                                   HasSubstr("UNRESOLVED_REFERENCE")))
        << format;
  }
  const Outcome khronos = validate({"a.gltf", "--profile", "khronos", "--format", "khronos"});
  EXPECT_THAT(khronos.out, Not(HasSubstr("UNRESOLVED_REFERENCE")));
}

TEST_F(ExternalFiles, AreTheSameInShards) {
  for (const char* const name : {"a", "b", "d", "e"}) {
    folder_.write(std::string(name) + ".gltf", parent_of("parts/c.gltf"));
  }
  folder_.write("parts/c.gltf", kWrongChild);
  const std::vector<std::string> inputs{"a.gltf", "b.gltf", "d.gltf", "e.gltf"};
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.end(), inputs.begin(), inputs.end());
    return validate(more).out;
  };
  run({"--shard", "1/2", "--format", "jsonl=1.jsonl"});
  run({"--shard", "2/2", "--format", "jsonl=2.jsonl"});
  const Outcome merged =
      gltfx({"merge", "2.jsonl", "1.jsonl", "--format", "json"}, {folder_.path().native(), {}, {}});
  EXPECT_EQ(merged.out, run({"--format", "json"})) << merged.err;
}

TEST_F(ExternalFiles, FormNoCycleByTheirNamesAlone) {
  folder_.write("a.gltf", parent_of("sub/a.gltf"));
  folder_.write("sub/a.gltf", kChild);
  EXPECT_EQ(validate({"a.gltf"}).code, 0);
  std::filesystem::remove(folder_.path() / "sub/a.gltf");
  std::filesystem::create_hard_link(folder_.path() / "a.gltf", folder_.path() / "sub/a.gltf");
  EXPECT_THAT(validate({"a.gltf"}).out, HasSubstr("EXTERNAL_ASSET_CYCLE"));
  std::filesystem::remove(folder_.path() / "sub/a.gltf");
  std::filesystem::create_symlink("../a.gltf", folder_.path() / "sub/a.gltf");
  EXPECT_THAT(validate({"a.gltf"}).out, HasSubstr("EXTERNAL_ASSET_CYCLE"));
}

TEST_F(ExternalFiles, ThatChangedAreNotRecalled) {
  folder_.write("a.gltf", parent_of("sub/b.gltf"));
  folder_.write("sub/b.gltf", parent_of("../c.gltf"));
  folder_.write("c.gltf", kChild);
  TempFolder::wait_for_tick();
  const std::vector<std::string> words{"a.gltf", "--cache", "cache", "--format", "json"};
  const Outcome first = validate(words);
  EXPECT_EQ(first.code, 0) << first.out;
  EXPECT_EQ(validate(words).out, first.out);
  folder_.write("c.gltf", kWrongChild);
  const Outcome changed = validate(words);
  EXPECT_EQ(changed.code, 1);
  EXPECT_THAT(changed.out, HasSubstr("UNRESOLVED_REFERENCE"));
  EXPECT_EQ(validate(words).out, changed.out);
  EXPECT_EQ(validate({"a.gltf", "--format", "json"}).out, changed.out);
}

TEST_F(ExternalFiles, AreRecalledInAnotherFolder) {
  folder_.write("x/a.gltf", parent_of("b.gltf"));
  folder_.write("x/b.gltf", kWrongChild);
  TempFolder::wait_for_tick();
  validate({"x/a.gltf", "--cache", "cache"});
  std::filesystem::copy(folder_.path() / "x", folder_.path() / "y");
  TempFolder::wait_for_tick();
  const Outcome kept = validate({"y/a.gltf", "--cache", "cache", "--format", "json"});
  EXPECT_EQ(kept.out, validate({"y/a.gltf", "--format", "json"}).out);
  EXPECT_THAT(kept.out, AllOf(HasSubstr("y/b.gltf"), Not(HasSubstr("x/"))));
}

// The inputs share the report on the external asset; each of them notices its files.
TEST_F(ExternalFiles, OfSeveralInputsAreFollowedByTheCache) {
  std::vector<std::string> words{"--cache", "cache", "--root", ".", "--format", "json"};
  for (const char* const name : {"a", "b", "x/d", "x/e"}) {
    const std::string path = std::string(name) + ".gltf";
    folder_.write(
        path, parent_of(path.find('/') == std::string::npos ? "parts/c.gltf" : "../parts/c.gltf"));
    words.push_back(path);
  }
  folder_.write("parts/c.gltf", R"({"asset":{"version":"2.1"},"buffers":[{"byteLength":4,
    "uri":"c.bin"}],"bufferViews":[{"buffer":0,"byteLength":4}]})");
  folder_.write("parts/c.bin", "1234");
  TempFolder::wait_for_tick();
  const Outcome first = validate(words);
  EXPECT_EQ(first.code, 0) << first.out;
  EXPECT_EQ(validate(words).out, first.out);
  folder_.write("parts/c.bin", "12");
  for (std::size_t input = words.size() - 4; input < words.size(); ++input) {
    const Outcome changed = validate({"--cache", "cache", "--root", ".", words[input]});
    EXPECT_EQ(changed.code, 1) << words[input];
  }
  std::vector<std::string> plain(words.begin() + 2, words.end());
  const Outcome all = validate(words);
  for (const char* const jobs : {"1", "4"}) {
    plain.insert(plain.end(), {"--jobs", jobs});
    EXPECT_EQ(validate(plain).out, all.out) << jobs;
    plain.resize(plain.size() - 2);
  }
}

class ExternalFilesInGit : public ExternalFiles {
 protected:
  void SetUp() override {
    if (bash("command -v git").code != 0) GTEST_SKIP() << "git is not installed";
    folder_.write("a.gltf", parent_of("b.gltf"));
    folder_.write("b.gltf", parent_of("c.gltf"));
    folder_.write("c.gltf", R"({"asset":{"version":"2.1"},
"materials":[{"alphaCutoff":1},
{"alphaCutoff":-1}]})");
    folder_.write("other.gltf", kChild);
    commit();
  }
  Outcome since() const {
    return validate({"a.gltf", "-f", "agent", "-q", "--diff-base", "HEAD", "--select",
                     "VALUE_NOT_IN_RANGE,EXTERNAL_ASSET_INVALID"});
  }
};

TEST_F(ExternalFilesInGit, HaveChangedLines) {
  EXPECT_EQ(since().out, "");
  folder_.write("c.gltf", R"({"asset":{"version":"2.1"},
"materials":[{"alphaCutoff":-2},
{"alphaCutoff":-1}]})");
  const Outcome outcome = since();
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("c.gltf:2:"), HasSubstr("/materials/0/alphaCutoff"),
                                 Not(HasSubstr("/materials/1/alphaCutoff"))));
  EXPECT_THAT(outcome.out, HasSubstr("a.gltf")) << "what refers to it changed as well";
}

TEST_F(ExternalFilesInGit, FindTheirParentsInAHook) {
  folder_.write("c.gltf", kWrongChild);
  shell("git add c.gltf");
  const Outcome outcome = shell("\"$GLTFX\" hook validate --isolated");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("a.gltf"), HasSubstr("b.gltf"), HasSubstr("c.gltf"),
                                 Not(HasSubstr("other.gltf"))));
}

}  // namespace
}  // namespace gltfx::program
