// SPDX-License-Identifier: Apache-2.0
#include "help_words.hpp"

#include <regex>

namespace gltfx::program {

std::set<std::string> options_in(const std::string& help) {
  std::set<std::string> found;
  const std::regex option("(?:^|\n) +(?:-[A-Za-z],)?(--[a-z][a-z-]*)");
  for (std::sregex_iterator at(help.begin(), help.end(), option), end; at != end; ++at) {
    found.insert((*at)[1]);
  }
  return found;
}

std::vector<std::string> verbs_in(const std::string& help) {
  std::vector<std::string> verbs;
  const std::size_t begin = help.find("Subcommands:\n");
  const std::string list = help.substr(begin, help.find("\n\n", begin) - begin);
  const std::regex verb("\n  ([a-z]+) ");
  for (std::sregex_iterator at(list.begin(), list.end(), verb), end; at != end; ++at) {
    verbs.push_back((*at)[1]);
  }
  return verbs;
}

}  // namespace gltfx::program
