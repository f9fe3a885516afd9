// SPDX-License-Identifier: Apache-2.0
/// A type of the public headers is defined in one place: of two, a program that uses both headers
/// gets either, and crashes.
#include <map>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Definitions at the level of a namespace, which clang-format does not indent.
Problems check_names(const std::vector<Source>& headers) {
  const std::regex definition(
      R"((?:^|\n)(?:struct|class|enum class|enum|union) (\w+)[^;(\n]*\{|(?:^|\n)using (\w+) =)");
  std::map<std::string, std::string> known;
  Problems problems;
  for (const Source& header : headers) {
    const std::string& code = lex(header.text).code;
    for (std::sregex_iterator at(code.begin(), code.end(), definition), end; at != end; ++at) {
      const std::string name = (*at)[1].matched ? (*at)[1] : (*at)[2];
      const auto [first, fresh] = known.emplace(name, header.path);
      if (!fresh) problems.push_back(header.path + ": " + name + " is in " + first->second);
    }
  }
  return problems;
}

TEST(PublicNames, AreDefinedOnce) {
  EXPECT_THAT(check_names(cpp_below({"libgltfx/include"})), IsEmpty());
}

TEST(PublicNames, RepeatedOnesAreSeen) {
  EXPECT_THAT(check_names({{"a.hpp", "struct A {\n};\nenum class B : int { c };\n"},
                           {"b.hpp", "using B = int;\nstruct A : C {\n};\nstruct D;\n"}}),
              ElementsAre("b.hpp: B is in a.hpp", "b.hpp: A is in a.hpp"));
}

}  // namespace
}  // namespace gltfx::structure
