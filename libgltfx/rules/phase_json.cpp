// SPDX-License-Identifier: Apache-2.0
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "json/equal.hpp"
#include "json/legacy_encoding.hpp"
#include "json/parse.hpp"
#include "rules/context.hpp"
#include "rules/fix.hpp"
#include "rules/phases.hpp"

namespace gltfx::validate {
namespace {

Code code_of(json::SyntaxError error) {
  switch (error) {
    case json::SyntaxError::invalid_utf8:
      return Code::JSON_INVALID_UTF8;
    case json::SyntaxError::too_deep:
      return Code::JSON_TOO_DEEP;
    case json::SyntaxError::trailing_data:
      return Code::JSON_TRAILING_DATA;
    case json::SyntaxError::byte_order_mark:
      return Code::JSON_BYTE_ORDER_MARK;
    case json::SyntaxError::trailing_comma:
      return Code::JSON_TRAILING_COMMA;
    case json::SyntaxError::missing_comma:
      return Code::JSON_MISSING_COMMA;
    case json::SyntaxError::duplicate_key:
      return Code::JSON_DUPLICATE_KEY;
    case json::SyntaxError::lone_surrogate:
      return Code::JSON_LONE_SURROGATE;
    case json::SyntaxError::number_out_of_range:
      return Code::JSON_NUMBER_OUT_OF_RANGE;
    case json::SyntaxError::syntax:
    case json::SyntaxError::unexpected_end:
    case json::SyntaxError::control_character:
    case json::SyntaxError::bad_escape:
    case json::SyntaxError::bad_number:
    case json::SyntaxError::bad_literal:
    case json::SyntaxError::too_large:
      break;
  }
  return Code::INVALID_JSON;
}

std::string default_message(json::SyntaxError error) {
  switch (error) {
    case json::SyntaxError::byte_order_mark:
      return "The text starts with a byte order mark.";
    case json::SyntaxError::trailing_comma:
      return "Trailing comma.";
    case json::SyntaxError::missing_comma:
      return "Missing comma.";
    case json::SyntaxError::duplicate_key:
      return "Duplicate key.";
    case json::SyntaxError::lone_surrogate:
      return "Unpaired surrogate.";
    case json::SyntaxError::number_out_of_range:
      return "The number is out of range of a double.";
    case json::SyntaxError::trailing_data:
      return "There is text after the JSON value.";
    case json::SyntaxError::too_deep:
      return "The JSON is nested too deeply.";
    case json::SyntaxError::too_large:
      return "The JSON text is larger than 4 GiB.";
    case json::SyntaxError::invalid_utf8:
      return "The text is not valid UTF-8.";
    default:
      return "The text is not valid JSON.";
  }
}

// "found 'x'; JSON has none" as a sentence of a message.
std::string sentence(std::string text) {
  if (text.empty()) return text;
  if (!text.starts_with("glTF")) text = capitalized(std::move(text));
  if (text.back() != '.' && text.back() != '?') text += '.';
  return text;
}

// The place of the comma: after the previous item, which usually ends on another line.
std::string comma_help(const json::ParseError& error, std::string_view text,
                       const json::LineIndex& lines) {
  const std::size_t before = text.find_last_not_of(" \t\r\n", error.span.begin - 1);
  const auto at = static_cast<std::uint32_t>(before);
  const Location end = lines.locate({at, at + 1});
  if (end.line == lines.locate(error.span).line) return "add a ',' between the two items";
  return fmt::format("add a ',' after line {}, column {}", end.line, end.column);
}

std::string opening_help(const json::ParseError& error, std::string_view text,
                         const json::LineIndex& lines) {
  if (error.other.empty()) return {};
  const Location at = lines.locate(error.other);
  return fmt::format("close the {} that opens at line {}, column {}",
                     gltfx::quoted(error.other.in(text)), at.line, at.column);
}

std::string help_for(const json::ParseError& error, std::string_view text,
                     const json::LineIndex& lines) {
  switch (error.error) {
    case json::SyntaxError::trailing_comma:
      return "remove the comma";
    case json::SyntaxError::missing_comma:
      return comma_help(error, text, lines);
    case json::SyntaxError::duplicate_key: {
      const Location before = lines.locate(error.other);
      return fmt::format("remove this one or the one at line {}, column {}", before.line,
                         before.column);
    }
    case json::SyntaxError::byte_order_mark:
      return "save the file as UTF-8 without a byte order mark";
    case json::SyntaxError::bad_escape:
      return "use '/' instead of a backslash in the path of a URI";
    case json::SyntaxError::syntax:
    case json::SyntaxError::unexpected_end:
      return opening_help(error, text, lines);
    default:
      return {};
  }
}

// Bytes in strings that are valid in another encoding: the string, and its text in that encoding.
std::optional<Finding> explain_encoding(std::string_view text) {
  const auto legacy = json::read_legacy_text(text);
  if (!legacy || legacy->parts.empty()) return std::nullopt;
  const Span first = legacy->parts.front().span;
  const json::Parsed read = json::parse(share_text(json::apply_edits(text, legacy->parts)));
  if (read.document.empty()) return std::nullopt;
  // Text before the first span has not moved.
  const json::Document& document = read.document;
  const json::NodeId node = node_around(document, {first.begin, first.begin + 1});
  if (node == json::kNoNode) return std::nullopt;
  const bool key = document.kind(node) == json::Kind::key;
  if (!key && !document.is_string(node)) return std::nullopt;
  Finding finding(Code::JSON_INVALID_UTF8);
  finding.message = fmt::format(
      "{} is not UTF-8; read as {}, it is {}.",
      key ? "A name of a member" : gltfx::quoted(document.pointer_of(node)), legacy->encoding,
      gltfx::quoted(key ? std::string(document.key(document.node(node).next))
                        : document.string(node)));
  finding.help = fmt::format("convert the text from {} to UTF-8", legacy->encoding);
  finding.span = first;
  return finding;
}

void report_error(const json::ParseError& error, std::string_view text,
                  const json::LineIndex& lines, bool syntax, Collector& collector) {
  if (error.error == json::SyntaxError::invalid_utf8 && !syntax) {
    if (auto explained = explain_encoding(text)) {
      return collector.report_file(Phase::json, *std::move(explained));
    }
  }
  Finding finding(syntax ? Code::INVALID_JSON : code_of(error.error));
  finding.message = sentence(error.detail.empty() ? default_message(error.error) : error.detail);
  finding.help = help_for(error, text, lines);
  finding.span = error.span;
  collector.report_file(Phase::json, std::move(finding));
}

// For a text with thousands of equal errors, reports once that there are more.
void report_unlisted(std::uint64_t count, Collector& collector) {
  if (count == 0) return;
  Finding finding(Code::INVALID_JSON);
  finding.message = fmt::format("The text has {} more syntax errors.", count);
  collector.report_file(Phase::json, std::move(finding));
}

// Syntax errors, except a byte order mark, which does not end the report.
bool is_syntax(json::SyntaxError error) {
  return error != json::SyntaxError::duplicate_key && error != json::SyntaxError::lone_surrogate &&
         error != json::SyntaxError::number_out_of_range;
}

bool report_syntax(const json::Parsed& parsed, std::string_view text, const json::LineIndex& lines,
                   Collector& collector) {
  for (const json::ParseError& error : parsed.errors) {
    if (!is_syntax(error.error)) continue;
    report_error(error, text, lines, true, collector);
    if (error.error != json::SyntaxError::byte_order_mark) return false;
  }
  return true;
}

// --- Fixes. The first finding of a kind fixes all errors of that kind. ---

/// All errors; reports contain only the first ones.
struct TextErrors {
  explicit TextErrors(Fixing& fixing) {
    constexpr std::uint32_t kMost = 1U << 20U;
    json::Limits limits;
    limits.recorded_errors = kMost;
    errors = json::parse(fixing.opened().container().json, limits).errors;
    for (const json::ParseError& error : errors) {
      if (error.error == json::SyntaxError::duplicate_key) {
        repeated.emplace(error.span.begin, error.other);
      }
    }
  }
  std::vector<json::ParseError> errors;
  std::set<json::SyntaxError> done;
  std::unordered_map<std::uint32_t, Span> repeated;  ///< keys, by position of the next one
};

template <class Fix>
bool fix_each(Fixing& fixing, json::SyntaxError kind, const Fix& fix) {
  TextErrors& all = fixing.table<TextErrors>();
  if (!all.done.insert(kind).second) return true;
  bool any = false;
  for (const json::ParseError& error : all.errors) {
    if (error.error == kind) any = fix(error) || any;
  }
  return any;
}

template <json::SyntaxError kind>
bool cut_out(Fixing& fixing, const Subject&) {
  return fix_each(fixing, kind, [&](const json::ParseError& error) {
    fixing.replace_text(error.span, "");
    return true;
  });
}

bool add_comma(Fixing& fixing, const Subject&) {
  const std::string_view text = *fixing.opened().container().json;
  return fix_each(fixing, json::SyntaxError::missing_comma, [&](const json::ParseError& error) {
    const std::size_t before = text.find_last_not_of(" \t\r\n", error.span.begin - 1);
    const auto at = static_cast<std::uint32_t>(before) + 1;
    fixing.replace_text({at, at}, ",");
    return true;
  });
}

bool has_repeats(const json::Document& document, json::NodeId value) {
  for (json::NodeId at = value; at < document.next(value); ++at) {
    if (document.node(at).hidden) return true;
  }
  return false;
}

// With two equal values, all readers use the same one. Most use the last, which is kept.
bool remove_equal_repeat(Fixing& fixing, const Subject& last) {
  const json::Document& document = fixing.document();
  const auto& repeated = fixing.table<TextErrors>().repeated;
  const auto found = repeated.find(last.begin);
  if (!last.is_name || found == repeated.end()) return false;
  const json::NodeId key = node_at(document, found->second);
  if (key == json::kNoNode) return false;
  const bool same_text = document.raw(key + 1) == document.raw(last.value);
  const bool equal =
      same_text || (json::equal(document, key + 1, last.value) && !has_repeats(document, key + 1) &&
                    !has_repeats(document, last.value));
  return equal && json::equal(document, key, last.value - 1) && fixing.remove_member(key + 1);
}

bool convert_to_utf8(Fixing& fixing, const Subject&) {
  const auto legacy = json::read_legacy_text(*fixing.opened().container().json);
  if (!legacy) return false;
  for (const json::Edit& part : legacy->parts) fixing.replace_text(part.span, part.text);
  return !legacy->parts.empty();
}

constexpr FixEntry kTextFixes[] = {
    {Code::JSON_INVALID_UTF8, convert_to_utf8, FixStage::syntax},
    {Code::JSON_BYTE_ORDER_MARK, cut_out<json::SyntaxError::byte_order_mark>, FixStage::syntax},
    {Code::JSON_TRAILING_COMMA, cut_out<json::SyntaxError::trailing_comma>, FixStage::syntax},
    {Code::JSON_MISSING_COMMA, add_comma, FixStage::syntax},
    {Code::JSON_DUPLICATE_KEY, remove_equal_repeat},
};

}  // namespace

const RuleGroup& text_rules() {
  static constexpr RuleGroup group{.fixes = kTextFixes};
  return group;
}

bool check_text(const SharedText& text, const json::Parsed& parsed, const ValidateOptions& options,
                Collector& collector) {
  collector.keep_text(text);
  bool readable = true;
  if (!parsed.errors.empty()) {
    const json::LineIndex lines(*text);
    if (deviations_of(options.profile).syntax_errors_end_the_report) {
      readable = report_syntax(parsed, *text, lines, collector);
    } else {
      for (const json::ParseError& error : parsed.errors) {
        report_error(error, *text, lines, false, collector);
      }
      report_unlisted(parsed.unrecorded_errors, collector);
    }
  }
  return readable && !parsed.document.empty();
}

}  // namespace gltfx::validate
