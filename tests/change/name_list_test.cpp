// SPDX-License-Identifier: Apache-2.0
// Names in extensionsUsed and extensionsRequired come and go.
#include "change/name_list.hpp"

#include <functional>

#include <gmock/gmock.h>

#include "json/parse.hpp"

namespace gltfx::change {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using NameChange = std::function<void(NameList&)>;

std::string with_names(const std::string& text, const NameChange& change) {
  const json::Parsed parsed = json::parse(std::string_view(text));
  NameList list(parsed.document, "extensionsUsed");
  change(list);
  json::Editor editor(parsed.document);
  list.apply(editor);
  return json::apply_edits(text, editor.take());
}

TEST(NameList, ANameTakesThePlaceOfAnother) {
  const NameChange change = [](NameList& list) { list.replace("A", "C"); };
  EXPECT_EQ(with_names(R"({"extensionsUsed":["A","B"]})", change),
            R"({"extensionsUsed":["C","B"]})");
  EXPECT_EQ(with_names(R"({"extensionsUsed":["A","A"]})", change), R"({"extensionsUsed":["C"]})");
  EXPECT_EQ(with_names(R"({"extensionsUsed":["C","A"]})", change), R"({"extensionsUsed":["C"]})");
  EXPECT_EQ(with_names(R"({"extensionsUsed":["\u0041"]})", change), R"({"extensionsUsed":["C"]})");
  EXPECT_EQ(with_names(R"({"extensionsUsed":["B"]})", change), R"({"extensionsUsed":["B"]})");
}

TEST(NameList, GoesWithItsLastName) {
  const NameChange change = [](NameList& list) { list.remove("A"); };
  EXPECT_EQ(with_names(R"({"extensionsUsed":["A","A"],"b":1})", change), R"({"b":1})");
  EXPECT_EQ(with_names(R"({"extensionsUsed":["A",1],"b":1})", change),
            R"({"extensionsUsed":[1],"b":1})");
  EXPECT_EQ(with_names(R"({"extensionsUsed":[],"b":1})", change), R"({"extensionsUsed":[],"b":1})");
}

TEST(NameList, NamesAreAddedOnce) {
  const NameChange change = [](NameList& list) {
    list.add("A");
    list.add("B");
    list.add("B");
  };
  EXPECT_EQ(with_names(R"({"extensionsUsed":["A"]})", change), R"({"extensionsUsed":["A","B"]})");
  EXPECT_EQ(with_names(R"({})", change), R"({"extensionsUsed": ["A", "B"]})");
  EXPECT_EQ(with_names(R"({"extensionsUsed":7})", change), R"({"extensionsUsed":7})");
}

TEST(NameList, ManyAreTakenOutTogether) {
  std::set<std::string> removed;
  const NameChange change = [&](NameList& list) {
    list.add("D");
    removed = list.remove_all({{"A", 1}, {"C", 2}, {"D", 3}, {"E", 4}});
  };
  EXPECT_EQ(with_names(R"({"extensionsUsed":["A","B","C"]})", change),
            R"({"extensionsUsed":["B"]})");
  EXPECT_THAT(removed, ElementsAre("A", "C", "D"));
}

TEST(NameList, PlacesAreThoseOfTheText) {
  const json::Parsed parsed = json::parse(std::string_view(R"({"extensionsUsed":["A",1,"A"]})"));
  NameList list(parsed.document, "extensionsUsed");
  list.remove("A");
  EXPECT_FALSE(list.has("A"));
  EXPECT_THAT(list.places("A"), ElementsAre("/extensionsUsed/0", "/extensionsUsed/2"));
  EXPECT_THAT(list.places("B"), IsEmpty());
}

}  // namespace
}  // namespace gltfx::change
