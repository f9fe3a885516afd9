// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "json/support.hpp"

namespace gltfx::json::testing {
namespace {

using ::testing::ElementsAre;

TEST(ParseValues, EveryKindOfRootIsRead) {
  EXPECT_EQ(parse_clean("null").kind(0), Kind::null);
  EXPECT_EQ(parse_clean("true").kind(0), Kind::true_value);
  EXPECT_EQ(parse_clean("false").kind(0), Kind::false_value);
  EXPECT_EQ(parse_clean("-12.5e+1").number(0).value, -125);
  EXPECT_EQ(parse_clean("\"text\"").string(0), "text");
  EXPECT_EQ(parse_clean("[]").kind(0), Kind::array);
  EXPECT_EQ(parse_clean("[1]").kind(0), Kind::number_array);
  EXPECT_EQ(parse_clean("{}").kind(0), Kind::object);
}

TEST(ParseValues, WhitespaceOfAllFourKindsIsAllowedEverywhere) {
  const Document document = parse_clean(
      " \t\r\n{ \t\r\n\"a\" \t\r\n: \t\r\n[ \t\r\n1 \t\r\n, \t\r\n2 \t\r\n] \t\r\n} \t\r\n");
  EXPECT_THAT(numbers_of(document, document.find(0, "a")), ElementsAre(1, 2));
}

TEST(ParseValues, RunsOfBlanksOfEveryLengthArePassed) {
  for (std::size_t blanks = 0; blanks < 40; ++blanks) {
    const std::string space(blanks, ' ');
    const Document document =
        parse_clean("[" + space + "true" + space + "," + space + "1]" + space);
    EXPECT_EQ(document.node_count(), 3u);
    EXPECT_EQ(document.number(2).value, 1);
  }
}

TEST(ParseValues, NodesFollowTheOrderOfTheText) {
  const Document document = parse_clean(R"({"a": ["x", {"b": 1}], "c": null})");
  ASSERT_EQ(document.node_count(), 9u);
  const std::vector<Kind> kinds{Kind::object, Kind::key,    Kind::array, Kind::string, Kind::object,
                                Kind::key,    Kind::number, Kind::key,   Kind::null};
  for (NodeId id = 0; id < kinds.size(); ++id) EXPECT_EQ(document.kind(id), kinds[id]) << id;
  EXPECT_EQ(document.next(0), 9u);
  EXPECT_EQ(document.next(2), 7u);
  EXPECT_EQ(document.next(4), 7u);
  EXPECT_EQ(document.raw(2), R"(["x", {"b": 1}])");
}

TEST(ParseValues, AnArrayOfNumbersIsOneNode) {
  const Document document = parse_clean(R"({"m": [1, -2.5, 3e2], "n": [[1, 2], [3]]})");
  const NodeId matrix = document.find(0, "m");
  EXPECT_EQ(document.kind(matrix), Kind::number_array);
  EXPECT_EQ(document.next(matrix), matrix + 1);
  EXPECT_EQ(document.raw(matrix), "[1, -2.5, 3e2]");
  EXPECT_EQ(document.array_size(matrix), 3u);
  EXPECT_THAT(numbers_of(document, matrix), ElementsAre(1, -2.5, 300));
  const NodeId nested = document.find(0, "n");
  EXPECT_EQ(document.kind(nested), Kind::array);
  std::vector<NodeId> rows;
  for (const NodeId row : document.elements(nested)) rows.push_back(row);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_THAT(numbers_of(document, rows[0]), ElementsAre(1, 2));
  EXPECT_THAT(numbers_of(document, rows[1]), ElementsAre(3));
}

TEST(ParseValues, AnArrayThatTurnsOutMixedHasANodeForEveryNumber) {
  for (const std::string_view text : {R"([1, 22, "x"])", R"([1, 22, null])", R"([1, 22, [3]])",
                                      R"([1, 22, {}])", R"([1 , 22 , true ])"}) {
    const Document document = parse_clean(text);
    EXPECT_EQ(document.kind(0), Kind::array);
    EXPECT_EQ(document.array_size(0), 3u);
    EXPECT_EQ(document.number(1).value, 1);
    EXPECT_EQ(document.raw(2), "22");
  }
}

TEST(ParseValues, TheCursorTellsWhereEachNumberStands) {
  const Document document = parse_clean("[10,  -2.50 ,3]");
  std::vector<std::string> spans;
  for (NumberCursor at(document, 0); at.valid(); at.advance()) {
    spans.emplace_back(at.number().span.in(document.text()));
  }
  EXPECT_THAT(spans, ElementsAre("10", "-2.50", "3"));
}

TEST(ParseValues, StringsOfEveryLengthEndAtTheirQuote) {
  for (std::size_t length = 0; length < 40; ++length) {
    const std::string content(length, 'x');
    const Document document = parse_clean("[\"" + content + "\",\"" + content + "\\n\"]");
    EXPECT_EQ(document.string(1), content);
    EXPECT_EQ(document.string(2), content + "\n");
  }
}

TEST(ParseValues, EscapesAreRead) {
  const Document document =
      parse_clean(R"(["\"\\\/\b\f\n\r\t", "\u0041\u00e9\u20AC\uD83D\uDE00", "\u0000", "plain"])");
  EXPECT_EQ(document.string(1), "\"\\/\b\f\n\r\t");
  EXPECT_EQ(document.string(2), "A\u00e9\u20ac\U0001F600");
  EXPECT_EQ(document.string(3), std::string_view("\0", 1));
  EXPECT_TRUE(document.node(1).escaped);
  EXPECT_FALSE(document.node(4).escaped);
}

TEST(ParseValues, AStringWithoutEscapesIsNotCopied) {
  const Document document = parse_clean(R"(["plain", "esc\u0061ped"])");
  std::string buffer;
  EXPECT_EQ(document.string(1, buffer).data(), document.text().data() + 2);
  EXPECT_EQ(document.string(2, buffer), "escaped");
  EXPECT_EQ(buffer, "escaped");
}

TEST(ParseValues, CharactersThatOnlyJavaScriptMindsAreAllowed) {
  EXPECT_EQ(parse_clean("\"\u2028\u2029\x7f\"").string(0), "\u2028\u2029\x7f");
}

TEST(ParseValues, TheDocumentKeepsTheTextItWasGiven) {
  const auto text = share_text("[1, {\"a\": 2}]");
  const Parsed parsed = parse(text);
  EXPECT_EQ(parsed.document.text().data(), text->data());
  EXPECT_EQ(parsed.document.raw(0), *text);
}

TEST(ParseValues, ACopyOfADocumentOutlivesTheOriginal) {
  Document copy;
  EXPECT_TRUE(copy.empty());
  EXPECT_EQ(copy.text(), "");
  {
    const Document original = parse_clean(R"({"k\u0065y": "v"})");
    copy = original;
  }
  EXPECT_EQ(copy.string(copy.find(0, "key")), "v");
  EXPECT_EQ(copy.key(0), "key");
}

// Rebuilds a text from its nodes: scalars and keys from their spans, punctuation from structure.
void rebuild(const Document& document, NodeId id, std::string& out) {
  const std::string_view raw = document.raw(id);
  out += document.is_object(id) || document.is_array(id) ? raw.substr(0, 1) : raw;
  std::string_view comma;
  for (const Members::Member& member : document.members(id)) {
    out.append(comma).append(document.raw(member.key)).append(":");
    rebuild(document, member.value, out);
    comma = ",";
  }
  for (const NodeId element : document.elements(id)) {
    out += comma;
    rebuild(document, element, out);
    comma = ",";
  }
  if (document.kind(id) == Kind::number_array) {
    for (NumberCursor at(document, id); at.valid(); at.advance()) {
      out.append(comma).append(at.number().span.in(document.text()));
      comma = ",";
    }
  }
  if (document.is_object(id) || document.is_array(id)) out += raw.back();
}

TEST(ParseValues, SpansPutTogetherGiveTheTextBack) {
  const Document document = parse_clean(kSample);
  std::string rebuilt;
  rebuild(document, 0, rebuilt);
  std::string expected;
  bool in_string = false;
  for (std::size_t i = 0; i < kSample.size(); ++i) {
    const char c = kSample[i];
    if (c == '"' && kSample[i - 1] != '\\') in_string = !in_string;
    if (in_string || (c != ' ' && c != '\n')) expected += c;
  }
  EXPECT_EQ(rebuilt, expected);
}

}  // namespace
}  // namespace gltfx::json::testing
