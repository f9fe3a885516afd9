// SPDX-License-Identifier: Apache-2.0
/// Local statics of the library: one that is made when its line is first reached is never made in
/// the child of a fork() that came meanwhile, which waits for it.
#include <map>
#include <regex>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::map<std::string, std::string, std::less<>> kExceptions{
    {"libgltfx/base/fork.cpp", "made when the library is loaded"},
    {"libgltfx/container/mapped_files.cpp", "made when the library is loaded"},
    {"libgltfx/codec/in_process.cpp", "for systems without fork()"},
};

Problems check_statics(const Source& source) {
  static const std::regex kStatic(
      R"(^\s+static\s+(?!constexpr|constinit|thread_local|inline)[^()]*[={;].*)");
  Problems problems;
  std::istringstream lines(lex(source.text).code);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (!std::regex_match(line, kStatic)) continue;
    problems.push_back(problem(source, number, "a local static; use MadeOnce or PerProcess"));
  }
  return problems;
}

TEST(Statics, OfTheLibraryAreMadeWithoutALock) {
  Problems problems;
  for (const Source& source : cpp_below({"libgltfx"})) {
    if (source.path.starts_with("libgltfx/schema/compiler/")) continue;  // a separate program
    const Problems found = check_statics(source);
    const bool excepted = kExceptions.count(source.path) > 0;
    EXPECT_FALSE(excepted && found.empty()) << source.path << " needs no exception";
    if (!excepted) problems.insert(problems.end(), found.begin(), found.end());
  }
  EXPECT_THAT(problems, IsEmpty());
}

TEST(Statics, AreSeen) {
  EXPECT_THAT(check_statics({"a.cpp", "int f() {\n  static const Table t = make();\n}\n"}),
              ElementsAre("a.cpp:2: a local static; use MadeOnce or PerProcess"));
  EXPECT_THAT(check_statics({"a.cpp", "int f() {\n  static const Lists kNone;\n}\n"}),
              testing::SizeIs(1));
  EXPECT_THAT(check_statics({"a.cpp",
                             "struct S {\n  static int f(int = 0);\n"
                             "  static constexpr int k = 0;\n};\n"}),
              IsEmpty());
}

}  // namespace
}  // namespace gltfx::structure
