// SPDX-License-Identifier: Apache-2.0
/// Rules use deviations by name, and few places use the profile.
#include <map>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// How often a file names a profile or makes deviations of one, and why.
const std::map<std::string, std::pair<std::size_t, std::string>, std::less<>> kPlaces{
    {"libgltfx/include/gltfx/validate.hpp", {1, "the default"}},
    {"libgltfx/pipeline/example.cpp", {2, "examples raise their rule in one of two profiles"}},
    {"libgltfx/pipeline/fix_plan.cpp", {1, "what is new is looked for among hints, too"}},
    {"libgltfx/pipeline/validate.cpp", {1, "the Khronos validator says nothing of fixes"}},
    {"libgltfx/rules/collector.cpp", {4, "codes, hints and severities by profile; its deviations"}},
    {"libgltfx/rules/context.hpp", {1, "hands the deviations down"}},
    {"libgltfx/rules/phase_json.cpp", {1, "runs before there is a context"}},
    {"libgltfx/rules/registry.cpp", {2, "the level of pixels by profile"}},
    {"libgltfx/rules/validated_asset.cpp", {1, "whether a report is that of the defaults"}},
    {"libgltfx/rules/validator.cpp", {1, "runs before there is a context"}},
    {"tools/gltfx/validation_options.cpp", {3, "the names of profiles"}},
    {"tools/gltfx/options_validate.cpp", {3, "the words for profiles"}},
};
constexpr std::size_t kMost = 27;

constexpr std::string_view kModule = "libgltfx/rules/khronos/";

// Places of whole words in code.
std::vector<std::size_t> find_words(std::string_view code, std::string_view word) {
  std::vector<std::size_t> found;
  for (std::size_t at = code.find(word); at != std::string_view::npos;
       at = code.find(word, at + 1)) {
    const bool begins = at == 0 || !is_part_of_name(code[at - 1]);
    const std::size_t end = at + word.size();
    const bool ends =
        !is_part_of_name(word.back()) || end == code.size() || !is_part_of_name(code[end]);
    if (begins && ends) found.push_back(at);
  }
  return found;
}

Problems check_places(const Source& source) {
  if (source.path.starts_with(kModule)) return {};
  const std::string& code = lex(source.text).code;
  std::vector<std::size_t> places;
  for (const std::string_view word : {"Profile::", "deviations_of(", "khronos("}) {
    for (const std::size_t at : find_words(code, word)) places.push_back(at);
  }
  const auto known = kPlaces.find(source.path);
  const std::size_t allowed = known == kPlaces.end() ? 0 : known->second.first;
  if (places.size() == allowed) return {};
  if (places.size() < allowed) return {problem(source, 1, "asks less often: correct the list")};
  return {problem(source, line_of(source.text, places.back()), "asks for the profile")};
}

// Members of the structs in a header.
std::vector<std::string> deviations_in(const Source& source) {
  const std::string& code = lex(source.text).code;
  std::vector<std::string> names;
  for (const std::size_t at : find_words(code, "bool")) {
    const std::size_t begin = at + 5;
    names.push_back(code.substr(begin, code.find(' ', begin) - begin));
  }
  return names;
}

TEST(Deviations, FewPlacesAskForTheProfile) {
  Problems problems;
  std::size_t places = 0;
  for (const Source& source : cpp_below({"libgltfx", "tools/gltfx"})) {
    const Problems found = check_places(source);
    problems.insert(problems.end(), found.begin(), found.end());
    const auto known = kPlaces.find(source.path);
    if (known != kPlaces.end()) places += known->second.first;
  }
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_LE(places, kMost);
}

TEST(Deviations, AnotherPlaceIsFound) {
  EXPECT_THAT(check_places({"libgltfx/rules/core/a.cpp",
                            "void a() {\n  if (options.profile == Profile::khronos) return;\n}\n"}),
              ElementsAre(HasSubstr("a.cpp:2: asks for the profile")));
  EXPECT_THAT(check_places({"libgltfx/rules/context.hpp",
                            "auto a = deviations_of(profile);\nbool khronos() const;\n"}),
              SizeIs(1));
}

TEST(Deviations, AreAskedFor) {
  std::string rest;
  std::vector<std::string> names;
  for (const Source& source : cpp_below({"libgltfx/schema", "libgltfx/rules"})) {
    const bool module =
        source.path.starts_with(kModule) && source.path.find("/deviations.") != std::string::npos;
    if (module || source.path == "libgltfx/schema/deviations.hpp") {
      for (std::string& name : deviations_in(source)) names.push_back(std::move(name));
    } else {
      rest += lex(source.text).code;
    }
  }
  EXPECT_GT(names.size(), 30U);
  for (const std::string& name : names) EXPECT_THAT(find_words(rest, name), Not(IsEmpty())) << name;
}

}  // namespace
}  // namespace gltfx::structure
