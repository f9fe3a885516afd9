// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "report/support.hpp"

namespace gltfx::report::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string junit(const std::vector<FileReport>& reports,
                  std::optional<Severity> fail_on = Severity::error) {
  FormatOptions options;
  options.profile = "default";
  options.pixel_level = "headers";
  options.fail_on = fail_on;
  return run(ReportFormat::junit, reports, options);
}

TEST(Junit, IsASuiteAFileAndATestAFinding) {
  EXPECT_EQ(junit({file("models/leaf.gltf", {wrong_type(), out_of_range()})}),
            R"xml(<?xml version="1.0" encoding="UTF-8"?>
<testsuites name="gltfx" tests="2" failures="1" errors="0" skipped="0" time="0">
  <testsuite name="models/leaf.gltf" tests="2" failures="1" errors="0" skipped="0" time="0">
    <properties>
      <property name="profile" value="default"/>
      <property name="pixels" value="headers"/>
    </properties>
    <testcase classname="models/leaf.gltf" name="TYPE_MISMATCH at /materials/*/pbrMetallicRoughness/metallicFactor ('Leaf')" file="models/leaf.gltf" time="0" line="7">
      <failure type="TYPE_MISMATCH" message="'metallicFactor' is a string; a number is expected.">error[TYPE_MISMATCH]: 'metallicFactor' is a string; a number is expected.
place: models/leaf.gltf:7:27 at /materials/0/pbrMetallicRoughness/metallicFactor ('Leaf')
help: write the number without quotes: 0.5
note: repeated 41 more times, last at /materials/44/pbrMetallicRoughness/metallicFactor</failure>
    </testcase>
    <testcase classname="models/leaf.gltf" name="VALUE_NOT_IN_RANGE at /materials/*/pbrMetallicRoughness/roughnessFactor" file="models/leaf.gltf" time="0" line="8">
      <system-out>warning[VALUE_NOT_IN_RANGE]: 'roughnessFactor' is 1.75; 0 to 1 is allowed.
place: models/leaf.gltf:8:28 at /materials/0/pbrMetallicRoughness/roughnessFactor</system-out>
    </testcase>
  </testsuite>
</testsuites>
)xml");
}

TEST(Junit, FailsWhereTheRunWould) {
  const std::vector<FileReport> reports{file("a", {wrong_type(), out_of_range()})};
  EXPECT_THAT(junit(reports, Severity::warning), HasSubstr("tests=\"2\" failures=\"2\""));
  EXPECT_THAT(junit(reports, std::nullopt), HasSubstr("failures=\"0\""));
  EXPECT_THAT(junit(reports, std::nullopt), Not(HasSubstr("<failure")));
}

TEST(Junit, AFileWithoutFindingsIsOnePassedTest) {
  EXPECT_THAT(
      junit({file("a.gltf")}),
      HasSubstr("<testcase classname=\"a.gltf\" name=\"valid\" file=\"a.gltf\" time=\"0\"/>"));
}

TEST(Junit, AFileThatCannotBeReadIsAnError) {
  const std::string text = junit(sample_run(), std::nullopt);
  EXPECT_THAT(text, HasSubstr("name=\"gone.gltf\" tests=\"1\" failures=\"0\" errors=\"1\""));
  EXPECT_THAT(text, HasSubstr("<error type=\"IO_ERROR\" message=\"No such file.\">"));
  EXPECT_THAT(text, HasSubstr("<system-out>3 more findings are not listed"));
}

TEST(Junit, TotalsAreThoseOfAllSuites) {
  EXPECT_THAT(junit(sample_run()),
              HasSubstr("<testsuites name=\"gltfx\" tests=\"6\" failures=\"2\" errors=\"1\" "
                        "skipped=\"0\" time=\"0\">"));
}

TEST(Junit, EachRepeatIsATestWhoseNameHasNoIndex) {
  const auto at_node = [](const char* pointer, const char* name) {
    Diagnostic d = finding("X", Severity::error, "M.", pointer);
    d.object_name = name;
    return d;
  };
  FileReport report = file("a.gltf", {at_node("/nodes/0", "Oak")});
  keep_repeat(report, at_node("/nodes/4", ""));
  keep_repeat(report, at_node("/nodes/9", ""));
  const std::string text = junit({report});
  EXPECT_THAT(text, HasSubstr("tests=\"3\" failures=\"3\""));
  EXPECT_THAT(text, HasSubstr("name=\"X at /nodes/* ('Oak')\""));
  EXPECT_THAT(text, HasSubstr("name=\"X at /nodes/*\""));
  EXPECT_THAT(text, HasSubstr("name=\"X at /nodes/* #2\""));
  EXPECT_THAT(text, Not(HasSubstr("repeated")));
}

TEST(Junit, TimesAreSumsOfThoseOfFiles) {
  FormatOptions options;
  options.timings = true;
  FileReport first = file("a.gltf", {wrong_type(), out_of_range()});
  first.microseconds = 1'500'000;
  FileReport second = file("b.gltf");
  second.microseconds = 25;
  const std::string text = run(ReportFormat::junit, {first, second}, options);
  EXPECT_THAT(text, HasSubstr("skipped=\"0\" time=\"1.500025\">\n  <testsuite name=\"a.gltf\""));
  EXPECT_THAT(text, HasSubstr("time=\"1.500000\">\n    <properties>"));
  EXPECT_THAT(text, HasSubstr("time=\"1.500000\" line=\"7\">"));
  EXPECT_THAT(text, HasSubstr("time=\"0.000000\" line=\"8\">"));
  EXPECT_THAT(text, HasSubstr("name=\"valid\" file=\"b.gltf\" time=\"0.000025\"/>"));
}

TEST(Junit, TextStaysText) {
  const Diagnostic d = finding("X", Severity::error, "a]]>b<c>&amp;\"\x01\xEF\xBF\xBF\t");
  EXPECT_THAT(junit({file("<a&\">.gltf", {d})}),
              ::testing::AllOf(HasSubstr("name=\"&lt;a&amp;&quot;&gt;.gltf\""),
                               HasSubstr("a]]&gt;b&lt;c&gt;&amp;amp;&quot;\\u0001\\uffff "),
                               Not(HasSubstr("]]>"))));
}

}  // namespace
}  // namespace gltfx::report::testing
