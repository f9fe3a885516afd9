// SPDX-License-Identifier: Apache-2.0
#include "json/edit.hpp"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "json/parse.hpp"

namespace gltfx::json {
namespace {

using Oracle = nlohmann::ordered_json;

Document read(const std::string& text) {
  Parsed parsed = parse(std::string_view(text));
  EXPECT_TRUE(parsed.ok()) << text;
  return std::move(parsed.document);
}

template <class Change>
std::string edited(const std::string& text, const Change& change) {
  const Document document = read(text);
  Editor editor(document);
  change(editor, document);
  return apply_edits(text, editor.take());
}

std::string without(const std::string& text, std::vector<NodeId> items) {
  return edited(text, [&](Editor& editor, const Document&) {
    for (const NodeId item : items) editor.remove(0, item);
  });
}

std::string with_member(const std::string& text, const std::string& pointer,
                        const std::string& json) {
  return edited(text, [&](Editor& editor, const Document& document) {
    editor.append_member(document.resolve(pointer), "new", json);
  });
}

TEST(Edit, NothingToDoLeavesTheText) {
  EXPECT_EQ(edited("{ \"a\" : 1 }", [](Editor&, const Document&) {}), "{ \"a\" : 1 }");
}

TEST(Edit, ARenamedMemberKeepsItsValueAndBlanks) {
  EXPECT_EQ(edited("{ \"a\" : 1.50e0 }",
                   [](Editor& editor, const Document&) { editor.rename(1, "b\"c"); }),
            R"({ "b\"c" : 1.50e0 })");
}

TEST(Edit, ARemovedMemberTakesOneCommaAlong) {
  const std::string text = R"({"a": 1, "b": [2, 3], "c": "x"})";
  EXPECT_EQ(without(text, {1}), R"({"b": [2, 3], "c": "x"})");
  EXPECT_EQ(without(text, {3}), R"({"a": 1, "c": "x"})");
  EXPECT_EQ(without(text, {5}), R"({"a": 1, "b": [2, 3]})");
  EXPECT_EQ(without(text, {1, 3}), R"({"c": "x"})");
  EXPECT_EQ(without(text, {3, 5}), R"({"a": 1})");
  EXPECT_EQ(without(text, {1, 5}), R"({"b": [2, 3]})");
  EXPECT_EQ(without(text, {1, 3, 5}), "{}");
}

TEST(Edit, ARemovedLineGoesWhole) {
  EXPECT_EQ(without("{\n  \"a\": 1,\n  \"b\": 2,\n  \"c\": 3\n}\n", {3}),
            "{\n  \"a\": 1,\n  \"c\": 3\n}\n");
}

TEST(Edit, NewMembersFollowTheIndentationAround) {
  EXPECT_EQ(with_member("{\n\t\"a\": {\n\t\t\"b\": [1, 2]\n\t}\n}", "/a", R"({"c":[3,4],"d":{}})"),
            "{\n\t\"a\": {\n\t\t\"b\": [1, 2],\n\t\t\"new\": {\n\t\t\t\"c\": [3, 4],\n"
            "\t\t\t\"d\": {}\n\t\t}\n\t}\n}");
}

TEST(Edit, LineEndsAndListsOnSeveralLinesAreFollowed) {
  EXPECT_EQ(with_member("{\r\n  \"b\" : [\r\n    1,\r\n    2\r\n  ]\r\n}", "", "[3,4]"),
            "{\r\n  \"b\" : [\r\n    1,\r\n    2\r\n  ],\r\n  \"new\" : [\r\n    3,\r\n    4\r\n"
            "  ]\r\n}");
}

TEST(Edit, ATextWithoutBlanksStaysSo) {
  EXPECT_EQ(with_member(R"({"a":[1,2],"b":{}})", "/b", R"({ "c" : [ 3, 4 ] })"),
            R"({"a":[1,2],"b":{"new":{"c":[3,4]}}})");
}

TEST(Edit, APaddedObjectOnOneLineStaysSo) {
  EXPECT_EQ(with_member("{\n  \"a\": { \"b\": 1 }\n}", "/a", R"({"c":"d e"})"),
            "{\n  \"a\": { \"b\": 1, \"new\": { \"c\": \"d e\" } }\n}");
}

TEST(Edit, AnEmptyContainerIsFilledLikeItsSurroundings) {
  EXPECT_EQ(with_member("{\n  \"a\": {}\n}", "/a", "1"), "{\n  \"a\": {\n    \"new\": 1\n  }\n}");
  EXPECT_EQ(with_member("{}", "", "1"), "{\"new\": 1}");
}

TEST(Edit, LongBlanksAreNotRepeatedInNewText) {
  const std::string blank(100'000, ' ');
  const std::string text =
      "{\n" + blank + "\"a\"" + blank + ":{\n},\"b\":{\n \"c\":[1," + blank + "2]}}";
  const std::string result = with_member(text, "/b", R"({"d":[3,4],"e":{"f":1}})");
  EXPECT_LT(result.size(), text.size() + 100);
}

TEST(Edit, ManyEmptyObjectsTakeNoLongerThanTheyAre) {
  std::string text = "[";
  for (int i = 0; i < 100'000; ++i) text += i == 0 ? "{}" : ",{}";
  text += "]";
  const std::string result = edited(text, [](Editor& editor, const Document& document) {
    for (const NodeId element : document.elements(0)) editor.append_member(element, "a", "1");
  });
  EXPECT_EQ(result.substr(0, 20), R"([{"a": 1},{"a": 1},{)");
}

TEST(Edit, AnIndentationThatDoesNotContinueTheOuterOneIsNoUnit) {
  EXPECT_EQ(with_member("{\n  \"a\": {\n\t\t\t\"b\": 1\n  }\n}", "/a", R"({"c":1})"),
            "{\n  \"a\": {\n\t\t\t\"b\": 1,\n\t\t\t\"new\": {\n\t\t\t  \"c\": 1\n\t\t\t}\n  }\n}");
}

TEST(Edit, TrailingCommasOfNewTextAreLeftOut) {
  EXPECT_EQ(with_member("{\"a\":1}", "", "[true,]"), R"({"a":1,"new":[true]})");
  EXPECT_EQ(with_member("{\"a\":1}", "", R"({"b":2 , })"), R"({"a":1,"new":{"b":2}})");
}

TEST(Edit, ElementsComeAndGoAndScalarsAreReplaced) {
  const std::string text = R"({"a": ["x", "y", "z"], "b": []})";
  EXPECT_EQ(edited(text,
                   [](Editor& editor, const Document& document) {
                     const NodeId array = document.find(0, "a");
                     editor.remove(array, document.resolve("/a/1"));
                     editor.replace_scalar(document.resolve("/a/2"), "3");
                     editor.append_element(array, "[4]");
                     editor.append_element(document.find(0, "b"), "5");
                   }),
            R"({"a": ["x", 3, [4]], "b": [5]})");
}

TEST(Edit, AValueThatIsEnclosedStays) {
  const std::string text = "{ \"a\": [1, 2], \"b\": 3 }";
  const auto enclose = [](Editor& editor, const Document& document) {
    editor.enclose(0, document.find(0, "a"), "c");
    editor.replace_text({8, 9}, "0");
  };
  EXPECT_EQ(edited(text, enclose), "{ \"a\": { \"c\": [0, 2] }, \"b\": 3 }");
}

TEST(Edit, OfTwoChangesAtOnePlaceTheLargerCounts) {
  EXPECT_EQ(edited("[1, 2]",
                   [](Editor& editor, const Document&) {
                     editor.replace_text({1, 2}, "0");
                     editor.replace_text({1, 5}, "3");
                   }),
            "[3]");
}

TEST(Edit, AllMembersGoneAndANewOne) {
  EXPECT_EQ(edited("{\n  \"a\": 1,\n  \"b\": 2\n}",
                   [](Editor& editor, const Document&) {
                     editor.remove(0, 1);
                     editor.remove(0, 3);
                     editor.append_member(0, "c", "3");
                   }),
            "{\n  \"c\": 3\n}");
}

TEST(Edit, ChangesInsideSomethingRemovedAreLeftOut) {
  EXPECT_EQ(edited(R"({"a": {"b": 1}, "c": 2})",
                   [](Editor& editor, const Document&) {
                     editor.rename(3, "x");
                     editor.remove(0, 1);
                   }),
            R"({"c": 2})");
}

std::string numbered(std::string name, std::uint32_t number) {
  return name.append(std::to_string(number));
}

// Random trees of strings, numbers, lists and objects, as programs write them.
class Gardener {
 public:
  explicit Gardener(std::uint32_t seed) : random_(seed) {}

  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(random_() % count); }

  Oracle tree(int depth) {
    switch (depth == 0 ? below(2) : below(5)) {
      case 0:
        return below(1000);
      case 1:
        return std::string("s\\\"").append(std::to_string(below(10)));
      case 2:
        return list(depth);
      default:
        return object(depth);
    }
  }

  Oracle object(int depth) {
    Oracle all = Oracle::object();
    for (std::uint32_t i = below(5); i > 0; --i) all[numbered("k", i)] = tree(depth - 1);
    return all;
  }

 private:
  Oracle list(int depth) {
    Oracle all = Oracle::array();
    const bool numbers = below(2) == 0;
    for (std::uint32_t i = below(4); i > 0; --i)
      all.push_back(numbers ? Oracle(below(9)) : tree(depth - 1));
    return all;
  }
  std::mt19937 random_;
};

// Renames, removes and adds at random, in the text and in the oracle's tree alike.
class Pair {
 public:
  Pair(const Document& document, Gardener& garden) : document_(document), garden_(garden) {}

  Oracle change(Editor& editor) {
    for (NodeId id = 0; id < document_.node_count(); ++id) {
      if (document_.is_object(id)) object(editor, id);
    }
    return wanted(0);
  }

 private:
  void object(Editor& editor, NodeId id) {
    for (const auto& member : document_.members(id)) {
      const std::uint32_t what = garden_.below(6);
      if (what == 0) {
        editor.remove(id, member.key);
        removed_.insert(member.key);
      } else if (what == 1) {
        renamed_[member.key] = numbered("r", member.key);
        editor.rename(member.key, renamed_[member.key]);
      } else if (what == 2) {
        replaced_[member.value] = garden_.tree(2);
        editor.replace(id, member.value, replaced_[member.value].dump());
      }
    }
    for (std::uint32_t i = garden_.below(3); i > 0; --i) {
      const Oracle value = garden_.tree(2);
      const std::string name = numbered("n", i);
      editor.append_member(id, name, value.dump());
      added_[id].emplace_back(name, value);
    }
  }

  Oracle wanted(NodeId id) {
    if (replaced_.count(id) > 0) return replaced_[id];
    if (document_.kind(id) == Kind::array) {
      Oracle all = Oracle::array();
      for (const NodeId element : document_.elements(id)) all.push_back(wanted(element));
      return all;
    }
    if (!document_.is_object(id)) return Oracle::parse(document_.raw(id));
    Oracle all = Oracle::object();
    for (const auto& member : document_.members(id)) {
      if (removed_.count(member.key) > 0) continue;
      const auto name = renamed_.find(member.key);
      all[name == renamed_.end() ? std::string(document_.key(member.key_id)) : name->second] =
          wanted(member.value);
    }
    for (const auto& [name, value] : added_[id]) all[name] = value;
    return all;
  }

  const Document& document_;
  Gardener& garden_;
  std::set<NodeId> removed_;
  std::map<NodeId, std::string> renamed_;
  std::map<NodeId, Oracle> replaced_;
  std::map<NodeId, std::vector<std::pair<std::string, Oracle>>> added_;
};

// The stretches between the edits, in their order, are in the new text in that order.
void expect_rest_untouched(std::string_view text, const std::vector<Edit>& edits,
                           std::string_view result) {
  std::size_t at = 0;
  std::size_t now = 0;
  for (const Edit& edit : edits) {
    ASSERT_LE(at, edit.span.begin);
    const std::string_view kept = text.substr(at, edit.span.begin - at);
    ASSERT_EQ(result.substr(now, kept.size()), kept);
    now += kept.size() + edit.text.size();
    at = edit.span.end;
  }
  ASSERT_EQ(result.substr(now), text.substr(at));
}

TEST(Edit, RandomChangesGiveWhatATreeWouldAndLeaveTheRest) {
  for (std::uint32_t seed = 0; seed < 2000; ++seed) {
    Gardener garden(seed);
    const int indent = static_cast<int>(garden.below(4)) - 1;
    const std::string text = garden.object(4).dump(indent);
    const Document document = read(text);
    Editor editor(document);
    const Oracle wanted = Pair(document, garden).change(editor);
    const std::vector<Edit> edits = editor.take();
    const std::string result = apply_edits(text, edits);
    ASSERT_EQ(Oracle::parse(result), wanted) << text << '\n' << result;
    expect_rest_untouched(text, edits, result);
    // The layout is kept: another pass through the oracle's own writer changes nothing.
    if (indent == -1 && text != "{}") {
      ASSERT_EQ(result, wanted.dump()) << text;
    }
  }
}

// Edits at random places of a text, none of which overlap.
std::vector<Edit> random_edits(const std::string& text, std::mt19937& random) {
  std::vector<Edit> edits;
  const auto below = [&](std::size_t most) {
    return static_cast<std::uint32_t>(random() % (most + 1));
  };
  for (std::uint32_t at = below(5); at <= text.size(); at += below(5) + 1) {
    const std::uint32_t end = std::min(at + below(4), static_cast<std::uint32_t>(text.size()));
    edits.push_back({{at, end}, std::string(below(3), static_cast<char>('A' + below(25)))});
    at = end;
  }
  return edits;
}

TEST(ChainEdits, OneAfterTheOtherIsTheSameAsBothTogether) {
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {
    const std::string text = std::string("abcdefghijklmnopqrstuvwxyz").substr(0, random() % 27);
    const std::vector<Edit> first = random_edits(text, random);
    const std::string between = apply_edits(text, first);
    const std::vector<Edit> second = random_edits(between, random);
    EXPECT_EQ(apply_edits(text, chain_edits(text, first, second)), apply_edits(between, second));
  }
}

TEST(MergeEdits, TwoListsBecomeOne) {
  const std::vector<Edit> a{{{0, 1}, "A"}, {{4, 4}, "+"}};
  const std::vector<Edit> b{{{2, 3}, "C"}, {{4, 4}, "-"}};
  EXPECT_EQ(apply_edits("abcd", merge_edits(a, b)), "AbCd+-");
}

TEST(Relocation, SaysWhereBytesStandAfterEdits) {
  const std::string text = "0123456789";
  const std::vector<Edit> edits{{{0, 0}, "<"}, {{2, 4}, ""}, {{5, 6}, "five"}, {{8, 8}, ">>"}};
  const std::string now = apply_edits(text, edits);
  const Relocation relocation(edits);
  for (const std::uint32_t kept : {0U, 1U, 4U, 6U, 7U, 8U, 9U}) {
    const Span place = relocation.of(kept);
    EXPECT_EQ(place.in(now), text.substr(kept, 1)) << kept;
  }
  EXPECT_TRUE(relocation.of(2).empty());
  EXPECT_TRUE(relocation.of(3).empty());
  EXPECT_EQ(relocation.of(5).in(now), "five");
  EXPECT_EQ(Relocation({}).of(7), (Span{7, 8}));
}

}  // namespace
}  // namespace gltfx::json
