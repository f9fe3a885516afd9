// SPDX-License-Identifier: Apache-2.0
// JUnit XML, which build servers show as tests: a suite per file, a test per finding and per
// repeat. Findings at or above --fail-on fail; the others pass with their text. Names of tests are
// stable from run to run. tests/report/junit.xsd has the shape.
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "report/occurrences.hpp"
#include "report/safe_text.hpp"
#include "report/wording.hpp"
#include "report/writers.hpp"

namespace gltfx::report {
namespace {

// Neutralised text for an element or a quoted attribute. XML cannot represent control characters,
// U+FFFE and U+FFFF: they become visible escapes.
std::string xml(std::string_view text) {
  std::string out;
  const std::string plain = safe(text);
  for (std::size_t at = 0; at < plain.size(); ++at) {
    const std::string_view rest = std::string_view(plain).substr(at, 3);
    if (rest == "\xEF\xBF\xBE" || rest == "\xEF\xBF\xBF") {
      out += rest == "\xEF\xBF\xBE" ? "\\ufffe" : "\\uffff";
      at += 2;
      continue;
    }
    switch (plain[at]) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += plain[at];
    }
  }
  return out;
}

/// Totals of the elements around tests.
struct Totals {
  std::uint64_t tests = 0, failures = 0, errors = 0, microseconds = 0;

  Totals& operator+=(const Totals& other) {
    tests += other.tests;
    failures += other.failures;
    errors += other.errors;
    microseconds += other.microseconds;
    return *this;
  }
};

class JunitWriter final : public ReportWriter {
 public:
  explicit JunitWriter(const FormatOptions& options) : options_(options) {}

  void begin(std::string&) override {}

  // The totals come before the suites.
  void file(const FileReport& report, std::string&) override {
    const std::string path = xml(report.path);
    Totals totals;
    if (options_.timings) totals.microseconds = report.microseconds;
    std::string tests;
    Identities identities;
    for_each_occurrence(report, [&](const Diagnostic& finding) {
      test(report, path, finding, identities.next(finding), totals, tests);
    });
    if (totals.tests == 0) {
      begin_test(path, "valid", totals, tests);
      tests += "/>\n";
    }
    suites_ += fmt::format("  <testsuite name=\"{}\" {}>\n", path, attributes(totals));
    suites_ += properties();
    suites_ += tests;
    if (report.truncated) {
      suites_ += fmt::format("    <system-out>{}</system-out>\n", xml(truncation_note(report)));
    }
    suites_ += "  </testsuite>\n";
    totals_ += totals;
  }

  void end(const RunSummary&, std::string& out) override {
    out += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    out += fmt::format("<testsuites name=\"gltfx\" {}>\n", attributes(totals_));
    out += suites_;
    out += "</testsuites>\n";
  }

 private:
  bool fails(const Diagnostic& finding) const {
    return options_.fail_on && finding.severity <= *options_.fail_on;
  }

  // Without timings it is 0: two runs over the same files give the same bytes.
  std::string seconds(std::uint64_t microseconds) const {
    constexpr std::uint64_t kMillion = 1'000'000;
    if (!options_.timings) return "0";
    return fmt::format("{}.{:06}", microseconds / kMillion, microseconds % kMillion);
  }

  std::string attributes(const Totals& totals) const {
    return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"0\" time=\"{}\"",
                       totals.tests, totals.failures, totals.errors, seconds(totals.microseconds));
  }

  std::string properties() const {
    return fmt::format(
        "    <properties>\n"
        "      <property name=\"profile\" value=\"{}\"/>\n"
        "      <property name=\"pixels\" value=\"{}\"/>\n"
        "    </properties>\n",
        xml(options_.profile), xml(options_.pixel_level));
  }

  // The first test of a file has the whole time of the file, so that sums over tests are right.
  void begin_test(std::string_view path, std::string_view name, Totals& totals,
                  std::string& out) const {
    out += fmt::format("    <testcase classname=\"{0}\" name=\"{1}\" file=\"{0}\" time=\"{2}\"",
                       path, name, seconds(totals.tests == 0 ? totals.microseconds : 0));
    ++totals.tests;
  }

  void test(const FileReport& report, std::string_view path, const Diagnostic& finding,
            const Identity& identity, Totals& totals, std::string& out) const {
    begin_test(path, xml(identity.label()), totals, out);
    if (is_in_file_line(report, finding.location)) {
      out += fmt::format(" line=\"{}\"", finding.location.line);
    }
    out += ">\n";
    const std::string text = xml_text(report, finding);
    if (report.readable && !fails(finding)) {
      out += fmt::format("      <system-out>{}</system-out>\n", text);
    } else {
      const std::string_view element = report.readable ? "failure" : "error";
      ++(report.readable ? totals.failures : totals.errors);
      out += fmt::format("      <{0} type=\"{1}\" message=\"{2}\">{3}</{0}>\n", element,
                         xml(finding.code), xml(finding.message), text);
    }
    out += "    </testcase>\n";
  }

  // No line begins with asset text.
  static std::string xml_text(const FileReport& report, const Diagnostic& finding) {
    std::string text = fmt::format("{}[{}]: {}\nplace: {}{}", severity_name(finding.severity),
                                   xml(finding.code), xml(finding.message),
                                   xml(file_place(report, finding)), xml(document_place(finding)));
    if (!finding.help.empty()) text += fmt::format("\nhelp: {}", xml(finding.help));
    if (finding.count > 1) text += fmt::format("\nnote: {}", xml(repeat_note(finding)));
    return text;
  }

  FormatOptions options_;
  Totals totals_;
  std::string suites_;
};

}  // namespace

std::unique_ptr<ReportWriter> make_junit_writer(const FormatOptions& options) {
  return std::make_unique<JunitWriter>(options);
}

}  // namespace gltfx::report
