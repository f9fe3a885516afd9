// SPDX-License-Identifier: Apache-2.0
// The XML of JUnit, which build servers show as tests: a suite a file, a test a finding. What is as
// loud as --fail-on fails; the rest passes and says what it is. tests/report/junit.xsd has the
// shape.
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "report/safe_text.hpp"
#include "report/wording.hpp"
#include "report/writers.hpp"

namespace gltfx::report {
namespace {

// Neutralised text for an element or a quoted attribute. XML has no way at all to name a control
// character or U+FFFE and U+FFFF: they become visible escapes of our own.
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

class JunitWriter final : public ReportWriter {
 public:
  explicit JunitWriter(const FormatOptions& options) : options_(options) {}

  void begin(std::string& out) override {
    out += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"gltfx\">\n";
  }

  void file(const FileReport& report, std::string& out) override {
    const std::string path = xml(report.path);
    begin_suite(report, path, out);
    for (const Diagnostic& finding : report.diagnostics) test(report, path, finding, out);
    if (report.diagnostics.empty()) {
      out += fmt::format("    <testcase classname=\"{0}\" name=\"valid\" file=\"{0}\"/>\n", path);
    }
    if (report.truncated) {
      out += fmt::format("    <system-out>{}</system-out>\n", xml(truncation_note(report)));
    }
    out += "  </testsuite>\n";
  }

  void end(const RunSummary&, std::string& out) override { out += "</testsuites>\n"; }

 private:
  bool fails(const Diagnostic& finding) const {
    return options_.fail_on && finding.severity <= *options_.fail_on;
  }

  void begin_suite(const FileReport& report, std::string_view path, std::string& out) const {
    std::size_t failures = 0;
    for (const Diagnostic& finding : report.diagnostics) failures += fails(finding) ? 1U : 0U;
    const std::size_t tests = report.diagnostics.empty() ? 1 : report.diagnostics.size();
    out += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"0\">\n",
        path, tests, report.readable ? failures : 0,
        report.readable ? 0 : report.diagnostics.size());
    out += fmt::format(
        "    <properties>\n"
        "      <property name=\"profile\" value=\"{}\"/>\n"
        "      <property name=\"pixels\" value=\"{}\"/>\n"
        "    </properties>\n",
        xml(options_.profile), xml(options_.pixel_level));
  }

  void test(const FileReport& report, std::string_view path, const Diagnostic& finding,
            std::string& out) const {
    out += fmt::format("    <testcase classname=\"{0}\" name=\"{1}{2}\" file=\"{0}\"", path,
                       xml(finding.code), xml(document_place(finding)));
    if (finding.location.line > 0 && report.mime_type != "model/gltf-binary") {
      out += fmt::format(" line=\"{}\"", finding.location.line);
    }
    out += ">\n";
    const std::string text = xml_text(report, finding);
    if (report.readable && !fails(finding)) {
      out += fmt::format("      <system-out>{}</system-out>\n", text);
    } else {
      const std::string_view element = report.readable ? "failure" : "error";
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
};

}  // namespace

std::unique_ptr<ReportWriter> make_junit_writer(const FormatOptions& options) {
  return std::make_unique<JunitWriter>(options);
}

}  // namespace gltfx::report
