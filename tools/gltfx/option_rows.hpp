// SPDX-License-Identifier: Apache-2.0
/// The options of a verb, one row each: name, type, text, the member of the request that takes the
/// value, its parser, its completion, and the key of gltfx.toml.
#pragma once

#include <gltfx/limit.hpp>

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "command_table.hpp"
#include "options.hpp"
#include "own_pages.hpp"

namespace gltfx::tool {

using Words = std::vector<std::string>;

/// The target of the words of an option.
struct Binding {
  /// Nothing when they are valid. Null: the verb reads the words by name.
  std::function<std::optional<Error>(std::string_view option, const Words&)> read = nullptr;
  std::function<Values()> values = nullptr;
  bool repeatable = false;
};

/// The word of an option whose value was left out.
inline constexpr std::string_view kNoValue = "-";

/// An option and its words.
struct Option : OptionEntry {
  decltype(Binding::read) read;
  Words words;             ///< empty: the member keeps its value
  bool given = false;      ///< the words are from the command line
  bool file_only = false;  ///< the verb takes the key, and not the option
};

class PathOptions;

/// The rows of one verb. Bindings refer to the rows and to the request.
class Options {
 public:
  Options() = default;
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;

  /// `names`: "-f,--format"; `type`: of the value, empty for a flag; `text`: no full stop.
  void add(std::string_view names, std::string_view type, std::string_view text, Binding binding,
           ConfigKey key = {});
  /// The row of positional arguments.
  void positional(std::string_view name, std::string_view text, Binding binding);
  /// Rows that follow are keys without an option.
  void begin_file_only() { file_only_ = true; }

  std::deque<Option>& rows() { return rows_; }
  const std::deque<Option>& rows() const { return rows_; }
  Option& arguments() { return arguments_; }
  const Option& arguments() const { return arguments_; }

  /// The words of an option, or none.
  const Words& words(std::string_view name) const;
  /// The last word of an option, or empty.
  std::string_view word(std::string_view name) const;
  /// Whether the command line has the option.
  bool given(std::string_view name) const;
  bool has_keys() const;

  /// Reads all words into their members. Returns the first mistake, or nothing.
  std::optional<Error> read() const;
  /// Reads the words that may differ by path. Precondition: read() found no mistake in them.
  void read_by_path() const;

  /// Whether the command line has an option that runs without the configuration.
  bool runs_without_configuration() const;

  bool hook = false;                                    ///< the verb runs on the assets of a commit
  std::vector<std::string_view> without_configuration;  ///< names of such options
  std::vector<Limit>* limits = nullptr;        ///< those that options change; null: it has none
  std::shared_ptr<const PathOptions> by_path;  ///< null: all paths have the same options
  std::shared_ptr<const OwnPages> own_pages;   ///< of the run; null: none was named

  /// All own rules; null: none.
  std::shared_ptr<const OwnRules> own_rules() const {
    return own_pages ? own_pages->all() : nullptr;
  }

 private:
  const Option* find(std::string_view name) const;

  std::deque<Option> rows_;
  Option arguments_;
  Words none_;  ///< those of an option that the verb does not have
  bool file_only_ = false;
};

/// The mistake in the value of an option, from half a sentence or a question.
Error mistake_in(std::string_view option, const Error& why);
/// "--lfs: 'skp' is not one of skip, error. Did you mean 'skip'?"
Error unknown_word(std::string_view option, std::string_view text,
                   std::span<const std::string_view> names);

/// Words and their values.
template <class T>
using Choices = std::vector<std::pair<std::string_view, T>>;

template <class T>
std::vector<std::string_view> names_of(const Choices<T>& choices) {
  std::vector<std::string_view> names;
  for (const auto& [name, value] : choices) names.push_back(name);
  return names;
}

/// The value of a word; else the Error above.
template <class T>
Result<T> choose(std::string_view option, std::string_view text, const Choices<T>& choices) {
  for (const auto& [name, value] : choices) {
    if (name == text) return value;
  }
  return unknown_word(option, text, names_of(choices));
}

/// The completion of these words.
template <class T>
std::function<Values()> values_of(const Choices<T>& choices) {
  return [names = names_of(choices)] {
    return Values{.words = {{}, std::vector<std::string>(names.begin(), names.end())}};
  };
}

// Bindings of a row. Each takes the member first.

/// The last word, by a function (option, word) that gives a Result.
template <class T, class Parse>
Binding parsed(T& member, Parse parse, std::function<Values()> values = nullptr) {
  return {[&member, parse](std::string_view option, const Words& words) -> std::optional<Error> {
            auto value = parse(option, words.back());
            if (!value) return value.error();
            member = static_cast<T>(*std::move(value));
            return {};
          },
          std::move(values)};
}

/// All words together, by a function (option, words).
template <class T, class Parse>
Binding parsed_list(T& member, Parse parse, std::function<Values()> values = nullptr) {
  return {[&member, parse](std::string_view option, const Words& words) -> std::optional<Error> {
            auto value = parse(option, words);
            if (!value) return value.error();
            member = *std::move(value);
            return {};
          },
          std::move(values), true};
}

/// The last word, unchanged.
Binding text(std::string& member, std::function<Values()> values = nullptr);
/// All words, unchanged.
Binding list(Words& member, std::function<Values()> values = nullptr);

/// A flag that gives the member a value.
template <class T>
Binding set_to(T& member, std::type_identity_t<T> value) {
  return {[&member, value](std::string_view, const Words&) -> std::optional<Error> {
    member = value;
    return {};
  }};
}
/// A flag. gltfx.toml may also have "false".
Binding flag(bool& member);

/// One of some words.
template <class T>
Binding one_of(T& member, Choices<std::type_identity_t<T>> choices) {
  auto values = values_of(choices);
  return parsed(
      member,
      [choices = std::move(choices)](std::string_view option, std::string_view word) {
        return choose(option, word, choices);
      },
      std::move(values));
}

/// Some of some words, one per use.
template <class T>
Binding each_of(std::vector<T>& member, Choices<std::type_identity_t<T>> choices) {
  auto values = values_of(choices);
  return parsed_list(
      member,
      [choices = std::move(choices)](std::string_view option,
                                     const Words& words) -> Result<std::vector<T>> {
        std::vector<T> all;
        for (const std::string& word : words) {
          const auto value = choose(option, word, choices);
          if (!value) return value.error();
          all.push_back(*value);
        }
        return all;
      },
      std::move(values));
}

/// A whole number.
template <class T>
Binding number(T& member, std::uint64_t least = 0) {
  return parsed(member, [least](std::string_view option, std::string_view word) {
    return parse_number(option, word, least);
  });
}
/// A whole number from `least` to `greatest`.
template <class T>
Binding number(T& member, std::uint32_t least, std::uint32_t greatest) {
  return parsed(member, [least, greatest](std::string_view option, std::string_view word) {
    return parse_count(option, word, least, greatest);
  });
}
/// A number from `least` to `greatest`.
Binding decimal(double& member, double least, double greatest);

}  // namespace gltfx::tool
