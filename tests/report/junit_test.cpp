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
<testsuites name="gltfx">
  <testsuite name="models/leaf.gltf" tests="2" failures="1" errors="0" skipped="0">
    <properties>
      <property name="profile" value="default"/>
      <property name="pixels" value="headers"/>
    </properties>
    <testcase classname="models/leaf.gltf" name="TYPE_MISMATCH at /materials/0/pbrMetallicRoughness/metallicFactor ('Leaf')" file="models/leaf.gltf" line="7">
      <failure type="TYPE_MISMATCH" message="'metallicFactor' is a string; a number is expected.">error[TYPE_MISMATCH]: 'metallicFactor' is a string; a number is expected.
place: models/leaf.gltf:7:27 at /materials/0/pbrMetallicRoughness/metallicFactor ('Leaf')
help: write the number without quotes: 0.5
note: repeated 41 more times, last at /materials/44/pbrMetallicRoughness/metallicFactor</failure>
    </testcase>
    <testcase classname="models/leaf.gltf" name="VALUE_NOT_IN_RANGE at /materials/0/pbrMetallicRoughness/roughnessFactor" file="models/leaf.gltf" line="8">
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
  EXPECT_THAT(junit({file("a.gltf")}),
              HasSubstr("<testcase classname=\"a.gltf\" name=\"valid\" file=\"a.gltf\"/>"));
}

TEST(Junit, AFileThatCannotBeReadIsAnError) {
  const std::string text = junit(sample_run(), std::nullopt);
  EXPECT_THAT(text, HasSubstr("name=\"gone.gltf\" tests=\"1\" failures=\"0\" errors=\"1\""));
  EXPECT_THAT(text, HasSubstr("<error type=\"IO_ERROR\" message=\"No such file.\">"));
  EXPECT_THAT(text, HasSubstr("<system-out>3 more findings are not listed"));
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
