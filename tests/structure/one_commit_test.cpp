// SPDX-License-Identifier: Apache-2.0
/// Files of assets are replaced, and bytes appended to assets, in one place: libgltfx/change.
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Files that write other files than those of assets, or implement writing.
const std::map<std::string, std::string, std::less<>> kWriters{
    {"libgltfx/container/bytes.hpp", "writes pieces into a draft that it is given"},
    {"libgltfx/container/bytes.cpp", "writes pieces into a draft that it is given"},
    {"libgltfx/pipeline/picture_file.cpp", "pictures"},
    {"libgltfx/pipeline/result_store.cpp", "the cache of results"},
    {"libgltfx/pipeline/seal.cpp", "the key of the cache"},
    {"tools/gltfx/compare_pictures.cpp", "pictures"},
    {"tools/gltfx/output.cpp", "reports"},
    {"tools/gltfx/output.hpp", "reports"},
    {"tools/gltfx/schema_tests.cpp", "new folders of test cases"},
    {"tools/gltfx_manual/main.cpp", "a program of the build"},
};

struct Ban {
  std::vector<std::string_view> words;  ///< where each begins and, unless it ends in '(', ends
  std::string_view why;
};

const std::vector<Ban> kBans{
    {{"FileDraft", "TemporaryFile", "replace_file(", "create_file(", "write_file(", "std::ofstream",
      "fs::rename(", "fs::copy_file(", "filesystem::rename(", "::rename(", "::renameat("},
     "replaces a file; change::commit() does that"},
    {{"BinChange", "BytePatch", "second.more", "second.patches", ".more", ".patches"},
     "appends bytes; change::place() does that"},
};

bool is_use(std::string_view code, std::size_t at, std::string_view word) {
  const std::size_t end = at + word.size();
  if (at > 0 && is_part_of_name(code[at - 1])) return false;
  return word.back() == '(' || end == code.size() || !is_part_of_name(code[end]);
}

Problems check_commit(const Source& source) {
  Problems problems;
  const std::string_view code = lex(source.text).code;
  for (const Ban& ban : kBans) {
    for (const std::string_view word : ban.words) {
      for (std::size_t at = code.find(word); at != code.npos; at = code.find(word, at + 1)) {
        if (!is_use(code, at, word)) continue;
        problems.push_back(problem(source, line_of(source.text, at), ban.why));
      }
    }
  }
  return problems;
}

TEST(OneCommit, WritesAllFilesOfAssets) {
  Problems problems;
  for (const Source& source : cpp_below({"libgltfx", "tools"})) {
    if (starts_with_any(source.path,
                        {"libgltfx/base/", "libgltfx/change/", "libgltfx/schema/compiler/"})) {
      continue;
    }
    const Problems found = check_commit(source);
    const bool excepted = kWriters.count(source.path) > 0;
    EXPECT_FALSE(excepted && found.empty()) << source.path << " needs no exception";
    if (!excepted) problems.insert(problems.end(), found.begin(), found.end());
  }
  EXPECT_THAT(problems, IsEmpty());
}

TEST(OneCommit, OtherWritersAreFound) {
  EXPECT_THAT(check_commit({"a.cpp", "int f() {\n  FileDraft draft(path, seen);\n}\n"}),
              ElementsAre("a.cpp:2: replaces a file; change::commit() does that"));
  EXPECT_THAT(check_commit({"a.cpp", "fs::rename(from, to);\n"}),
              ElementsAre(HasSubstr("a.cpp:1")));
  EXPECT_THAT(check_commit({"a.cpp", "change.bins[1].more += png;\n"}),
              ElementsAre("a.cpp:1: appends bytes; change::place() does that"));
  EXPECT_THAT(check_commit({"a.cpp", "// FileDraft\nreplaced.push_back(file);\n"}), IsEmpty());
}

}  // namespace
}  // namespace gltfx::structure
