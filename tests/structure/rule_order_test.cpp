// SPDX-License-Identifier: Apache-2.0
/// Rules run because rules/order.cpp lists them, each once.
#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::string_view kOrder = "libgltfx/rules/order.cpp";

std::vector<std::string> names_in(const std::string& code, const std::regex& pattern) {
  std::vector<std::string> names;
  for (std::sregex_iterator at(code.begin(), code.end(), pattern), end; at != end; ++at) {
    names.push_back((*at)[1]);
  }
  return names;
}

// Groups that are not in the list once.
Problems check_order(const std::string& order, const std::vector<Source>& sources) {
  const std::vector<std::string> listed =
      names_in(order, std::regex(R"(\n    ([a-z0-9_]+_rules),)"));
  Problems problems;
  for (const Source& source : sources) {
    for (const std::string& name :
         names_in(source.text, std::regex(R"(\nconst RuleGroup& ([a-z0-9_]+_rules)\(\) \{)"))) {
      if (std::count(listed.begin(), listed.end(), name) == 1) continue;
      problems.push_back(problem(source, 1, name + " is not in the order once"));
    }
  }
  return problems;
}

TEST(RuleOrder, HasEachGroupOnce) {
  std::vector<Source> sources = cpp_below({"libgltfx/rules"});
  const auto order = std::find_if(sources.begin(), sources.end(),
                                  [](const Source& source) { return source.path == kOrder; });
  ASSERT_NE(order, sources.end());
  EXPECT_THAT(names_in(order->text, std::regex(R"(\n    ([a-z0-9_]+_rules),)")),
              testing::SizeIs(testing::Gt(60U)));
  EXPECT_THAT(check_order(order->text, sources), IsEmpty());
}

TEST(RuleOrder, AGroupThatIsNotInItIsFound) {
  const std::vector<Source> sources{{"a.cpp", "\nconst RuleGroup& a_rules() {\n}\n"},
                                    {"b.cpp", "\nconst RuleGroup& b_rules() {\n}\n"}};
  EXPECT_THAT(check_order("{\n    a_rules,\n}", sources),
              ElementsAre("b.cpp:1: b_rules is not in the order once"));
  EXPECT_THAT(check_order("{\n    a_rules,\n    b_rules,\n    b_rules,\n}", sources),
              ElementsAre("b.cpp:1: b_rules is not in the order once"));
}

}  // namespace
}  // namespace gltfx::structure
