// SPDX-License-Identifier: Apache-2.0
/// Only graph/ finds references.
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The words of schemas about references, and the visitor that gets them.
const std::set<std::string_view> kWords{"ReferenceUse", "ReferenceVisitor", "may_refer",
                                        "may_point",    "ref_has",          "ref_name"};

// Files that may read them nevertheless, or folders of such files.
const std::map<std::string, std::string, std::less<>> kReaders{
    {"libgltfx/graph/", "what refers to what"},
    {"libgltfx/prove/storage.cpp",
     "which extensions are another way to store something, whether or not a document has them"},
    {"libgltfx/schema/", "reads the words, and judges each reference where the walk meets it"},
    {"tools/gltfx/schema_json.cpp", "prints the words of a schema"},
    {"tools/gltfx/schema_words.cpp", "prints the words of a schema"},
};

bool is_reader(std::string_view path) {
  for (const auto& [reader, reason] : kReaders) {
    if (path.starts_with(reader)) return true;
  }
  return false;
}

// Lines with one of the words, or with a member `ref`.
Problems check_words(const Source& source) {
  Problems problems;
  const std::string& code = lex(source.text).code;
  std::size_t line = 1;
  for (std::size_t at = 0; at < code.size();) {
    line += code[at] == '\n' ? 1 : 0;
    std::size_t end = at;
    while (end < code.size() && is_part_of_name(code[end])) ++end;
    const std::string_view word(code.data() + at, end - at);
    const bool member = at > 0 && (code[at - 1] == '.' || code[at - 1] == '>');
    if (kWords.contains(word) || (member && word == "ref")) {
      problems.push_back(source.path + ":" + std::to_string(line) + ": reads " + std::string(word));
    }
    at = std::max(end, at + 1);
  }
  return problems;
}

TEST(References, AreFoundByTheGraphAlone) {
  Problems problems;
  for (const Source& source : cpp_below({"libgltfx", "tools"})) {
    if (is_reader(source.path)) continue;
    const Problems found = check_words(source);
    problems.insert(problems.end(), found.begin(), found.end());
  }
  EXPECT_THAT(problems, IsEmpty());
}

TEST(References, TheListHasNoEntryThatIsNotNeeded) {
  for (const auto& [reader, reason] : kReaders) {
    bool needed = false;
    for (const Source& source : cpp_below({reader})) {
      needed = needed || !check_words(source).empty();
    }
    EXPECT_TRUE(needed) << reader;
  }
}

TEST(References, AWordIsFound) {
  EXPECT_THAT(check_words({"a.cpp", "f();\nif (shape->ref && x.ref_name) g(reference);"}),
              ElementsAre("a.cpp:2: reads ref", "a.cpp:2: reads ref_name"));
}

}  // namespace
}  // namespace gltfx::structure
