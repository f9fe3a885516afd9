// SPDX-License-Identifier: Apache-2.0
/// Documentation: links work, commands exist, the README is short.
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
namespace fs = std::filesystem;

constexpr std::size_t kMostReadmeLines = 250;

std::vector<Source> pages() {
  std::vector<Source> found;
  for (Source& source : files_below({"README.md", "HACKING.md", "CHANGELOG.md", "SECURITY.md",
                                     "libgltfx/README.md", "docs", "schema/rules", "examples"})) {
    if (source.path.ends_with(".md")) found.push_back(std::move(source));
  }
  return found;
}

// Text with the content of fenced blocks and inline code left out; lines stay where they are.
std::string prose(const std::string& text) {
  std::istringstream lines(text);
  std::string out;
  std::string fence;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t ticks = line.find_first_not_of('`');
    const std::string mark = line.substr(0, ticks);
    if (fence.empty() && mark.size() >= 3) {
      fence = mark;
    } else if (!fence.empty()) {
      if (mark == fence) fence.clear();
    } else {
      out += line;
    }
    out += '\n';
  }
  return out;
}

// The anchor of a heading, as GitHub makes it.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '-' || c == '_') {
      anchor += static_cast<char>(std::tolower(byte));
    } else if (c == ' ') {
      anchor += '-';
    }
  }
  return anchor;
}

std::set<std::string> anchors_of(const std::string& text) {
  std::set<std::string> anchors;
  std::istringstream lines(prose(text));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t level = line.find_first_not_of('#');
    if (level == 0 || level == std::string::npos || line[level] != ' ') continue;
    anchors.insert(anchor_of(line.substr(level + 1)));
  }
  return anchors;
}

std::string text_of(const std::string& path) {
  const std::vector<Source> found = files_below({path});
  return found.size() == 1 ? found.front().text : std::string();
}

Problems check_links(const Source& page) {
  static const std::regex kLink(R"(\]\(([^)\s]+)\))");
  Problems problems;
  const std::string text = prose(page.text);
  for (std::sregex_iterator at(text.begin(), text.end(), kLink), end; at != end; ++at) {
    const std::string target = (*at)[1];
    if (target.find("://") != std::string::npos) continue;
    const std::size_t hash = target.find('#');
    const std::string file = target.substr(0, hash);
    const fs::path path = file.empty()
                              ? fs::path(page.path)
                              : (fs::path(page.path).parent_path() / file).lexically_normal();
    const std::size_t line = line_of(text, static_cast<std::size_t>(at->position()));
    if (!fs::exists(fs::path(repository()) / path)) {
      problems.push_back(problem(page, line, target + " is not there"));
    } else if (hash != std::string::npos &&
               anchors_of(text_of(path.generic_string())).count(target.substr(hash + 1)) == 0) {
      problems.push_back(problem(page, line, target + " has no such heading"));
    }
  }
  return problems;
}

// Verb -> options that its help lists.
std::map<std::string, std::set<std::string>> verbs() {
  static const std::regex kOption("(?:^|[\\s,])(--?[A-Za-z][a-z-]*)");
  std::map<std::string, std::set<std::string>> found;
  std::istringstream lines(text_of("docs/reference/cli.md"));
  std::string verb;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## gltfx ")) verb = line.substr(9);
    for (std::sregex_iterator at(line.begin(), line.end(), kOption), end; at != end; ++at) {
      found[verb].insert((*at)[1]);
    }
  }
  return found;
}

// Verb and options of a command that a line shows; empty: it shows none.
std::vector<std::string> command_in(const std::string& line) {
  static const std::regex kCommand(R"((?:^|\$ |/|\} )gltfx ([a-z]+)((?: .*)?)$)");
  static const std::regex kOption("(?:^|\\s)(--[a-z][a-z-]*)");
  std::smatch command;
  if (!std::regex_search(line, command, kCommand)) return {};
  std::vector<std::string> words{command[1]};
  std::string rest = command[2];
  rest = rest.substr(0, rest.find(" -- "));  // the rest is for another program
  for (std::sregex_iterator at(rest.begin(), rest.end(), kOption), end; at != end; ++at) {
    words.push_back((*at)[1]);
  }
  return words;
}

Problems check_commands(const Source& page,
                        const std::map<std::string, std::set<std::string>>& known) {
  Problems problems;
  std::istringstream lines(page.text);
  bool fenced = false;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.starts_with("```")) fenced = !fenced;
    if (!fenced) continue;
    const std::vector<std::string> words = command_in(line);
    if (words.empty()) continue;
    const auto verb = known.find(words.front());
    if (verb == known.end()) {
      problems.push_back(problem(page, number, words.front() + " is no verb"));
      continue;
    }
    for (std::size_t i = 1; i < words.size(); ++i) {
      if (verb->second.count(words[i]) == 0) {
        problems.push_back(problem(page, number, words.front() + " has no option " + words[i]));
      }
    }
  }
  return problems;
}

TEST(Docs, LinksInsideTheTreeLeadSomewhere) {
  Problems problems;
  for (const Source& page : pages()) {
    const Problems found = check_links(page);
    problems.insert(problems.end(), found.begin(), found.end());
  }
  EXPECT_THAT(problems, IsEmpty());
}

TEST(Docs, CommandsHaveTheVerbsAndOptionsThatTheyName) {
  const auto known = verbs();
  ASSERT_GT(known.size(), 8U);
  Problems problems;
  for (const Source& page : pages()) {
    if (page.path == "CHANGELOG.md") continue;
    const Problems found = check_commands(page, known);
    problems.insert(problems.end(), found.begin(), found.end());
  }
  EXPECT_THAT(problems, IsEmpty());
}

TEST(Docs, TheReadmeIsAPage) { EXPECT_LE(line_count(text_of("README.md")), kMostReadmeLines); }

TEST(Docs, WrongLinksAndCommandsAreSeen) {
  const Source page{"docs/x.md",
                    "[a](nowhere.md) [b](faq.md#nothing) [c](faq.md)\n```console\n"
                    "$ gltfx validate --no-such a.gltf\n$ gltfx polish a.gltf\n```\n"};
  EXPECT_EQ(check_links(page).size(), 2U);
  EXPECT_THAT(check_commands(page, verbs()),
              ElementsAre("docs/x.md:3: validate has no option --no-such",
                          "docs/x.md:4: polish is no verb"));
}

}  // namespace
}  // namespace gltfx::structure
