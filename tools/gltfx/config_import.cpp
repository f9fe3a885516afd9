// SPDX-License-Identifier: Apache-2.0
// Four flat keys need no YAML library: a parser of anchors, tags and documents of any depth is a
// large attack surface.
#include "config_import.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "options.hpp"
#include "suggestion.hpp"

namespace gltfx::tool {
namespace {

constexpr std::array<std::string_view, 4> kKeys{"max-issues", "ignore", "only", "override"};

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

// A '#' begins a comment at the start of a line or after a blank.
std::string_view without_comment(std::string_view line) {
  for (std::size_t at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1)) {
    if (at == 0 || line[at - 1] == ' ' || line[at - 1] == '\t') return line.substr(0, at);
  }
  return line;
}

std::string_view unquoted(std::string_view word) {
  const bool quotes = word.size() >= 2 && (word.front() == '"' || word.front() == '\'') &&
                      word.back() == word.front();
  return quotes ? word.substr(1, word.size() - 2) : word;
}

class Reader {
 public:
  explicit Reader(const std::string& name) : name_(name) {}

  std::optional<Error> read(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      const std::string_view line = without_comment(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
      if (trimmed(line).empty() || line == "---") continue;
      if (auto problem = read_line(line)) return problem;
    }
    return std::nullopt;
  }

  ImportedConfig finish();

 private:
  Error wrong(std::string_view what) const {
    return {fmt::format("{}:{}: {}", printable(name_), line_, what)};
  }

  std::optional<Error> read_line(std::string_view line) {
    const bool indented = line.front() == ' ' || line.front() == '\t';
    const std::string_view body = trimmed(line);
    if (body.front() == '-' || indented) return read_item(body);
    const std::size_t colon = body.find(':');
    if (colon == std::string_view::npos)
      return wrong("a line of the form 'key: value' is expected");
    key_ = unquoted(trimmed(body.substr(0, colon)));
    if (std::find(kKeys.begin(), kKeys.end(), key_) == kKeys.end()) {
      return wrong(fmt::format("{} is not a key of the Khronos validator; its keys are {}.{}",
                               quoted(key_), fmt::join(kKeys, ", "), suggestion(key_, kKeys)));
    }
    const std::string_view value = trimmed(body.substr(colon + 1));
    if (value.empty()) return std::nullopt;
    return key_ == "max-issues" ? read_limit(value) : read_flow(value);
  }

  std::optional<Error> read_limit(std::string_view value) {
    const auto number = parse_number("max-issues", value, 0);
    if (!number) return wrong(number.error().message);
    max_issues_ = *number;
    return std::nullopt;
  }

  // "[A, B]", or "{A: 1, B: 2}".
  std::optional<Error> read_flow(std::string_view value) {
    const bool map = key_ == "override";
    if (value.size() < 2 || value.front() != (map ? '{' : '[') ||
        value.back() != (map ? '}' : ']')) {
      return wrong(fmt::format("{}: {} is expected", key_, map ? "a map" : "a list"));
    }
    value = value.substr(1, value.size() - 2);
    while (!trimmed(value).empty()) {
      const std::size_t comma = std::min(value.find(','), value.size());
      const std::string_view item = trimmed(value.substr(0, comma));
      value.remove_prefix(std::min(comma + 1, value.size()));
      if (auto problem = map ? read_level(item) : read_code(item)) return problem;
    }
    return std::nullopt;
  }

  // A line below a key.
  std::optional<Error> read_item(std::string_view body) {
    if (key_ == "override") return read_level(body);
    if (key_.empty() || key_ == "max-issues" || body.front() != '-') {
      return wrong("this is more of YAML than the configuration of the Khronos validator needs");
    }
    return read_code(trimmed(body.substr(1)));
  }

  std::optional<Error> read_code(std::string_view word) {
    const auto code = known(word);
    if (code) (key_ == "only" ? only_ : ignored_).push_back(*code);
    return std::nullopt;
  }

  std::optional<Error> read_level(std::string_view item) {
    const std::size_t colon = std::min(item.find(':'), item.size());
    const std::string_view digit = trimmed(item.substr(std::min(colon + 1, item.size())));
    if (digit.size() != 1 || digit[0] < '0' || digit[0] > '3') {
      return wrong("override: 'CODE: 0' is expected, up to 3");
    }
    const auto code = known(trimmed(item.substr(0, colon)));
    if (!code) return std::nullopt;
    std::erase_if(levels_, [&](const auto& level) { return level.first == *code; });
    levels_.emplace_back(*code, static_cast<Severity>(digit[0] - '0'));
    return std::nullopt;
  }

  std::optional<std::string> known(std::string_view word) {
    const RuleDescription* rule = rule_from_user(unquoted(word), nullptr);
    if (rule != nullptr) return std::string(rule->code);
    constexpr std::size_t kMostNotes = 100;
    if (notes_.size() == kMostNotes)
      notes_.emplace_back("and further codes that gltfx does not have");
    if (notes_.size() > kMostNotes) return std::nullopt;
    notes_.push_back(fmt::format("{}:{}: gltfx has no rule {}: left out", printable(name_), line_,
                                 quoted(unquoted(word))));
    return std::nullopt;
  }

  const std::string& name_;
  std::size_t line_ = 0;
  std::string key_;
  std::optional<std::uint64_t> max_issues_;
  std::vector<std::string> ignored_, only_, notes_;
  std::vector<std::pair<std::string, Severity>> levels_;
};

std::string list(std::string_view key, const std::vector<std::string>& codes) {
  if (codes.empty()) return {};
  return fmt::format("{} = [\n  \"{}\",\n]\n", key, fmt::join(codes, "\",\n  \""));
}

ImportedConfig Reader::finish() {
  ImportedConfig config;
  config.toml = fmt::format(
      "# Made of {} by 'gltfx config import'. To get what the Khronos validator\n"
      "# reports, and no more, add: profile = \"khronos\"\n",
      printable(name_));
  if (max_issues_) config.toml += fmt::format("max-issues = {}\n", *max_issues_);
  config.toml += list("select", only_) + list("ignore", ignored_);
  if (!levels_.empty()) config.toml += "\n[severity]\n";
  for (const auto& [code, level] : levels_) {
    config.toml += fmt::format("{} = \"{}\"\n", code, severity_name(level));
  }
  config.notes = std::move(notes_);
  return config;
}

}  // namespace

Result<ImportedConfig> khronos_config_as_toml(std::string_view text, const std::string& name) {
  Reader reader(name);
  if (auto problem = reader.read(text)) return *std::move(problem);
  return reader.finish();
}

}  // namespace gltfx::tool
