// SPDX-License-Identifier: Apache-2.0
#include "options.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/text.hpp"
#include "option_rows.hpp"
#include "output.hpp"
#include "suggestion.hpp"

namespace gltfx::tool {
namespace {

std::vector<std::string_view> split_commas(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    if (comma > at) parts.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  return parts;
}

std::string upper_case(std::string_view text) {
  std::string upper(text);
  for (char& c : upper) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return upper;
}

// The parts of each text; "," has none.
Result<std::vector<std::string_view>> code_parts(std::string_view option,
                                                 const std::vector<std::string>& texts) {
  std::vector<std::string_view> all;
  for (const std::string& text : texts) {
    const std::vector<std::string_view> parts = split_commas(text);
    if (parts.empty())
      return Error{fmt::format("{}: {} names no rule.", option, gltfx::quoted(text))};
    all.insert(all.end(), parts.begin(), parts.end());
  }
  return all;
}

Error unknown_code(std::string_view option, std::string_view code, const OwnRules* own) {
  return Error{fmt::format("{}: there is no rule {}.{}", option, gltfx::quoted(code),
                           suggest_code(code, own))};
}

Result<FormatTarget> parse_target(std::string_view option, std::string_view text) {
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  FormatTarget target;
  const auto format = report_format_from_name(name);
  if (!format) return unknown_word(option, name, report_format_names());
  target.format = *format;
  if (equals == std::string_view::npos) return target;
  target.path = text.substr(equals + 1);
  if (target.path.empty()) {
    return Error{fmt::format("{}: {} names no file after '='.", option, gltfx::quoted(text))};
  }
  if (target.path == "-") target.path.clear();
  return target;
}

}  // namespace

Error mistake_in(std::string_view option, const Error& why) {
  return {fmt::format("{}: {}{}", option, why.message, why.message.ends_with('?') ? "" : ".")};
}

Error unknown_word(std::string_view option, std::string_view text,
                   std::span<const std::string_view> names) {
  return Error{fmt::format("{}: {} is not one of {}.{}", option, gltfx::quoted(text),
                           fmt::join(names, ", "), suggestion(text, names))};
}

Result<std::uint64_t> parse_number(std::string_view option, std::string_view text,
                                   std::uint64_t minimum) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || value < minimum) {
    return Error{fmt::format("{}: {} is not a whole number of at least {}.", option,
                             gltfx::quoted(text), minimum)};
  }
  return value;
}

Result<std::uint32_t> parse_count(std::string_view option, std::string_view text,
                                  std::uint32_t minimum, std::uint32_t maximum) {
  const auto number = parse_number(option, text, minimum);
  if (number && *number <= maximum) return static_cast<std::uint32_t>(*number);
  return Error{fmt::format("{}: {} is not a whole number from {} to {}.", option,
                           gltfx::quoted(text), minimum, maximum)};
}

Result<double> parse_decimal(std::string_view option, std::string_view text, double least,
                             double greatest) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = read_double(text.data(), end, value);
  if (error != std::errc() || stop != end || !(value >= least) || !(value <= greatest)) {
    return Error{fmt::format("{}: {} is not a number from {} to {}.", option, gltfx::quoted(text),
                             least, greatest)};
  }
  return value;
}

Result<unsigned> parse_jobs(std::string_view option, std::string_view text) {
  const auto number = parse_number(option, text, 1);
  if (!number) return number.error();
  constexpr std::uint64_t kMost = std::numeric_limits<unsigned>::max();
  return static_cast<unsigned>(std::min(*number, kMost));
}

Result<Shard> parse_shard(std::string_view option, std::string_view text) {
  constexpr std::uint64_t kMost = 1'000'000;
  const std::size_t slash = std::min(text.find('/'), text.size());
  const auto index = parse_number("", text.substr(0, slash), 1);
  const auto count = parse_number("", text.substr(std::min(slash + 1, text.size())), 1);
  if (index && count && *index <= *count && *count <= kMost) {
    return Shard{static_cast<std::uint32_t>(*index), static_cast<std::uint32_t>(*count)};
  }
  return Error{
      fmt::format("{}: {} is not I/N with I from 1 to N, as 3/8.", option, gltfx::quoted(text))};
}

Result<std::vector<FormatTarget>> parse_targets(std::string_view option,
                                                const std::vector<std::string>& texts) {
  std::vector<FormatTarget> targets;
  for (const std::string& text : texts) {
    auto target = parse_target(option, text);
    if (!target) return target.error();
    for (const FormatTarget& other : targets) {
      if (!same_place(other.path, target->path)) continue;
      const std::string place =
          other.path.empty() ? std::string("standard output") : gltfx::quoted(other.path);
      return Error{fmt::format(
          "{}: {} and {} both write to {}; give one a file of its own, "
          "as in --format json=report.json.",
          option, report_format_name(other.format), report_format_name(target->format), place)};
    }
    targets.push_back(*std::move(target));
  }
  return targets;
}

Result<std::set<std::string, std::less<>>> parse_codes(std::string_view option,
                                                       const std::vector<std::string>& texts,
                                                       const OwnRules* own) {
  const auto parts = code_parts(option, texts);
  if (!parts) return parts.error();
  std::set<std::string, std::less<>> codes;
  for (const std::string_view code : *parts) {
    const std::vector<std::string_view> named = codes_from_user(code, own);
    if (named.empty()) return unknown_code(option, code, own);
    codes.insert(named.begin(), named.end());
  }
  return codes;
}

Result<std::map<std::string, Severity, std::less<>>> parse_severities(
    std::string_view option, const std::vector<std::string>& texts, const OwnRules* own) {
  const auto parts = code_parts(option, texts);
  if (!parts) return parts.error();
  std::map<std::string, Severity, std::less<>> severities;
  for (const std::string_view part : *parts) {
    const std::size_t equals = std::min(part.find('='), part.size());
    const std::vector<std::string_view> named = codes_from_user(part.substr(0, equals), own);
    if (named.empty()) return unknown_code(option, part.substr(0, equals), own);
    const auto level = severity_from_name(part.substr(std::min(equals + 1, part.size())));
    if (!level) {
      return Error{fmt::format("{}: {} should read {}=error, =warning, =info or =hint.", option,
                               gltfx::quoted(part),
                               named.size() == 1 ? named.front() : part.substr(0, equals))};
    }
    for (const std::string_view code : named) {
      severities.insert_or_assign(std::string(code), *level);
    }
  }
  return severities;
}

const RuleDescription* rule_from_user(std::string_view code, const OwnRules* own) {
  return find_rule(upper_case(code), own);
}

std::vector<std::string_view> codes_from_user(std::string_view name, const OwnRules* own) {
  std::vector<std::string_view> codes;
  if (const RuleDescription* rule = rule_from_user(name, own)) return {rule->code};
  const std::string group = lower_case(name);
  for (const RuleDescription& rule : rules(own)) {
    if (!group.empty() && rule.group == group) codes.push_back(rule.code);
  }
  return codes;
}

std::string suggest_code(std::string_view code, const OwnRules* own) {
  std::vector<std::string_view> codes;
  std::set<std::string_view> groups;
  for (const RuleDescription& rule : rules(own)) {
    codes.push_back(rule.code);
    if (!rule.group.empty()) groups.insert(rule.group);
  }
  const std::vector<std::string_view> names(groups.begin(), groups.end());
  const std::string group = suggestion(lower_case(code), names);
  return group.empty() ? suggestion(upper_case(code), codes) : group;
}

}  // namespace gltfx::tool
