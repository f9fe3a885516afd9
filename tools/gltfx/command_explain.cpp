// SPDX-License-Identifier: Apache-2.0
#include <gltfx/compare.hpp>
#include <gltfx/pipeline.hpp>

#include <memory>
#include <string>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

constexpr std::string_view kBinary = "base64:";
constexpr std::size_t kIndent = 2;

std::string example_text(std::string_view example) {
  if (!example.starts_with(kBinary)) return indented(example, kIndent + 2);
  return fmt::format("    (a binary file of {} bytes)\n", example_bytes(example).size());
}

// The output of `gltfx validate` for an example.
std::string verdict_on(const RuleDescription& rule, const std::shared_ptr<const OwnRules>& own,
                       bool color) {
  FormatOptions format;
  format.color = color;
  format.quiet = true;
  format.command = "gltfx";
  format.rules = rules(own.get());
  const FileReport report = validate_example(rule, Example::bad, own);
  const auto writer = make_report_writer(ReportFormat::text, format);
  std::string text;
  writer->begin(text);
  writer->file(report, text);
  RunSummary summary;
  summary.add(report);
  writer->end(summary, text);
  return text;
}

std::string way_to_fix(const RuleDescription& rule) {
  switch (rule.fix) {
    case Fix::none:
      return "by hand";
    case Fix::safe:
      return "'gltfx fix' does it; picture, animation and names stay";
    case Fix::upgrade:
      return "'gltfx upgrade' does it; the picture stays";
    case Fix::unsafe:
      break;
  }
  return fmt::format("'gltfx fix --unsafe --only {}' does it, with a loss", rule.code);
}

std::string explanation(const RuleDescription& rule, const std::shared_ptr<const OwnRules>& own,
                        bool color) {
  const Style style(color);
  std::string text;
  const auto heading = [&](std::string_view title) {
    text += '\n' + std::string(kIndent, ' ') + style.bold(title) + '\n';
  };
  text += fmt::format("{} ({}): {}.\n", style.bold(rule.code),
                      style.severity(rule.severity, severity_name(rule.severity)), rule.summary);
  heading("Why it matters");
  text += wrapped(rule.why, kIndent + 2);
  heading("How to fix it");
  text += wrapped(rule.help, kIndent + 2);
  heading("Bad");
  text += example_text(rule.bad);
  heading("Reported as");
  text += indented(verdict_on(rule, own, color), kIndent + 2);
  heading("Good");
  text += rule.good == rule.bad ? "    the same asset with a limit that it meets\n"
                                : example_text(rule.good);
  if (!rule.fix_does.empty()) {
    heading("What the fix does");
    text += wrapped(rule.fix_does, kIndent + 2);
    heading("Fixed");
    text += example_text(rule.fixed);
  }
  heading("See also");
  if (rule.own) {
    if (!rule.link.empty()) text += fmt::format("    {}\n", printable(rule.link));
    return text + "    an own rule, which no program fixes\n";
  }
  if (!rule.section.empty()) text += fmt::format("    {}: {}\n", rule.section, rule.link);
  text += fmt::format("    fix: {}\n", way_to_fix(rule));
  if (!rule.picture) text += "    gltfx bake draws no asset with this error\n";
  text += rule.khronos ? "    the Khronos validator has the same code\n"
                       : "    the Khronos validator has no such code\n";
  return text;
}

}  // namespace

ExitCode run(const ExplainRequest& request) {
  const bool color = colors_on_stdout(request.common.color);
  ExitCode code = ExitCode::ok;
  std::string text;
  for (const std::string& name : request.codes) {
    const RuleDescription* rule = rule_from_user(name, request.own_rules.get());
    if (const ChangeKind* kind = rule == nullptr ? find_change_kind(name) : nullptr) {
      text +=
          fmt::format("{}: a change that 'gltfx compare' tells: {}.\n", kind->name, kind->meaning);
      continue;
    }
    if (rule == nullptr) {
      complain(fmt::format("explain: there is no rule {}.{} 'gltfx rules' lists them all.",
                           gltfx::quoted(name), suggest_code(name, request.own_rules.get())));
      code = ExitCode::usage;
      continue;
    }
    if (!text.empty()) text += '\n';
    text += explanation(*rule, request.own_rules, color);
  }
  return worse(code, print(text));
}

}  // namespace gltfx::tool
