// SPDX-License-Identifier: Apache-2.0
// Members that an upgrade adds to the object that carried the extension.
#include "steps/upgrade/placements.hpp"

#include <gmock/gmock.h>

#include "steps/upgrade/context.hpp"
#include "support.hpp"

namespace gltfx::upgrade::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Puts = std::vector<std::pair<std::string, std::string>>;

struct Placed {
  std::string text;
  std::vector<std::string> problems, overwritten, extensions;
};

Placed placed(const std::string& material, const Puts& puts) {
  const std::string text = R"({"materials":[)" + material + "]}";
  const json::Parsed parsed = json::parse(std::string_view(text));
  const UpgradeOptions options;
  Context context(parsed.document, *schema::builtin_set(), options, nullptr, nullptr);
  Host host;
  host.node = parsed.document.resolve("/materials/0");
  Placements placements(context, host);
  Placed done;
  for (const auto& [path, json] : puts) {
    if (const auto problem = placements.put(path, json)) done.problems.push_back(*problem);
  }
  placements.apply();
  done.overwritten = placements.overwritten();
  done.extensions = placements.extensions();
  done.text = Json::parse(json::apply_edits(text, context.editor.take()))["materials"][0].dump();
  return done;
}

TEST(Placements, MembersAreAddedReplacedAndTakenOut) {
  const Placed done = placed(R"({"a":{"n":1,"m":2,"s":"x"},"name":"y"})",
                             {{"a/n", ""}, {"a/m", R"("two")"}, {"a/s", "3"}, {"a/new", "4"}});
  EXPECT_EQ(done.text, R"({"a":{"m":"two","s":3,"new":4},"name":"y"})");
  EXPECT_THAT(done.overwritten, ElementsAre("a/n", "a/m", "a/s"));
}

TEST(Placements, ANumberInAnotherSpellingStays) {
  const Placed done = placed(R"({"a":{"n":0.50,"m":1e0}})", {{"a/n", "0.5"}, {"a/m", "1"}});
  EXPECT_EQ(done.text, R"({"a":{"n":0.5,"m":1.0}})");
  EXPECT_THAT(done.overwritten, IsEmpty());
}

TEST(Placements, TheLastOfTwoValuesCountsAndIsNamedOnce) {
  const Placed done = placed(R"({"a":{"n":1}})", {{"a/n", "2"}, {"a/n", "3"}});
  EXPECT_EQ(done.text, R"({"a":{"n":3}})");
  EXPECT_THAT(done.overwritten, ElementsAre("a/n"));
}

TEST(Placements, ObjectsAreMadeWhereTheyAreMissing) {
  const Placed done = placed(R"({"extensions":{"B":{}},"a":{}})", {{"extensions/A/x", "1"},
                                                                   {"extensions/A/gone", ""},
                                                                   {"extensions/B/x", "2"},
                                                                   {"a/b/c", "3"},
                                                                   {"a/gone", ""}});
  EXPECT_EQ(done.text, R"({"extensions":{"B":{"x":2},"A":{"x":1}},"a":{"b":{"c":3}}})");
  EXPECT_THAT(done.extensions, ElementsAre("A"));
}

TEST(Placements, WhatIsNoObjectHoldsNothing) {
  const Placed done = placed(R"({"a":1,"b":{"c":[]}})", {{"a/n", "2"}, {"b/c/d", "3"}});
  EXPECT_THAT(done.problems, ElementsAre("its a is not an object", "its c is not an object"));
  EXPECT_EQ(done.text, R"({"a":1,"b":{"c":[]}})");
}

}  // namespace
}  // namespace gltfx::upgrade::test
