// SPDX-License-Identifier: Apache-2.0
#include <gltfx/version.hpp>

#include <regex>

#include "report/support.hpp"

namespace gltfx::report::testing {
namespace {

TEST(Counts, AddUpBySeverity) {
  Counts counts;
  counts.add(Severity::error);
  counts.add(Severity::warning, 2);
  counts.add(Severity::info, 3);
  counts.add(Severity::hint, 4);
  counts += counts;
  EXPECT_EQ(counts.errors, 2u);
  EXPECT_EQ(counts.warnings, 4u);
  EXPECT_EQ(counts.infos, 6u);
  EXPECT_EQ(counts.hints, 8u);
}

TEST(Counts, AtLeastIncludesWhatIsLouder) {
  Counts counts;
  counts.add(Severity::error, 1);
  counts.add(Severity::warning, 10);
  counts.add(Severity::info, 100);
  counts.add(Severity::hint, 1000);
  EXPECT_EQ(counts.at_least(Severity::error), 1u);
  EXPECT_EQ(counts.at_least(Severity::warning), 11u);
  EXPECT_EQ(counts.at_least(Severity::info), 111u);
  EXPECT_EQ(counts.at_least(Severity::hint), 1111u);
}

TEST(RunSummary, IsTheSumOfItsReports) {
  RunSummary summary;
  for (const FileReport& report : sample_run()) summary.add(report);
  EXPECT_EQ(summary.files, 5u);
  EXPECT_EQ(summary.files_with_errors, 3u);
  EXPECT_EQ(summary.unreadable, 1u);
  EXPECT_EQ(summary.unverified, 1u);
  EXPECT_EQ(summary.suppressed, 5u);
  EXPECT_EQ(summary.images_wanted, 5u);
  EXPECT_EQ(summary.images_decoded, 5u);
  EXPECT_EQ(summary.counts.errors, 44u);
  EXPECT_EQ(summary.counts.warnings, 1u);
  EXPECT_EQ(summary.counts.infos, 4u);
}

TEST(ReportFormats, AreFoundByTheirNames) {
  ASSERT_EQ(report_format_names().size(), 10u);
  for (const std::string_view name : report_format_names()) {
    const auto format = report_format_from_name(name);
    ASSERT_TRUE(format.has_value()) << name;
    EXPECT_EQ(report_format_name(*format), name);
  }
  EXPECT_EQ(report_format_from_name("khronos"), ReportFormat::khronos);
  EXPECT_FALSE(report_format_from_name("Text").has_value());
  EXPECT_FALSE(report_format_from_name("").has_value());
}

TEST(Version, IsThreeNumbers) {
  EXPECT_TRUE(std::regex_match(std::string(version()), std::regex("\\d+\\.\\d+\\.\\d+")));
}

}  // namespace
}  // namespace gltfx::report::testing
