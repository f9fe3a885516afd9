// SPDX-License-Identifier: Apache-2.0
// Completion for bash 4 and later. It needs only bash.
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "option_values.hpp"
#include "pages.hpp"

namespace gltfx::tool {
namespace {

// The start and end of the script. `words`, `behind`, `endings`, `files`, `folders`, `commas` and
// `file_behind` are set by _gltfx_values.
constexpr std::string_view kHead =
    R"(# bash completion for gltfx, made from the tables of its command line.

)";

constexpr std::string_view kHelpers = R"(
# _gltfx_offer PREFIX TYPED WORDS: those words that go on from what was typed.
_gltfx_offer()
{
  local word
  for word in $3; do
    [[ $word == "$2"* ]] && COMPREPLY+=("$1$word")
  done
}

# _gltfx_paths PREFIX TYPED: files with one of the endings, and folders, which may lead to some.
_gltfx_paths()
{
  local path ending typed=$2
  [[ $typed == '~'* ]] && typed=$HOME${typed:1}
  compopt -o filenames 2>/dev/null
  while IFS= read -r path; do
    COMPREPLY+=("$1$path")
  done < <(compgen -d -- "$typed")
  [[ $files ]] || return 0
  while IFS= read -r path; do
    [[ -d $path ]] && continue
    [[ $endings ]] || COMPREPLY+=("$1$path")
    for ending in $endings; do
      [[ ${path,,} == *."$ending" ]] && COMPREPLY+=("$1$path")
    done
  done < <(compgen -f -- "$typed")
}

# _gltfx_value VERB OPTION TYPED PREFIX: values of an option, or of an argument.
_gltfx_value()
{
  local words='' behind='' endings='' files='' folders='' commas='' file_behind=''
  _gltfx_values "$1 $2"
  local typed=$3 prefix=$4
  if [[ $typed == *=* && ( $behind || $file_behind ) ]]; then
    # The text before "=" is a word of its own for readline, if "=" divides words.
    [[ $COMP_WORDBREAKS == *=* ]] || prefix+=${typed%%=*}=
    [[ $behind ]] && _gltfx_offer "$prefix" "${typed#*=}" "$behind"
    [[ $file_behind ]] && files=1 endings='' _gltfx_paths "$prefix" "${typed#*=}"
    return 0
  fi
  if [[ $behind ]]; then
    compopt -o nospace 2>/dev/null
    _gltfx_offer "$prefix" "$typed" "${words// /= }="
  elif [[ $commas && $typed == *,* ]]; then
    _gltfx_offer "$prefix${typed%,*}," "${typed##*,}" "$words"
  else
    _gltfx_offer "$prefix" "$typed" "$words"
  fi
  [[ $files || $folders ]] && _gltfx_paths "$prefix" "$typed"
  return 0
}

# The words up to the cursor, as gltfx will get them: bash divides them at "=", too.
_gltfx_split()
{
  local i rest=$COMP_LINE
  line=()
  for ((i = 0; i <= COMP_CWORD; ++i)); do
    if ((i > 0)) && [[ $rest != [[:blank:]]* && ${COMP_WORDS[i]} ]]; then
      line[${#line[@]} - 1]+=${COMP_WORDS[i]}
    else
      line+=("${COMP_WORDS[i]}")
    fi
    rest=${rest#"${rest%%[![:blank:]]*}"}
    rest=${rest#"${COMP_WORDS[i]}"}
  done
}

_gltfx()
{
  local -a line
  local IFS=$' \t\n'
  _gltfx_split
  COMPREPLY=()
  [[ ${line[1]} == hook && ${#line[@]} -gt 3 ]] && line=("${line[0]}" "${line[@]:2}")
  local last=$((${#line[@]} - 1))
  local typed=${line[last]} before=${line[last - 1]} verb=
  ((last > 1)) && verb=${line[1]}
  local words='' behind='' endings='' files='' folders='' commas='' file_behind=''
  if [[ $typed == --*=* ]]; then
    local prefix=
    [[ $COMP_WORDBREAKS == *=* ]] || prefix=${typed%%=*}=
    _gltfx_value "$verb" "${typed%%=*}" "${typed#*=}" "$prefix"
  elif [[ $before == -* ]] && _gltfx_values "$verb $before"; then
    _gltfx_value "$verb" "$before" "$typed" ''
  elif [[ $typed == -* ]]; then
    _gltfx_options "$verb"
    _gltfx_offer '' "$typed" "$words"
  elif [[ ! $verb ]]; then
    _gltfx_offer '' "$typed" "$_gltfx_verbs"
  else
    _gltfx_value "$verb" '' "$typed" ''
  fi
}

complete -F _gltfx gltfx
)";

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

// Words between quotes, or the variable that holds them.
std::string word_list(const WordSet& set) {
  return set.name.empty() ? fmt::format("'{}'", joined(set.words))
                          : fmt::format("$_gltfx_{}", set.name);
}

// The assignments of _gltfx_values for these values; empty: no completion.
std::string assignments(const Values& values) {
  std::string text;
  const auto add = [&](std::string_view part) { text.append(part).append(" "); };
  if (!values.words.words.empty()) add("words=" + word_list(values.words));
  if (!values.behind.words.empty()) add("behind=" + word_list(values.behind));
  if (values.commas) add("commas=1");
  if (values.file_behind) add("file_behind=1");
  if (values.files) add("files=1");
  if (values.folders) add("folders=1");
  if (!values.endings.empty()) add(fmt::format("endings='{}'", joined(values.endings)));
  return text.empty() ? ": " : text;
}

void add_values(std::string& script, const std::vector<CommandEntry>& table) {
  std::map<std::string, std::vector<std::string>> cases;
  for (const CommandEntry& command : table) {
    if (!command.positional.name.empty()) {
      cases[assignments(command.positional.offered())].push_back(command.name + " ");
    }
    for (const OptionEntry& option : command.options) {
      if (!option.takes_value()) continue;
      auto& patterns = cases[assignments(option.offered())];
      patterns.push_back(fmt::format("{} {}", command.name, option.name));
      if (!option.short_name.empty()) {
        patterns.push_back(fmt::format("{} {}", command.name, option.short_name));
      }
    }
  }
  script.append(
      "\n# _gltfx_values \"VERB OPTION\": what fits; fails for an option without a value.\n"
      "_gltfx_values()\n{\n  case $1 in\n");
  for (const auto& [effect, patterns] : cases) {
    fmt::format_to(std::back_inserter(script), "    '{}')\n      {};;\n",
                   fmt::join(patterns, "' | '"), effect);
  }
  script.append("    *) return 1 ;;\n  esac\n}\n");
}

void add_options(std::string& script, const std::vector<CommandEntry>& table) {
  script.append(
      "\n# _gltfx_options VERB: names of its options.\n_gltfx_options()\n{\n  case $1 in\n");
  for (const CommandEntry& command : table) {
    std::vector<std::string> names;
    for (const OptionEntry& option : command.options) {
      names.emplace_back(option.name);
      if (!option.short_name.empty()) names.emplace_back(option.short_name);
    }
    fmt::format_to(std::back_inserter(script), "    '{}') words='{}' ;;\n", command.name,
                   fmt::join(names, " "));
  }
  script.append("  esac\n}\n");
}

}  // namespace

std::string bash_completion(const std::vector<CommandEntry>& table) {
  std::string script(kHead);
  std::vector<std::string> verbs;
  for (const CommandEntry& command : table) {
    if (!command.name.empty()) verbs.push_back(command.name);
  }
  fmt::format_to(std::back_inserter(script), "_gltfx_verbs='{}'\n", joined(verbs));
  for (const WordSet& set : named_word_sets()) {
    fmt::format_to(std::back_inserter(script), "_gltfx_{}='{}'\n", set.name, joined(set.words));
  }
  add_values(script, table);
  add_options(script, table);
  return script.append(kHelpers);
}

}  // namespace gltfx::tool
