// SPDX-License-Identifier: Apache-2.0
/// The style of sentences for users: no anthropomorphism and no inverted clauses.
#include <algorithm>
#include <cctype>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A phrase, and its replacement.
struct Phrase {
  std::string_view words, instead;
};
constexpr Phrase kPhrases[] = {
    {"stands before", "overrides, or comes before"},
    {"stand before", "override, or come before"},
    {"stands behind", "follows"},
    {"stand behind", "follow"},
    {"stands beside", "is next to"},
    {"stand beside", "are next to"},
    {"stands after", "follows"},
    {"stands alone", "is the only one"},
    {"stands in problems", "is named in problems"},
    {"stands in the", "is in the"},
    {"stand in the", "are in the"},
    {"stands on a", "is on a"},
    {"cannot stand", "is not allowed"},
    {"can stand", "is allowed"},
    {"may stand", "is allowed"},
    {"be had", "exist, or be decoded"},
    {"behind the end", "after the end"},
    {"behind the last", "after the last"},
    {"behind a deleted", "after a deleted"},
    {"behind everything", "after everything"},
    {"points behind", "points after"},
    {"leads behind", "leads to one after"},
    {"in each other's way", "conflict"},
    {"never sees", "does not get"},
    {"nobody", "it is unknown, or not requested"},
    {"somebody", "another reader, or is requested"},
    {"is told", "is reported"},
    {"are told", "are reported"},
    {"heard", "reported, or enabled"},
    {"torn", "truncated"},
    {"mend", "fix"},
    {"mends", "fixes"},
    {"takes the quotes off", "removes the quotes from"},
    {"the one before it", "the previous one"},
    {"the one that is meant", "the intended one"},
    {"nor is", "and ... is not"},
    {"nor are", "and ... are not"},
    {"nor does", "and ... does not"},
    {"nor do", "and ... do not"},
    {"who has", "if you have"},
    {"wants them", "names them"},
};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

// Lower case, with a blank for line breaks, indents and marks of comments.
std::string one_line(std::string_view text, std::vector<std::size_t>& origins) {
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    const bool mark = c == '/' && (text.substr(at, 3) == "///" || text.substr(at, 2) == "//");
    const bool blank = c == ' ' || c == '\n' || mark || (c == '/' && at > 0 && text[at - 1] == '/');
    if (blank && !out.empty() && out.back() == ' ') continue;
    out += blank ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    origins.push_back(at);
  }
  return out;
}

Problems check_words(const Source& source) {
  Problems problems;
  std::vector<std::size_t> origins;
  const std::string text = one_line(source.text, origins);
  for (const auto& [words, instead] : kPhrases) {
    for (std::size_t at = text.find(words); at != std::string::npos;
         at = text.find(words, at + 1)) {
      const std::size_t end = at + words.size();
      if ((at > 0 && is_letter(text[at - 1])) || (end < text.size() && is_letter(text[end]))) {
        continue;
      }
      problems.push_back(
          problem(source, line_of(source.text, origins[at]),
                  "says '" + std::string(words) + "'; say '" + std::string(instead) + "'"));
    }
  }
  return problems;
}

// The literals of C++, each at its line.
Source literals_of(const Source& source) {
  Source said{source.path, {}};
  std::size_t line = 1;
  for (const Literal& literal : lex(source.text).literals) {
    for (; line < literal.line; ++line) said.text += '\n';
    said.text += literal.text;
    line += static_cast<std::size_t>(std::count(literal.text.begin(), literal.text.end(), '\n'));
  }
  return said;
}

TEST(Words, SentencesForUsersAreSaidPlainly) {
  Problems problems;
  const auto check = [&](const Source& source) {
    const Problems found = check_words(source);
    problems.insert(problems.end(), found.begin(), found.end());
  };
  for (const Source& source :
       files_below({"docs", "README.md", "SECURITY.md", "HACKING.md", "CHANGELOG.md", "examples",
                    "schema/rules", "schema/targets/features.json", "schema/targets/README.md",
                    "libgltfx/include", "tools/gltfx_manual"})) {
    if (source.text.find('\0') == std::string::npos) check(source);
  }
  for (const Source& source : cpp_below({"libgltfx", "tools"})) check(literals_of(source));
  EXPECT_THAT(problems, IsEmpty());
}

TEST(Words, TurnedAroundSentencesAreFound) {
  EXPECT_THAT(check_words({"a.md", "\nThe line stands\n  before the file.\n"}),
              ElementsAre(HasSubstr("a.md:2: says 'stands before'")));
  EXPECT_THAT(check_words({"a.hpp", "/// where it cannot be\n/// had\n"}),
              ElementsAre(HasSubstr("a.hpp:1: says 'be had'")));
  EXPECT_THAT(check_words(literals_of({"a.cpp", "f(\"it points \"\n  \"behind the end\");"})),
              testing::Contains(HasSubstr("says 'behind the end'")));
  EXPECT_THAT(check_words({"a.md", "The standby line, understands before, be hadron."}), IsEmpty());
}

}  // namespace
}  // namespace gltfx::structure
