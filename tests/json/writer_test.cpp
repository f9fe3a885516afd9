// SPDX-License-Identifier: Apache-2.0
#include "json/writer.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "json/support.hpp"

namespace gltfx::json::testing {
namespace {

void write_all(Writer& w) {
  w.begin_object();
  w.member("s", "text");
  w.member("n", std::uint64_t{7});
  w.member("b", true);
  w.key("a");
  w.begin_array();
  w.number(1.5);
  w.integer(-3);
  w.unsigned_integer(UINT64_MAX);
  w.boolean(false);
  w.null();
  w.raw("{\"x\":1}");
  w.begin_object();
  w.end_object();
  w.begin_array();
  w.end_array();
  w.end_array();
  w.end_object();
}

TEST(Writer, PutsCommasAndColonsWhereTheyBelong) {
  std::string out;
  Writer w(out);
  write_all(w);
  EXPECT_EQ(
      out,
      R"({"s":"text","n":7,"b":true,"a":[1.5,-3,18446744073709551615,false,null,{"x":1},{},[]]})");
}

TEST(Writer, IndentsByTwoWhenPretty) {
  std::string out;
  Writer w(out, true);
  w.begin_object();
  w.key("a");
  w.begin_array();
  w.number(1);
  w.number(2);
  w.end_array();
  w.member("b", "c");
  w.key("e");
  w.begin_object();
  w.end_object();
  w.end_object();
  EXPECT_EQ(out, "{\n  \"a\": [\n    1,\n    2\n  ],\n  \"b\": \"c\",\n  \"e\": {}\n}");
}

TEST(Writer, WritesTheSameValuesPrettyOrNot) {
  std::string plain;
  std::string pretty;
  Writer a(plain);
  Writer b(pretty, true);
  write_all(a);
  write_all(b);
  EXPECT_EQ(nlohmann::json::parse(plain), nlohmann::json::parse(pretty));
}

TEST(Writer, NumbersThatJsonDoesNotHaveBecomeNull) {
  std::string out;
  Writer w(out);
  w.begin_array();
  w.number(std::numeric_limits<double>::infinity());
  w.number(std::numeric_limits<double>::quiet_NaN());
  w.number(1e300);
  w.end_array();
  EXPECT_EQ(out, "[null,null,1e+300]");
}

std::string written(std::string_view text) {
  std::string out;
  append_string(out, text);
  return out;
}

TEST(Writer, EscapesWhatAStringCannotHoldAndWhatIsUnsafeInATerminal) {
  EXPECT_EQ(written("plain \u00e4 \U0001F600"), "\"plain \u00e4 \U0001F600\"");
  EXPECT_EQ(written("\"\\/"), R"("\"\\/")");
  EXPECT_EQ(written("\b\f\n\r\t"), R"("\b\f\n\r\t")");
  EXPECT_EQ(written(std::string_view("\0\x1b\x7f", 3)), R"("\u0000\u001b\u007f")");
  EXPECT_EQ(written("\u0085\u009b\u00a0"), "\"\\u0085\\u009b\u00a0\"");
  EXPECT_EQ(written("\u2028\u2029"), R"("\u2028\u2029")");
}

// Plain characters are passed eight at a time.
TEST(Writer, LooksAtEachCharacterWhereverItStands) {
  const std::string plain = "abcdefghijklmnopqrs";
  for (int byte = 0; byte < 256; ++byte) {
    const std::string one(1, static_cast<char>(byte));
    std::string alone;
    append_string(alone, one);
    const std::string written = alone.substr(1, alone.size() - 2);
    for (std::size_t at = 0; at < plain.size(); ++at) {
      const std::string before = plain.substr(0, at);
      const std::string behind = plain.substr(at + 1);
      std::string out;
      append_string(out, before + one + behind);
      append_string(out, '"' + before + one + behind);
      EXPECT_EQ(out, '"' + before + written + behind + "\"\"\\\"" + before + written + behind + '"')
          << byte;
    }
  }
}

TEST(Writer, InvalidUtf8BecomesTheReplacementCharacter) {
  EXPECT_EQ(written("a\xFFz"), "\"a\uFFFDz\"");
  EXPECT_EQ(written("\xE2\x82"), "\"\uFFFD\uFFFD\"");
  EXPECT_EQ(written("\xED\xA0\x80"), "\"\uFFFD\uFFFD\uFFFD\"");
}

TEST(Writer, EveryByteStringIsReadBackAsValidJson) {
  for (int first = 0; first < 256; ++first) {
    for (int second = 0; second < 256; ++second) {
      const std::string bytes{static_cast<char>(first), static_cast<char>(second), 'x'};
      const std::string json = written(bytes);
      const auto value = nlohmann::json::parse(json, nullptr, false);
      ASSERT_TRUE(value.is_string()) << first << " " << second;
      if (first < 128 && second < 128) {
        ASSERT_EQ(value.get<std::string>(), bytes);
      }
      ASSERT_EQ(parse_clean(json).string(0), value.get<std::string>());
    }
  }
}

}  // namespace
}  // namespace gltfx::json::testing
