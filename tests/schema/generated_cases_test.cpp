// SPDX-License-Identifier: Apache-2.0
// Cases made from the built-in schema files: valid objects are accepted, and every error is
// reported.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "schema/case_generator.hpp"
#include "schema/findings.hpp"

namespace gltfx::test {
namespace {

using schema::builtin_set;

// Findings that are no more than information.
bool is_quiet(const Found& found) {
  static const std::set<std::string> quiet{"NON_OBJECT_EXTRAS", "PROPERTY_RENAMED",
                                           "PROPERTY_DEPRECATED", "PROPERTY_DRAFT"};
  return quiet.count(found.code) != 0;
}

std::string lines(const std::vector<Found>& findings) {
  std::string all;
  for (const Found& found : findings)
    all += "  " + found.code + " " + found.pointer + ": " + found.message + "\n";
  return all;
}

// At the member, inside it, or at its object.
bool is_near(const std::string& pointer, const ErrorCase& error) {
  return pointer == error.object || pointer == error.member ||
         pointer.rfind(error.member + "/", 0) == 0;
}

bool is_told(const ErrorCase& error, const std::vector<Found>& findings) {
  return std::any_of(findings.begin(), findings.end(), [&](const Found& found) {
    const bool says_all = std::all_of(
        error.says.begin(), error.says.end(),
        [&](const std::string& word) { return found.message.find(word) != std::string::npos; });
    return !is_quiet(found) && is_near(found.pointer, error) && says_all;
  });
}

// Each test is a separate process, which makes all cases: they are made once, and not copied.
std::vector<const Subject*> all_subjects() {
  static const std::vector<Subject> kSubjects = [] {
    CaseGenerator generator(*builtin_set());
    std::vector<Subject> subjects = generator.extension_subjects();
    for (Subject& each : generator.core_subjects()) subjects.push_back(std::move(each));
    return subjects;
  }();
  std::vector<const Subject*> all;
  for (const Subject& each : kSubjects) all.push_back(&each);
  return all;
}

class GeneratedCases : public testing::TestWithParam<const Subject*> {
 protected:
  // The object itself and those inside it.
  std::vector<Subject> subjects() {
    std::vector<Subject> all{*GetParam()};
    for (Subject& inner : generator_.inner_subjects(*GetParam())) all.push_back(std::move(inner));
    return all;
  }
  CaseGenerator generator_{*builtin_set()};
};

TEST_P(GeneratedCases, SmallestValidObjectRaisesNothing) {
  for (const Subject& subject : subjects()) {
    EXPECT_EQ(lines(find(subject.document.dump())), "") << subject.name << "\n"
                                                        << subject.document.dump(1);
  }
}

TEST_P(GeneratedCases, EveryErrorIsToldAtTheMemberOrItsObject) {
  Gaps gaps;
  std::size_t count = 0;
  for (const Subject& subject : subjects()) {
    for (const ErrorCase& error : generator_.errors(subject, gaps)) {
      ++count;
      const std::vector<Found> findings = find(error.document.dump());
      EXPECT_TRUE(is_told(error, findings)) << error.name << " at " << error.member << "\n"
                                            << lines(findings);
    }
  }
  EXPECT_TRUE(gaps.empty()) << testing::PrintToString(gaps);
  RecordProperty("cases", static_cast<int>(count));
}

INSTANTIATE_TEST_SUITE_P(
    Schema, GeneratedCases, testing::ValuesIn(all_subjects()), [](const auto& subject) {
      std::string name = subject.param->name;
      std::replace_if(
          name.begin(), name.end(),
          [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
      return name;
    });

TEST(GeneratedCaseCount, CoversEveryExtensionWithAnObjectAndMoreThanAThousandErrors) {
  CaseGenerator generator(*builtin_set());
  std::set<schema::ExtensionId> extensions;
  std::size_t errors = 0;
  Gaps gaps;
  for (const Subject& subject : generator.extension_subjects()) {
    extensions.insert(subject.extension);
    errors += generator.errors(subject, gaps).size();
  }
  for (schema::ExtensionId id = 0; id < builtin_set()->extensions().size(); ++id) {
    const schema::Extension& extension = builtin_set()->extensions()[id];
    EXPECT_EQ(extensions.count(id) != 0, !extension.attachment_points.empty()) << extension.name;
  }
  EXPECT_GT(errors, 1170U);
}

}  // namespace
}  // namespace gltfx::test
