// SPDX-License-Identifier: Apache-2.0
/// How long files and functions are.
#include <algorithm>

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
