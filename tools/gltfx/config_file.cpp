// SPDX-License-Identifier: Apache-2.0
#include "config_file.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "config_limits.hpp"
#include "option_parts.hpp"
#include "suggestion.hpp"
#include "toml.hpp"
#include "verb_options.hpp"

namespace gltfx::tool {
namespace {

struct ConfigObstacle {
  std::uint32_t line = 0;  ///< 0: there is none
  std::string_view problem;
};

constexpr int kDeepest = 16;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::size_t kEnd = std::string_view::npos;

// The position after the string that begins at `at`; kEnd if it is not terminated correctly.
std::size_t behind_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool long_one = text.substr(at, 3) == three;
  for (at += long_one ? 3 : 1; at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\') {
      ++at;
    } else if (long_one && text.substr(at, 3) == three) {
      // One or two more quotes belong to the content.
      at += 3;
      for (int more = 0; more < 2 && at < text.size() && text[at] == quote; ++more) ++at;
      return at;
    } else if (!long_one && text[at] == quote) {
      return at + 1;
    } else if (!long_one && text[at] == '\n') {
      return kEnd;
    }
  }
  return kEnd;
}

std::uint32_t line_at(std::string_view text, std::size_t at) {
  return 1 + static_cast<std::uint32_t>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

// Finds brackets nested in more than 16 others, a key of more than 17 parts, or a non-ASCII
// character outside of strings and comments. It stops at an error at which every parser stops.
ConfigObstacle find_obstacle(std::string_view text) {
  int depth = 0, dots = 0;
  for (std::size_t at = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
       at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = behind_string(text, at);
      if (at == kEnd) return {};
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (static_cast<unsigned char>(c) > 0x7F) {
      return {line_at(text, at), "only strings and comments may have characters beyond ASCII"};
    }
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && depth > 0) --depth;
    if (c == '.') {
      ++dots;
    } else if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') {
      dots = 0;
    }
    if (depth > kDeepest || dots > kDeepest) {
      return {line_at(text, at), "this is nested more deeply than any configuration"};
    }
    ++at;
  }
  return {};
}

constexpr std::string_view kOverrides = "overrides";
constexpr std::string_view kPaths = "paths";
constexpr std::string_view kExtends = "extends";
constexpr std::string_view kRules = "rules";
constexpr std::size_t kMostMistakes = 100;

std::string_view form_words(ConfigForm form) {
  switch (form) {
    case ConfigForm::number:
      return "a whole number";
    case ConfigForm::flag:
      return "true or false";
    case ConfigForm::codes:
    case ConfigForm::names:
    case ConfigForm::patterns:
    case ConfigForm::files:
    case ConfigForm::paths:
      return "a list of strings";
    case ConfigForm::levels:
      return "a table of CODE = \"level\"";
    default:
      return "a string";
  }
}

class Reader {
 public:
  Reader(const std::string& name, const ResolvePath& resolve, std::shared_ptr<OwnPages> pages)
      : name_(name),
        limits_([this](std::uint32_t line) { return fmt::format("{}:{}", name_, line); },
                [this](std::uint32_t line, const std::string& text) {
                  complain(line, text);
                  return !is_full();
                }),
        resolve_(resolve),
        pages_(std::move(pages)) {
    declare_checks(checks_, scratch_);
    checks_.own_pages = pages_;
  }

  void read(const toml::table& root) {
    if (!read_pages(root)) return;
    for (const auto& [key, node] : root) {
      if (key.str() == kOverrides) {
        read_overrides(node);
      } else if (key.str() == kExtends) {
        read_bases(node);
      } else {
        read_member(key, node, false, file_);
      }
    }
    by_line(file_.values);
  }
  void complain(std::uint32_t line, std::string_view text) {
    if (is_full()) return;
    mistakes_.emplace(line, fmt::format("{}:{}: {}", printable(name_), line, text));
  }
  Result<ConfigFile> finish() {
    if (mistakes_.empty()) return std::move(file_);
    std::string lines = "the configuration has mistakes";
    for (const auto& [line, text] : mistakes_) lines.append("\n").append(text);
    if (is_full()) lines += "\nthe rest of the file was not read";
    for (const bool by_path : unknown_keys_) {
      lines += fmt::format("\nthe keys{} are {}", by_path ? " of an override" : "",
                           fmt::join(names(by_path), ", "));
    }
    return Error{lines};
  }

 private:
  using Values = std::vector<ConfigValue>;

  // Each mistake is compared with all words, so their number is limited.
  bool is_full() const { return mistakes_.size() >= kMostMistakes; }

  static std::uint32_t line_of(const toml::key& key) { return key.source().begin.line; }
  static std::uint32_t line_of(const toml::node& node) { return node.source().begin.line; }
  static void by_line(Values& values) {
    std::stable_sort(values.begin(), values.end(),
                     [](const auto& a, const auto& b) { return a.line < b.line; });
  }

  // Before anything that names codes: the pages of the file and of its overrides. False if they
  // have mistakes.
  bool read_pages(const toml::table& root) {
    std::vector<std::string> paths;
    std::uint32_t line = 0;
    const auto add = [&](const toml::table& table) {
      const toml::array* list = table[kRules].as_array();
      if (list == nullptr) return;
      if (line == 0) line = line_of(*list);
      for (const toml::node& item : *list) {
        if (item.is_string()) paths.push_back(resolve_(**item.as_string()));
      }
    };
    add(root);
    if (const toml::array* overrides = root[kOverrides].as_array()) {
      for (const toml::node& item : *overrides) {
        if (item.is_table()) add(*item.as_table());
      }
    }
    const auto mistake = pages_->read(paths);
    if (mistake) complain(line, fmt::format("{}: {}", kRules, mistake->message));
    return !mistake;
  }

  void read_member(const toml::key& key, const toml::node& node, bool by_path, ConfigPart& part) {
    const std::string_view name = key.str();
    const ConfigKey* known = find_key(name);
    if (known != nullptr && known->form == ConfigForm::limits) {
      read_limits(node, part);
    } else if (known != nullptr && known->by_path >= by_path) {
      read_value(*known, node, part.values);
    } else if (known != nullptr) {
      complain(line_of(key),
               fmt::format("{} applies to all paths: it is not allowed in an override",
                           gltfx::quoted(name)));
    } else {
      unknown_keys_.insert(by_path);
      complain(line_of(key), fmt::format("there is no key {}.{}", gltfx::quoted(name),
                                         suggestion(name, names(by_path))));
    }
  }

  void read_limits(const toml::node& node, ConfigPart& part) { limits_.read(node, part.limits); }

  const ConfigKey* find_key(std::string_view name) const {
    const auto found = std::find_if(keyed_.begin(), keyed_.end(), [&](const KeyedOption& one) {
      return one.option.key.name == name;
    });
    return found == keyed_.end() ? nullptr : &found->option.key;
  }

  std::vector<std::string_view> names(bool by_path) const {
    std::vector<std::string_view> all{by_path ? kPaths : kOverrides};
    if (!by_path) all.push_back(kExtends);
    for (const KeyedOption& one : keyed_) {
      if (one.option.key.by_path >= by_path) all.push_back(one.option.key.name);
    }
    return all;
  }

  void read_value(const ConfigKey& key, const toml::node& node, Values& values) {
    bool fits = false;
    if (key.form == ConfigForm::number) {
      fits = node.is_integer();
      if (fits) keep(key, std::to_string(**node.as_integer()), node, values);
    } else if (key.form == ConfigForm::flag) {
      fits = node.is_boolean();
      if (fits) keep(key, **node.as_boolean() ? "true" : "false", node, values);
    } else if (key.form == ConfigForm::levels) {
      fits = read_levels(key, node, values);
    } else if (key.form == ConfigForm::codes || key.form == ConfigForm::names ||
               key.form == ConfigForm::patterns || key.form == ConfigForm::files ||
               key.form == ConfigForm::paths) {
      fits = read_strings(key, node, values);
    } else {
      fits = node.is_string();
      if (fits) keep(key, **node.as_string(), node, values);
    }
    if (!fits) {
      complain(line_of(node), fmt::format("{}: {} is expected", key.name, form_words(key.form)));
    }
  }

  bool read_strings(const ConfigKey& key, const toml::node& node, Values& values) {
    const toml::array* list = node.as_array();
    if (list == nullptr) return false;
    for (const toml::node& item : *list) {
      if (!item.is_string()) return false;
      keep(key, **item.as_string(), item, values);
    }
    return true;
  }

  bool read_levels(const ConfigKey& key, const toml::node& node, Values& values) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return false;
    for (const auto& [code, level] : *table) {
      if (!level.is_string()) return false;
      keep(key, fmt::format("{}={}", code.str(), **level.as_string()), level, values);
    }
    return true;
  }

  // Accepts the same values as the command line, with the same error messages.
  void keep(const ConfigKey& key, std::string word, const toml::node& node, Values& values) {
    const bool list = key.form == ConfigForm::codes || key.form == ConfigForm::levels;
    if (is_full()) return;
    if (right_.count({key.name, word}) != 0) {
      values.push_back({key, std::move(word), line_of(node)});
      return;
    }
    const auto mistake = mistake_in(key, word);
    if (word.empty() || (list && word.find(',') != std::string::npos)) {
      complain(line_of(node), fmt::format("{}: {} is not a value", key.name, gltfx::quoted(word)));
    } else if (mistake) {
      const std::string& message = mistake->message;
      complain(line_of(node),
               fmt::format("{}{}", key.name,
                           message.substr(std::min(message.find(':'), message.size()))));
    } else {
      right_.insert({key.name, word});
      values.push_back({key, std::move(word), line_of(node)});
    }
  }

  // The mistake in an option of validation: other verbs read their words when they run.
  std::optional<Error> mistake_in(const ConfigKey& key, const std::string& word) {
    for (const Option& row : checks_.rows()) {
      if (row.key.name == key.name) return row.read(row.name, {word});
    }
    return {};
  }

  void read_bases(const toml::node& node) {
    const toml::array* list = node.as_array();
    if (list == nullptr || !list->is_homogeneous(toml::node_type::string)) {
      return complain(line_of(node), "extends: a list of presets and files is expected");
    }
    for (const toml::node& item : *list) {
      file_.extends.push_back({item.as_string()->get(), line_of(item)});
    }
  }

  void read_overrides(const toml::node& node) {
    const toml::array* list = node.as_array();
    if (list == nullptr || !list->is_homogeneous(toml::node_type::table)) {
      return complain(line_of(node), "'overrides' is a list of tables: write [[overrides]]");
    }
    for (const toml::node& item : *list) read_override(*item.as_table());
  }

  void read_override(const toml::table& table) {
    ConfigOverride found;
    found.line = line_of(table);
    for (const auto& [key, node] : table) {
      if (key.str() == kPaths) {
        read_paths(node, found);
      } else {
        read_member(key, node, true, found);
      }
    }
    if (found.paths.empty())
      complain(found.line, "an override names its 'paths', a list of patterns");
    by_line(found.values);
    file_.overrides.push_back(std::move(found));
  }

  void read_paths(const toml::node& node, ConfigOverride& found) {
    const toml::array* list = node.as_array();
    if (list == nullptr) return;
    for (const toml::node& item : *list) {
      if (item.is_string()) {
        found.paths.push_back(**item.as_string());
      } else {
        complain(line_of(item), "paths: a list of strings is expected");
      }
    }
  }

  const std::string& name_;
  LimitTables limits_;
  const ResolvePath& resolve_;
  std::shared_ptr<OwnPages> pages_;
  ConfigFile file_;
  std::multimap<std::uint32_t, std::string> mistakes_;
  std::set<bool> unknown_keys_;  ///< where they occur: outside of overrides, in them
  std::vector<KeyedOption> keyed_ = keyed_options();
  ValidateRequest scratch_;
  Options checks_;
  std::set<std::pair<std::string_view, std::string>> right_;  ///< values that were accepted before
};

}  // namespace

Result<ConfigFile> parse_config(std::string_view text, const std::string& name,
                                const ResolvePath& resolve,
                                const std::shared_ptr<OwnPages>& pages) {
  Reader reader(name, resolve, pages);
  if (const ConfigObstacle obstacle = find_obstacle(text); obstacle.line > 0) {
    reader.complain(obstacle.line, obstacle.problem);
    return reader.finish();
  }
  const toml::parse_result root = toml::parse(text);
  if (root) {
    reader.read(root.table());
  } else {
    reader.complain(root.error().source().begin.line, printable(root.error().description()));
  }
  return reader.finish();
}

}  // namespace gltfx::tool
