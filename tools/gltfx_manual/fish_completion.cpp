// SPDX-License-Identifier: Apache-2.0
// Completion for fish 3.
#include <iterator>

#include <fmt/format.h>

#include "option_values.hpp"
#include "pages.hpp"

namespace gltfx::tool {
namespace {

constexpr std::string_view kHead =
    R"(# fish completion for gltfx, made from the tables of its command line.

# The verb so far, where that behind hook has its own options; empty: none yet.
function __gltfx_verb
    set -l words (commandline -opc)
    test (count $words) -gt 2; and test $words[2] = hook; and set -e words[2]
    test "$words[2]" = "$argv[1]"
end

# __gltfx_paths ENDING...: files with one of the endings, and folders; without endings all files.
function __gltfx_paths
    set -l typed (string replace -r '^--?[a-z-]+=' '' -- (commandline -ct))
    set -l paths (__fish_complete_path $typed | string replace -r '\t.*' '')
    test (count $argv) -eq 0; and printf '%s\n' $paths; and return
    string match -ri '^.*(?:/|\.(?:'(string join '|' $argv)'))$' -- $paths
end

# __gltfx_list WORD...: words with commas between.
function __gltfx_list
    set -l before (string replace -r '^--[a-z-]+=' '' -- (commandline -ct) | string match -r '.*,')
    printf '%s\n' $before$argv
end

# __gltfx_pairs LEVEL... -- WORD...: a word, "=", and a level or, without one, a file.
function __gltfx_pairs
    set -l at (contains -i -- -- $argv)
    set -l words $argv[(math $at + 1)..-1]
    set -l typed (string replace -r '^--[a-z-]+=' '' -- (commandline -ct))
    set -l word (string match -r '^[^=]+=' -- $typed)
    if test $at -gt 1
        set -l levels $argv[1..(math $at - 1)]
        for each in $words
            printf '%s\n' $each=$levels
        end
    else if test -n "$word"
        printf '%s\n' $word(__fish_complete_path (string replace -- $word '' $typed))
    else
        printf '%s\n' $words
    end
end

)";

std::string quoted_text(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out.push_back('\\');
    out.push_back(c);
  }
  return out.append("'");
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

std::string word_list(const WordSet& set) {
  return set.name.empty() ? joined(set.words) : "$__gltfx_" + set.name;
}

// The command whose lines fish offers.
std::string source_of(const Values& values) {
  if (values.file_behind || !values.behind.words.empty()) {
    return fmt::format("(__gltfx_pairs {} -- {})", joined(values.behind.words),
                       word_list(values.words));
  }
  if (values.commas) return fmt::format("(__gltfx_list {})", word_list(values.words));
  std::string text = word_list(values.words);
  if (values.files) {
    text.append(fmt::format(" (__gltfx_paths {})", joined(values.endings)));
  } else if (values.folders) {
    text.append(" (__fish_complete_directories)");
  }
  return text;
}

void add_option(std::string& script, const CommandEntry& command, const OptionEntry& option) {
  const auto out = std::back_inserter(script);
  fmt::format_to(out, "complete -c gltfx -n '__gltfx_verb {}' -l {}",
                 command.name.empty() ? "\"\"" : command.name, option.name.substr(2));
  if (!option.short_name.empty()) fmt::format_to(out, " -s {}", option.short_name.substr(1));
  fmt::format_to(out, " -d {}", quoted_text(option.text));
  if (option.takes_value()) {
    fmt::format_to(out, " -x");
    const std::string source = source_of(option.offered());
    if (!source.empty()) fmt::format_to(out, " -a {}", quoted_text(source));
  }
  script.push_back('\n');
}

}  // namespace

std::string fish_completion(const std::vector<CommandEntry>& table) {
  std::string script(kHead);
  const auto out = std::back_inserter(script);
  for (const WordSet& set : named_word_sets()) {
    fmt::format_to(out, "set -g __gltfx_{} {}\n", set.name, joined(set.words));
  }
  script.append("complete -c gltfx -f\n");
  for (const CommandEntry& command : table) {
    if (!command.name.empty()) {
      fmt::format_to(out, "\ncomplete -c gltfx -n '__gltfx_verb \"\"' -a {} -d {}\n", command.name,
                     quoted_text(command.text));
    }
    const std::string source = source_of(command.positional.offered());
    if (!command.positional.name.empty() && !source.empty()) {
      fmt::format_to(out, "complete -c gltfx -n '__gltfx_verb {}' -a {}\n", command.name,
                     quoted_text(source));
    }
    for (const OptionEntry& option : command.options) add_option(script, command, option);
  }
  return script;
}

}  // namespace gltfx::tool
