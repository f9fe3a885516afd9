// SPDX-License-Identifier: Apache-2.0
/// A text compared with the result of its edits.
#include "prove/text.hpp"

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace gltfx::prove {
namespace {

const std::string kText = R"({"a": 1, "b": [2, 3]})";
const std::vector<json::Edit> kEdits{{{6, 7}, "10"}, {{20, 20}, ", 4"}};

TEST(FindUneditedChange, FindsNoneWhereTheEditsAreMade) {
  EXPECT_EQ(find_unedited_change(kText, json::apply_edits(kText, kEdits), kEdits), std::nullopt);
  EXPECT_EQ(find_unedited_change(kText, kText, {}), std::nullopt);
}

TEST(FindUneditedChange, FindsEachOtherByte) {
  const std::string edited = json::apply_edits(kText, kEdits);
  for (std::size_t i = 0; i < edited.size(); ++i) {
    std::string other = edited;
    other[i] ^= 1;
    EXPECT_NE(find_unedited_change(kText, other, kEdits), std::nullopt) << i;
    EXPECT_NE(find_unedited_change(kText, edited.substr(0, i), kEdits), std::nullopt) << i;
  }
  EXPECT_EQ(find_unedited_change(kText, edited + " ", kEdits), kText.size());
}

TEST(FindUneditedChange, SaysWhere) {
  EXPECT_EQ(find_unedited_change(kText, R"({"a": 10, "c": [2, 3, 4]})", kEdits), 10U);
  EXPECT_EQ(find_unedited_change(kText, R"({"a": 11, "b": [2, 3, 4]})", kEdits), 6U);
}

TEST(FindUneditedChange, TakesEditsThatDoNotFit) {
  const std::vector<json::Edit> beyond{{{6, 99}, "1"}};
  EXPECT_NE(find_unedited_change(kText, kText, beyond), std::nullopt);
  const std::vector<json::Edit> disorder{{{9, 10}, "x"}, {{2, 3}, "y"}};
  EXPECT_NE(find_unedited_change(kText, kText, disorder), std::nullopt);
  const std::vector<json::Edit> backwards{{{9, 5}, ""}};
  EXPECT_NE(find_unedited_change(kText, kText, backwards), std::nullopt);
}

}  // namespace
}  // namespace gltfx::prove
