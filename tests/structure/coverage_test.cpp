// SPDX-License-Identifier: Apache-2.0
// tools/coverage.toml names existing files and conditions.
#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::IsEmpty;

std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

// Whether a path matches a pattern with '*'.
bool fits(const std::string& pattern, const std::string& path) {
  const std::string dots = std::regex_replace(pattern, std::regex(R"(\.)"), R"(\.)");
  return std::regex_match(path, std::regex(std::regex_replace(dots, std::regex(R"(\*)"), ".*")));
}

// Patterns that no file fits, and conditions that their file does not have.
std::vector<std::string> stale_entries(const std::string& configuration,
                                       const std::vector<Source>& sources) {
  std::vector<std::string> stale;
  for (const std::smatch& found :
       matches(configuration, std::regex(R"re("((?:libgltfx|tools)/[^"]+)")re"))) {
    const bool there = std::any_of(sources.begin(), sources.end(), [&](const Source& source) {
      return fits(found[1], source.path);
    });
    if (!there) stale.push_back(found[1]);
  }
  for (const std::smatch& found :
       matches(configuration, std::regex(R"re(\nfile = "([^"]+)"\ntext = "([^"]+)")re"))) {
    const bool there = std::any_of(sources.begin(), sources.end(), [&](const Source& source) {
      return source.path == found[1] && source.text.find(found[2]) != std::string::npos;
    });
    if (!there) stale.push_back(found[2]);
  }
  return stale;
}

TEST(Coverage, EntriesNameWhatIsThere) {
  const std::vector<Source> configuration = files_below({"tools/coverage.toml"});
  ASSERT_EQ(configuration.size(), 1U);
  EXPECT_THAT(stale_entries(configuration[0].text, cpp_below({"libgltfx", "tools"})), IsEmpty());
}

TEST(Coverage, StaleEntriesAreFound) {
  const std::vector<Source> sources{{"libgltfx/a/b.cpp", "if (x)"}};
  const std::string configuration =
      "files = [\"libgltfx/a/*\", \"libgltfx/c/*\"]\n[[not_taken]]\n"
      "file = \"libgltfx/a/b.cpp\"\ntext = \"y\"\n"
      "[[not_taken]]\nfile = \"libgltfx/a/b.cpp\"\ntext = \"x\"\n";
  EXPECT_THAT(stale_entries(configuration, sources), testing::ElementsAre("libgltfx/c/*", "y"));
}

}  // namespace
}  // namespace gltfx::structure
