// SPDX-License-Identifier: Apache-2.0
/// How long files and functions are.
#include <algorithm>
#include <map>
#include <regex>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t kLongestFile = 400;
constexpr std::size_t kLongestFunction = 100;
constexpr std::size_t kMedianFile = 120;
constexpr std::size_t kMedianFunction = 12;
constexpr std::size_t kMostMembers = 12;  // of a class
constexpr std::size_t kMostFields = 20;   // of a struct, which is data that is passed on

// Classes and structs with more data members than that, and why.
const std::map<std::string, std::string, std::less<>> kLargeClasses{
    {"AssetFacts", "one list for each kind of object, which one format writes"},
    {"BakeOptions", "one member for each option"},
    {"Context", "upgrade: what all plans of a run share; each member is changed in one place"},
    {"Deviations", "one flag for each deviation of the Khronos validator"},
    {"Extension", "one member for each word of the vocabulary"},
    {"Frame", "what the walk keeps of an object until it leaves it, in place of recursion"},
    {"Ktx2", "the header of a KTX2 file, member by member"},
    {"Material", "one member for each parameter of Appendix B and its extensions"},
    {"Shape", "one member for each keyword of JSON Schema and of the vocabulary"},
    {"Walker",
     "one walk: what it reads, where it reports, and the stack that stands for recursion"},
    {"Declaration", "what the options of each verb are read into"},
};

Problems check_file_length(const Source& source) {
  const std::size_t lines = line_count(source.text);
  if (lines <= kLongestFile) return {};
  return {problem(source, lines, std::to_string(lines) + " lines in one file")};
}

Problems check_function_length(const Source& source) {
  Problems problems;
  for (const Function& function : functions_of(source.text)) {
    if (function.lines <= kLongestFunction) continue;
    problems.push_back(
        problem(source, function.line, std::to_string(function.lines) + " lines in one function"));
  }
  return problems;
}

struct Class {
  std::size_t line = 0;  ///< from 1
  std::string name;
  std::size_t members = 0;  ///< data members; of a class those whose names end in '_'
  bool is_struct = false;
};

// The data members that a line of a struct declares.
std::size_t fields_in(std::string line) {
  static const std::regex declaration(
      R"re(^ *(?!using |friend |static |return |typedef |enum |struct )[\w:][\w: *&]* \**\w+)re"
      R"re((\[.*\])?( = [^,;]*)?(, \w+( = [^,;]*)?)*; *$)re");
  static const std::regex angled(R"(<[^<>]*>)");
  static const std::regex nested(R"(\{[^{}]*\}|\([^()]*\))");
  const auto strip = [&line](const std::regex& what) {
    for (std::string before; before != line;) {
      before = line;
      line = std::regex_replace(line, what, "");
    }
  };
  strip(angled);                                  // std::function<void(int)> is no function
  if (line.find('(') < line.find('=')) return 0;  // a function
  strip(nested);
  if (!std::regex_match(line, declaration)) return 0;
  return 1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
}

// Classes of clang-formatted code, found by the indent of their lines.
std::vector<Class> classes_of(std::string_view text) {
  static const std::regex head(R"(^( *)(class|struct) ([\w:]+)[^;]*\{$)");
  static const std::regex members(R"(^ *[^ ].*? (\w+_)((?:, \w+_)*)(?: = .*|\{.*\})?; *$)");
  std::vector<Class> all;
  std::vector<std::pair<std::size_t, std::size_t>> open;  // indent, index into all
  std::istringstream lines(lex(text).code);
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    const std::size_t indent = line.find_first_not_of(' ');
    if (indent == std::string::npos) continue;
    while (!open.empty() && indent <= open.back().first && line[indent] == '}') open.pop_back();
    std::smatch match;
    const bool inside = !open.empty() && indent == open.back().first + 2;
    const bool in_struct = inside && all[open.back().second].is_struct;
    if (const std::size_t fields = in_struct ? fields_in(line) : 0; fields > 0) {
      all[open.back().second].members += fields;
    } else if (inside && std::regex_match(line, match, members)) {
      const std::string more = match[2];
      all[open.back().second].members +=
          1 + static_cast<std::size_t>(std::count(more.begin(), more.end(), ','));
    } else if (std::regex_match(line, match, head)) {
      open.emplace_back(indent, all.size());
      all.push_back({number, match[3], 0, match[2] == "struct"});
    }
  }
  return all;
}

Problems check_members(const Source& source) {
  Problems problems;
  for (const Class& one : classes_of(source.text)) {
    if (one.members > (one.is_struct ? kMostFields : kMostMembers) &&
        kLargeClasses.find(one.name) == kLargeClasses.end())
      problems.push_back(
          problem(source, one.line, one.name + " has " + std::to_string(one.members) + " members"));
  }
  return problems;
}

std::size_t median(std::vector<std::size_t> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

Source with_function(std::size_t lines) {
  std::string text = "namespace a {\nint f(int x) {\n";
  for (std::size_t i = 2; i < lines; ++i) text += "  if (x > 0) { ++x; }\n";
  return {"f.cpp", text + "}\n}  // namespace a\n"};
}

TEST(Size, NoFileIsLongerThanFourHundredLines) {
  Problems problems;
  for (const Source& source : cpp_below({"libgltfx", "tools", "tests"})) {
    const Problems found = check_file_length(source);
    problems.insert(problems.end(), found.begin(), found.end());
  }
  EXPECT_THAT(problems, IsEmpty());
}

TEST(Size, NoFunctionIsLongerThanAHundredLines) {
  Problems problems;
  for (const Source& source : cpp_below({"libgltfx", "tools", "tests"})) {
    const Problems found = check_function_length(source);
    problems.insert(problems.end(), found.begin(), found.end());
  }
  EXPECT_THAT(problems, IsEmpty());
}

TEST(Size, NoClassOrStructHasManyMembersWithoutAReason) {
  Problems problems;
  std::size_t counted = 0;
  for (const Source& source : cpp_below({"libgltfx", "tools"})) {
    const Problems found = check_members(source);
    problems.insert(problems.end(), found.begin(), found.end());
    for (const Class& one : classes_of(source.text)) counted += one.members;
  }
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_GT(counted, 500U) << "members are not found any more";
}

TEST(Size, MembersOfAClassAreCounted) {
  const std::string text =
      "class A : public B {\n public:\n  A(int a) : a_(a) {}\n  int get() const { return a_; }\n"
      "  class Inner {\n    int x_ = 0;\n  };\n\n private:\n  void f(int b_);\n  int a_;\n"
      "  std::map<int, int> c_, d_;  ///< both\n  int e_{0};\n  Path f_ = g(1);\n};\n";
  const std::vector<Class> found = classes_of(text);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].members, 5U);
  EXPECT_EQ(found[1].members, 1U);
}

TEST(Size, MembersOfAStructAreCounted) {
  const std::string text =
      "struct A {\n  int a = 0, b = 0;  ///< both\n  std::map<int, int> c = {};\n  float d[3];\n"
      "  using E = int;\n  bool f(int g) const { return g > 0; }\n  std::string h{};\n"
      "  static constexpr int kI = 1;\n  const Path* j = g(1, 2);\n  friend bool k(A, A);\n"
      "  std::function<void(int)> l;\n  std::vector<int> m() const;\n};\n";
  const std::vector<Class> found = classes_of(text);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].members, 7U);
}

TEST(Size, TheMedianFileAndFunctionAreShort) {
  std::vector<std::size_t> files;
  std::vector<std::size_t> functions;
  for (const Source& source : cpp_below({"libgltfx", "tools"})) {
    files.push_back(line_count(source.text));
    for (const Function& function : functions_of(source.text)) functions.push_back(function.lines);
  }
  EXPECT_LE(median(files), kMedianFile);
  EXPECT_LE(median(functions), kMedianFunction);
  EXPECT_GT(functions.size(), files.size()) << "functions are not found any more";
}

TEST(Size, ALongFileIsFound) {
  EXPECT_THAT(check_file_length({"a.cpp", std::string(kLongestFile + 1, '\n')}),
              ElementsAre(HasSubstr("401 lines in one file")));
  EXPECT_THAT(check_file_length({"a.cpp", std::string(kLongestFile, '\n')}), IsEmpty());
}

TEST(Size, ALongFunctionIsFound) {
  EXPECT_THAT(check_function_length(with_function(kLongestFunction)), IsEmpty());
  EXPECT_THAT(check_function_length(with_function(kLongestFunction + 1)),
              ElementsAre("f.cpp:2: 101 lines in one function"));
}

TEST(Size, FunctionsAreCountedInClassesAndBesideOddText) {
  const std::string text =
      "class A {\n public:\n  A() : a_{1} {\n    g(\"}\");\n  }\n  int get() const { return a_; }\n"
      " private:\n  int a_{0};\n};\nconstexpr int kTable[] = {\n  1,\n};\n"
      "char f(char c) {  // }\n  return c == '}' ? '{' : R\"x()\" })x\"[0];\n}\n";
  std::vector<std::size_t> lines;
  for (const Function& function : functions_of(text)) lines.push_back(function.lines);
  EXPECT_THAT(lines, ElementsAre(3U, 1U, 3U));
}

}  // namespace
}  // namespace gltfx::structure
