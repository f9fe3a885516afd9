// SPDX-License-Identifier: Apache-2.0
// What the json room says of a text, in the words of a rule.
#include "validate/rules/families.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kMinimal = R"({"asset": {"version": "2.0"}})";

constexpr RuleDescription kRules[] = {
    {"INVALID_JSON", Severity::error, "The text is not valid JSON",
     "Every reader stops at the first character that JSON does not allow, so nothing of the "
     "asset is loaded.",
     "Mend the text at the marked place; hand-written files most often miss a quote, a bracket"
     " or a comma.",
     R"({"asset": {version: "2.0"}})", kMinimal, Fix::none, true},
    {"JSON_BYTE_ORDER_MARK", Severity::error, "The text begins with a byte order mark",
     "glTF asks for UTF-8 without one, and many JSON parsers stop at it.",
     "Save the file as UTF-8 without a byte order mark.",
     "base64:77u/eyJhc3NldCI6IHsidmVyc2lvbiI6ICIyLjAifX0=", kMinimal, Fix::none, false},
    {"JSON_DUPLICATE_KEY", Severity::error, "A name stands twice in one object",
     "Names in an object must be unique. Most readers keep the last value, some the first: two"
     " programs load two different assets from one file.",
     "Remove the one that is not meant.",
     R"({"asset": {"version": "2.0", "generator": "a", "generator": "b"}})",
     R"({"asset": {"version": "2.0", "generator": "b"}})", Fix::none, false},
    {"JSON_INVALID_UTF8", Severity::error, "The text is not valid UTF-8",
     "Readers disagree about such bytes: some stop, some show other letters.",
     "Save the file as UTF-8.",
     "base64:eyJhc3NldCI6IHsidmVyc2lvbiI6ICIyLjAiLCAiZ2VuZXJhdG9yIjogImNhZukifX0=",
     R"({"asset": {"version": "2.0", "generator": "cafe"}})", Fix::none, false},
    {"JSON_LONE_SURROGATE", Severity::warning, "Half of a surrogate pair stands alone",
     "A character beyond U+FFFF is written as two \\u escapes. One of them alone is no "
     "character; readers replace it or stop.",
     "Write both halves, or the character itself.",
     R"({"asset": {"version": "2.0", "generator": "\ud83c"}})",
     R"({"asset": {"version": "2.0", "generator": "\ud83c\udf33"}})", Fix::none, false},
    {"JSON_MISSING_COMMA", Severity::error, "A comma is missing between two items",
     "JSON readers stop here, so nothing of the asset is loaded.", "Write a comma between the two.",
     R"({"asset": {"version": "2.0" "generator": "a"}})",
     R"({"asset": {"version": "2.0", "generator": "a"}})", Fix::none, false},
    {"JSON_NUMBER_OUT_OF_RANGE", Severity::error, "A number is beyond what a double can hold",
     "Readers turn it into infinity or refuse it; no property of glTF means that.",
     "Write a number of at most 1.8e308.",
     R"({"asset": {"version": "2.0", "extras": {"size": 1e999}}})",
     R"({"asset": {"version": "2.0", "extras": {"size": 1e99}}})", Fix::none, false},
    {"JSON_TOO_DEEP", Severity::error, "Arrays or objects are nested too deeply",
     "No asset needs more than a thousand levels; files made to break a reader have them.",
     "Flatten the structure.", R"({"asset": {"version": "2.0"}, "extras": {{[*1100}}{{]*1100}}})",
     kMinimal, Fix::none, false},
    {"JSON_TRAILING_COMMA", Severity::error, "A comma stands behind the last item",
     "JavaScript allows it, JSON does not: strict readers stop here.", "Remove the comma.",
     R"({"asset": {"version": "2.0",}})", kMinimal, Fix::none, false},
    {"JSON_TRAILING_DATA", Severity::error, "More text follows behind the JSON value",
     "A file holds one JSON value. What follows is often the rest of an older, longer version "
     "of the file.",
     "Remove what stands behind the closing bracket.", R"({"asset": {"version": "2.0"}}})",
     kMinimal, Fix::none, false},
};

}  // namespace

const Family& json_family() {
  static const Family family{"json", kRules, {}, {}};
  return family;
}

}  // namespace gltfx::validate
