// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "json/parse.hpp"
#include "validate/phases.hpp"

namespace gltfx::validate {
namespace {

Code code_of(json::Fault fault) {
  switch (fault) {
    case json::Fault::invalid_utf8:
      return Code::JSON_INVALID_UTF8;
    case json::Fault::too_deep:
      return Code::JSON_TOO_DEEP;
    case json::Fault::trailing_data:
      return Code::JSON_TRAILING_DATA;
    case json::Fault::byte_order_mark:
      return Code::JSON_BYTE_ORDER_MARK;
    case json::Fault::trailing_comma:
      return Code::JSON_TRAILING_COMMA;
    case json::Fault::missing_comma:
      return Code::JSON_MISSING_COMMA;
    case json::Fault::duplicate_key:
      return Code::JSON_DUPLICATE_KEY;
    case json::Fault::lone_surrogate:
      return Code::JSON_LONE_SURROGATE;
    case json::Fault::number_out_of_range:
      return Code::JSON_NUMBER_OUT_OF_RANGE;
    case json::Fault::syntax:
    case json::Fault::unexpected_end:
    case json::Fault::control_character:
    case json::Fault::bad_escape:
    case json::Fault::bad_number:
    case json::Fault::bad_literal:
    case json::Fault::too_large:
      break;
  }
  return Code::INVALID_JSON;
}

std::string default_message(json::Fault fault) {
  switch (fault) {
    case json::Fault::byte_order_mark:
      return "The text starts with a byte order mark.";
    case json::Fault::trailing_comma:
      return "Trailing comma.";
    case json::Fault::missing_comma:
      return "Missing comma.";
    case json::Fault::duplicate_key:
      return "Duplicate key.";
    case json::Fault::lone_surrogate:
      return "Unpaired surrogate.";
    case json::Fault::number_out_of_range:
      return "The number is out of range of a double.";
    case json::Fault::trailing_data:
      return "There is text after the JSON value.";
    case json::Fault::too_deep:
      return "The JSON is nested too deeply.";
    case json::Fault::too_large:
      return "The JSON text is larger than 4 GiB.";
    case json::Fault::invalid_utf8:
      return "The text is not valid UTF-8.";
    default:
      return "The text is not valid JSON.";
  }
}

// "found 'x'; JSON has none" as the sentence of a message.
std::string sentence(std::string text) {
  if (text.empty()) return text;
  const bool is_name = text.compare(0, 4, "glTF") == 0;
  if (!is_name && text.front() >= 'a' && text.front() <= 'z') {
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  }
  if (text.back() != '.' && text.back() != '?') text += '.';
  return text;
}

// Where the comma belongs: behind the item before, which mostly ends on another line.
std::string comma_help(const json::ParseFault& fault, std::string_view text,
                       const json::LineIndex& lines) {
  const std::size_t before = text.find_last_not_of(" \t\r\n", fault.span.begin - 1);
  const auto at = static_cast<std::uint32_t>(before);
  const Location end = lines.locate({at, at + 1});
  if (end.line == lines.locate(fault.span).line) return "add a ',' between the two items";
  return fmt::format("add a ',' after line {}, column {}", end.line, end.column);
}

std::string opening_help(const json::ParseFault& fault, std::string_view text,
                         const json::LineIndex& lines) {
  if (fault.other.empty()) return {};
  const Location at = lines.locate(fault.other);
  return fmt::format("close the {} that opens at line {}, column {}",
                     gltfx::quoted(fault.other.in(text)), at.line, at.column);
}

std::string help_for(const json::ParseFault& fault, std::string_view text,
                     const json::LineIndex& lines) {
  switch (fault.fault) {
    case json::Fault::trailing_comma:
      return "remove the comma";
    case json::Fault::missing_comma:
      return comma_help(fault, text, lines);
    case json::Fault::duplicate_key: {
      const Location first = lines.locate(fault.other);
      return fmt::format("remove this one or the first one at line {}, column {}", first.line,
                         first.column);
    }
    case json::Fault::byte_order_mark:
      return "save the file as UTF-8 without a byte order mark";
    case json::Fault::bad_escape:
      return "use '/' instead of a backslash in the path of a URI";
    case json::Fault::syntax:
    case json::Fault::unexpected_end:
      return opening_help(fault, text, lines);
    default:
      return {};
  }
}

void report_fault(const json::ParseFault& fault, std::string_view text,
                  const json::LineIndex& lines, bool syntax, Collector& collector) {
  Finding finding(syntax ? Code::INVALID_JSON : code_of(fault.fault));
  finding.message = sentence(fault.detail.empty() ? default_message(fault.fault) : fault.detail);
  finding.help = help_for(fault, text, lines);
  finding.span = fault.span;
  collector.report_file(Phase::json, std::move(finding));
}

// A text with thousands of equal faults is told once that there are more.
void report_unlisted(std::uint64_t count, Collector& collector) {
  if (count == 0) return;
  Finding finding(Code::INVALID_JSON);
  finding.message = fmt::format("The text has {} more syntax errors.", count);
  collector.report_file(Phase::json, std::move(finding));
}

// Syntax, or a byte order mark, which does not end the report.
bool is_syntax(json::Fault fault) {
  return fault != json::Fault::duplicate_key && fault != json::Fault::lone_surrogate &&
         fault != json::Fault::number_out_of_range;
}

bool report_syntax(const json::Parsed& parsed, std::string_view text, const json::LineIndex& lines,
                   Collector& collector) {
  for (const json::ParseFault& fault : parsed.faults) {
    if (!is_syntax(fault.fault)) continue;
    report_fault(fault, text, lines, true, collector);
    if (fault.fault != json::Fault::byte_order_mark) return false;
  }
  return true;
}

}  // namespace

bool check_text(const SharedText& text, const json::Parsed& parsed, const ValidateOptions& options,
                Collector& collector) {
  collector.keep_text(text);
  bool readable = true;
  if (!parsed.faults.empty()) {
    const json::LineIndex lines(*text);
    if (deviations_of(options.profile).syntax_faults_end_the_report) {
      readable = report_syntax(parsed, *text, lines, collector);
    } else {
      for (const json::ParseFault& fault : parsed.faults) {
        report_fault(fault, *text, lines, false, collector);
      }
      report_unlisted(parsed.unrecorded_faults, collector);
    }
  }
  return readable && !parsed.document.empty();
}

}  // namespace gltfx::validate
