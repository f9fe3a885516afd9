// SPDX-License-Identifier: Apache-2.0
#include "prove/findings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "prove/edited_asset.hpp"
#include "rules/validator.hpp"

namespace gltfx::prove {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

FileReport report(const std::vector<std::tuple<const char*, Severity, std::uint64_t>>& findings) {
  FileReport made;
  for (const auto& [code, severity, count] : findings) {
    Diagnostic one;
    one.code = code;
    one.severity = severity;
    one.count = count;
    made.diagnostics.push_back(one);
  }
  return made;
}

std::vector<MoreFindings> more(const FileReport& before, const FileReport& after,
                               Severity least = Severity::info) {
  return more_findings(CodeCounts(before), after, least);
}

TEST(MoreFindings, AreCountedByCode) {
  const FileReport before = report({{"A", Severity::error, 2}, {"B", Severity::info, 1}});
  EXPECT_THAT(more(before, before), IsEmpty());
  EXPECT_THAT(more(before, report({})), IsEmpty());
  const auto found = more(before, report({{"A", Severity::error, 3}, {"A", Severity::error, 2}}));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].code, "A");
  EXPECT_EQ(found[0].severity, Severity::error);
  EXPECT_EQ(found[0].count, 3U);
}

TEST(MoreFindings, ALouderOneIsMore) {
  const FileReport before = report({{"A", Severity::warning, 1}});
  const auto found = more(before, report({{"A", Severity::error, 1}}));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].severity, Severity::error);
  EXPECT_THAT(more(report({{"A", Severity::error, 1}}), before), IsEmpty());
}

TEST(MoreFindings, QuietOnesNeedNotCount) {
  const FileReport after = report({{"A", Severity::info, 1}, {"B", Severity::warning, 1}});
  EXPECT_THAT(more(report({}), after), SizeIs(2));
  EXPECT_THAT(more(report({}), after, Severity::warning), SizeIs(1));
  EXPECT_THAT(more(report({}), after, Severity::error), IsEmpty());
}

TEST(NewFindings, AreErrorsAndWarningsOfTheDefaultProfile) {
  const auto schemas = schema::builtin_set();
  const auto validated = [&](const char* text) {
    return validate::ValidatedAsset(test::EditedAsset::made(text).open(),
                                    validate::default_validation(schemas));
  };
  const auto sound = validated(R"({"asset": {"version": "2.0"}})");
  const auto wrong = validated(R"({"asset": {"version": "2.0"}, "scene": 3})");
  const auto doubtful = validated(R"({"asset": {"version": "2.0", "versoin": 1}})");
  EXPECT_EQ(new_findings(sound, sound, schemas).error, "");
  EXPECT_EQ(new_findings(sound, wrong, schemas).error, "UNRESOLVED_REFERENCE");
  EXPECT_EQ(new_findings(wrong, wrong, schemas).error, "");
  const NewFindings found = new_findings(sound, doubtful, schemas);
  EXPECT_EQ(found.error, "");
  ASSERT_THAT(found.warnings, SizeIs(1));
  EXPECT_THAT(found.warnings[0], HasSubstr(" at /asset"));
}

}  // namespace
}  // namespace gltfx::prove
