// SPDX-License-Identifier: Apache-2.0
/// Inside libgltfx/rules: folders that include each other in one direction.
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::string_view kRoom = "libgltfx/rules/";

// A file includes its own folder and lower ones. The empty name is that of the room itself, whose
// headers are what all rules are given.
const std::map<std::string, int, std::less<>> kFloors{
    {"", 0},        {"khronos", 0},    {"core", 1},  {"own", 1},
    {"payload", 2}, {"extensions", 3}, {"shows", 3}, {"targets", 3},
};

// What core objects have because of an extension, and who asks for it.
const std::map<std::string, std::string, std::less<>> kAsked{
    {"libgltfx/rules/core/primitive_material.cpp",
     "materials of variants, coordinates of metadata"},
    {"libgltfx/rules/khronos/view.cpp", "what that validator does not look at in variants"},
};

std::string folder_of(std::string_view path) {
  const std::size_t slash = path.find('/');
  return slash == std::string_view::npos ? std::string() : std::string(path.substr(0, slash));
}

Problems check_floors(const Source& source) {
  Problems problems;
  const std::string own = folder_of(std::string_view(source.path).substr(kRoom.size()));
  // They run the rules.
  if (own.empty() && source.path.ends_with(".cpp")) return {};
  if (kFloors.count(own) == 0) return {problem(source, 1, "is in a folder without a floor")};
  for (const Include& include : includes_of(source.text)) {
    if (include.angled || !include.name.starts_with("rules/")) continue;
    const std::string other = folder_of(std::string_view(include.name).substr(6));
    const auto floor = kFloors.find(other);
    if (other == own || (floor != kFloors.end() && floor->second < kFloors.at(own))) continue;
    if (own.empty() && other == "khronos") continue;
    if (own == "khronos" && other.empty()) continue;
    if (other == "extensions" && kAsked.count(source.path) > 0) continue;
    problems.push_back(problem(source, include.line, own + " must not include " + include.name));
  }
  return problems;
}

TEST(RuleFloors, FoldersIncludeLowerOnes) {
  Problems problems;
  for (const Source& source : cpp_below({std::string(kRoom)})) {
    const Problems found = check_floors(source);
    problems.insert(problems.end(), found.begin(), found.end());
  }
  EXPECT_THAT(problems, IsEmpty());
}

TEST(RuleFloors, ExceptionsAreNeeded) {
  for (const auto& [path, reason] : kAsked) {
    const std::vector<Source> sources = files_below({path});
    ASSERT_EQ(sources.size(), 1U) << path;
    EXPECT_NE(sources[0].text.find("#include \"rules/extensions/"), std::string::npos) << path;
  }
}

TEST(RuleFloors, AnUpwardIncludeIsFound) {
  EXPECT_THAT(
      check_floors({"libgltfx/rules/core/a.cpp", "#include \"rules/payload/b.hpp\"\n"}),
      ElementsAre("libgltfx/rules/core/a.cpp:1: core must not include rules/payload/b.hpp"));
  EXPECT_THAT(check_floors({"libgltfx/rules/a.hpp", "#include \"rules/core/b.hpp\"\n"}),
              testing::SizeIs(1));
  EXPECT_THAT(check_floors({"libgltfx/rules/attic/a.cpp", ""}), testing::SizeIs(1));
  EXPECT_THAT(check_floors({"libgltfx/rules/payload/a.cpp",
                            "#include \"rules/context.hpp\"\n#include \"rules/core/b.hpp\"\n"}),
              IsEmpty());
}

}  // namespace
}  // namespace gltfx::structure
