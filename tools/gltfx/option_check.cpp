// SPDX-License-Identifier: Apache-2.0
#include "option_check.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "base/text.hpp"

namespace gltfx::tool {
namespace {

/// Goes through the words of one command.
class OptionCheck {
 public:
  OptionCheck(const std::vector<CommandEntry>& table, const std::vector<std::string>& words)
      : table_(table), words_(words), verb_(&table.front()) {}

  std::string run() {
    for (at_ = 0; at_ < words_.size() && mistake_.empty(); ++at_) check(words_[at_]);
    return mistake_;
  }

 private:
  const OptionEntry* find(std::string_view name) const {
    for (const OptionEntry& option : verb_->options) {
      if (option.name == name || (!name.empty() && option.short_name == name)) return &option;
    }
    return nullptr;
  }

  void check(std::string_view word) {
    if (word.empty()) {
      mistake_ = empty_argument();
    } else if (word.starts_with("--")) {
      check_long(word);
    } else if (word.front() == '-' && word.size() > 1) {
      check_short(word);
    } else if (verb_ == &table_.front()) {
      const auto named = std::find_if(table_.begin(), table_.end(),
                                      [&](const CommandEntry& each) { return each.name == word; });
      if (named != table_.end()) verb_ = &*named;
    }
  }

  void check_long(std::string_view word) {
    const std::size_t equals = word.find('=');
    const OptionEntry* option = find(word.substr(0, equals));
    if (option == nullptr) return;
    if (equals == std::string_view::npos) return check_next(*option);
    const std::string_view value = word.substr(equals + 1);
    if (!option->takes_value()) {
      mistake_ = fmt::format("{} takes no value; {} was given.", option->name, quoted(value));
    } else if (value.empty()) {
      mistake_ =
          fmt::format("{} has no value after '='; {} is expected.", option->name, option->type);
    }
  }

  // "-qfjson" is -q and -f with the value "json".
  void check_short(std::string_view word) {
    for (std::string_view rest = word.substr(1); !rest.empty(); rest.remove_prefix(1)) {
      const OptionEntry* option = find(fmt::format("-{}", rest.front()));
      if (option == nullptr) return;
      const std::string_view value = rest.substr(1);
      if (value.starts_with('=')) return refuse_equals(*option, value.substr(1));
      if (!option->takes_value()) continue;
      if (value.empty()) check_next(*option);
      return;
    }
  }

  // Programs read "-o=a.png" differently, and a file "=a.png" is not intended.
  void refuse_equals(const OptionEntry& option, std::string_view value) {
    mistake_ =
        option.takes_value()
            ? fmt::format("a short option has no '='; write {0} {2} or {1}={2}.", option.short_name,
                          option.name, value.empty() ? std::string(option.type) : printable(value))
            : fmt::format("{} takes no value; {} was given.", option.short_name, quoted(value));
  }

  // The value is the next word.
  void check_next(const OptionEntry& option) {
    if (!option.takes_value() || option.is_value_optional()) return;
    if (++at_ == words_.size()) {
      mistake_ = fmt::format("{} needs a value: {}.", option.name, option.type);
      return;
    }
    const std::string_view value = words_[at_];
    if (value.empty()) {
      mistake_ = fmt::format("the value of {} is empty; {} is expected.", option.name, option.type);
    } else if (find(value.substr(0, value.find('='))) != nullptr) {
      mistake_ = fmt::format(
          "{0} needs a value, but {1} is an option; to use it as the value, write "
          "{0}={2}.",
          option.name, quoted(value), printable(value));
    }
  }

  const std::vector<CommandEntry>& table_;
  const std::vector<std::string>& words_;
  const CommandEntry* verb_;
  std::size_t at_ = 0;
  std::string mistake_;
};

}  // namespace

std::string empty_argument() { return "an argument is empty; is a variable of the shell unset?"; }

std::string option_mistake(const std::vector<CommandEntry>& table,
                           const std::vector<std::string>& words) {
  return OptionCheck(table, words).run();
}

}  // namespace gltfx::tool
