// SPDX-License-Identifier: Apache-2.0
// Completion for zsh, in the syntax of its _arguments.
#include <iterator>

#include <fmt/format.h>

#include "option_values.hpp"
#include "pages.hpp"

namespace gltfx::tool {
namespace {

constexpr std::string_view kHead =
    R"(#compdef gltfx
# zsh completion for gltfx, made from the tables of its command line.

# _gltfx_pairs FIRST SECOND: words of the array FIRST, "=", then words of the array SECOND, or a file
# where that has none.
_gltfx_pairs() {
  if compset -P '*='; then
    if (( ${#${(P)2}} )); then compadd -a -- $2; else _files; fi
  elif (( ${#${(P)2}} )); then
    compadd -S = -a -- $1
  else
    compadd -a -- $1
  fi
}

# _gltfx_list WORDS: words of an array, with commas between.
_gltfx_list() {
  compset -P '*,'
  compadd -qS , -a -- $1
}
)";

constexpr std::string_view kTail = R"(
_gltfx() {
  local curcontext=$curcontext state line ret=1
  typeset -A opt_args
  _arguments -C $_gltfx_program '1:verb:->verb' '*::argument:->rest' && ret=0
  case $state in
    verb) _describe -t commands verb _gltfx_verbs && ret=0 ;;
    rest)
      local verb=$line[1]
      # The verb behind hook has its own options.
      if [[ $verb == hook && CURRENT -gt 2 ]]; then
        verb=$words[2]
        shift words
        (( CURRENT-- ))
      fi
      local name=_gltfx_verb_$verb
      (( ${(P)+name} )) && _arguments -s -S "${(@P)name}" && ret=0
      ;;
  esac
  return ret
}

if [[ $funcstack[1] == _gltfx ]]; then _gltfx "$@"; else compdef _gltfx gltfx; fi
)";

// In single quotes, for a place where brackets and colons are separators.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') {
      out.append("'\\''");
      continue;
    }
    if (c == '[' || c == ']' || c == ':' || c == '\\') out.push_back('\\');
    out.push_back(c);
  }
  return out;
}

// The name of an array with these words; `arrays` gets those without a name.
std::string array_of(const WordSet& set, const std::string& fallback, std::string& arrays) {
  if (!set.name.empty()) return "_gltfx_" + set.name;
  const std::string name = "_gltfx_" + fallback;
  fmt::format_to(std::back_inserter(arrays), "{}=({})\n", name, fmt::join(set.words, " "));
  return name;
}

std::string path_action(const Values& values) {
  if (!values.files) return "_files -/";
  if (values.endings.empty()) return "_files";
  return fmt::format("_files -g \"(#i)*.({})(-.)\"", fmt::join(values.endings, "|"));
}

// The action of _arguments for these values, after the last colon: with a blank before it,
// functions get only these arguments.
std::string action(const Values& values, const std::string& name, std::string& arrays) {
  const bool words = !values.words.words.empty();
  if (values.file_behind || !values.behind.words.empty()) {
    const std::string first = array_of(values.words, name + "_words", arrays);
    return fmt::format(" _gltfx_pairs {} {}", first,
                       array_of(values.behind, name + "_behind", arrays));
  }
  if (words && values.commas) {
    return fmt::format(" _gltfx_list {}", array_of(values.words, name + "_words", arrays));
  }
  if (words && values.words.name.empty() && !values.paths()) {
    return fmt::format("({})", fmt::join(values.words.words, " "));
  }
  if (words) {
    return fmt::format("{{compadd -a -- {}{}}}", array_of(values.words, name + "_words", arrays),
                       values.paths() ? "; " + path_action(values) : "");
  }
  return values.paths() ? path_action(values) : " ";
}

std::string array_part(const CommandEntry& command, std::string_view option) {
  std::string name = command.name + std::string(option);
  for (char& c : name) {
    if (c == '-') c = '_';
  }
  return name;
}

std::string option_line(const CommandEntry& command, const OptionEntry& option,
                        std::string& arrays) {
  std::string rest = fmt::format("[{}]", plain(option.text));
  if (option.takes_value()) {
    rest.append(fmt::format(":{}:{}", plain(option.type),
                            action(option.offered(), array_part(command, option.name), arrays)));
  }
  const std::string name = std::string(option.name) + (option.takes_value() ? "=" : "");
  const std::string star = option.repeatable ? "*" : "";
  if (option.short_name.empty()) return fmt::format("  '{}{}{}'\n", star, name, rest);
  const std::string other = std::string(option.short_name) + (option.takes_value() ? "+" : "");
  const std::string guard =
      option.repeatable ? "*" : fmt::format("({} {})", option.short_name, option.name);
  return fmt::format("  '{0}{1}{3}'\n  '{0}{2}{3}'\n", guard, other, name, rest);
}

void add_command(std::string& script, const CommandEntry& command) {
  std::string arrays = "\n", specs;
  for (const OptionEntry& option : command.options) {
    specs.append(option_line(command, option, arrays));
  }
  if (!command.positional.name.empty()) {
    specs.append(
        fmt::format("  '*:{}:{}'\n", plain(command.positional.text),
                    action(command.positional.offered(), array_part(command, ""), arrays)));
  }
  const std::string name = command.name.empty() ? "program" : "verb_" + command.name;
  fmt::format_to(std::back_inserter(script), "{}_gltfx_{}=(\n{})\n", arrays, name, specs);
}

}  // namespace

std::string zsh_completion(const std::vector<CommandEntry>& table) {
  std::string script(kHead), verbs;
  for (const WordSet& set : named_word_sets()) {
    fmt::format_to(std::back_inserter(script), "\n_gltfx_{}=({})\n", set.name,
                   fmt::join(set.words, " "));
  }
  for (const CommandEntry& command : table) {
    add_command(script, command);
    if (command.name.empty()) continue;
    fmt::format_to(std::back_inserter(verbs), "  '{}:{}'\n", command.name, plain(command.text));
  }
  return fmt::format("{}\n_gltfx_verbs=(\n{})\n{}", script, verbs, kTail);
}

}  // namespace gltfx::tool
