// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "json/writer.hpp"
#include "option_rows.hpp"
#include "output.hpp"
#include "own_pages.hpp"
#include "report/wording.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

void write_rule(json::Writer& writer, const RuleDescription& rule) {
  writer.begin_object();
  writer.member("code", rule.code);
  writer.member("severity", severity_name(rule.severity));
  if (!rule.group.empty()) writer.member("group", rule.group);
  writer.member("summary", rule.summary);
  writer.member("why", rule.why);
  writer.member("help", rule.help);
  writer.member("section", rule.section);
  writer.member("link", rule.link);
  writer.member("bad", rule.bad);
  writer.member("good", rule.good);
  writer.member("fix", fix_name(rule.fix));
  if (!rule.fix_does.empty()) {
    writer.member("fixDoes", rule.fix_does);
    writer.member("fixed", rule.fixed);
  }
  writer.member("khronos", rule.khronos);
  writer.member("pixels", rule.pixels);
  writer.member("picture", rule.picture);
  writer.member("own", rule.own);
  writer.end_object();
}

std::string rules_json(const OwnRules* own) {
  std::string text;
  json::Writer writer(text, true);
  writer.begin_object();
  writer.key("rules");
  writer.begin_array();
  for (const RuleDescription& rule : rules(own)) write_rule(writer, rule);
  writer.end_array();
  writer.end_object();
  return text + '\n';
}

std::string rules_text(const OwnRules* own, const Style& style) {
  std::size_t width = 0;
  std::size_t shared = 0;
  for (const RuleDescription& rule : rules(own)) {
    width = std::max(width, rule.code.size());
    if (rule.khronos) ++shared;
  }
  std::string text;
  for (const RuleDescription& rule : rules(own)) {
    text += fmt::format("{}  {}  {}{}\n", padded(rule.code, width),
                        style.severity(rule.severity, padded(severity_name(rule.severity), 7)),
                        printable(rule.summary),
                        rule.group.empty() ? "" : fmt::format(" ({})", rule.group));
  }
  const std::size_t more = rules(own).size() - rules().size();
  text += fmt::format(
      "\n{} rules, {} of them under the name they have in the Khronos validator{}. "
      "'gltfx explain CODE' says more. "
      "Options take the name of a group, which is in brackets, for all of its codes.\n",
      rules(own).size(), shared, more == 0 ? "" : fmt::format(", and {} of them own", more));
  return text;
}

// The path without ".md", which may be left out.
ExitCode write_page(const std::string& named, const std::string& on) {
  namespace fs = std::filesystem;
  fs::path path = named;
  if (path.extension() == ".md") path.replace_extension();
  const std::string code = path.filename().native();
  const std::string kind = on.empty() ? "node" : on;
  const std::string text = own_rule_template(code, kind);
  const auto kinds = own_rule_scopes();
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
    complain(unknown_word("--on", kind, kinds).message);
    return ExitCode::usage;
  }
  if (text.empty() || find_rule(code) != nullptr) {
    complain(fmt::format("--new: {} {}; write PREFIX_NAME in capitals, as in ACME_NODE_NAME.",
                         gltfx::quoted(code),
                         text.empty() ? "is not a code" : "is a rule of gltfx"));
    return ExitCode::usage;
  }
  path += ".md";
  std::error_code error;
  if (fs::exists(fs::symlink_status(path, error))) {
    complain(fmt::format("--new: {} exists", gltfx::quoted(path.native(), 200)));
    return ExitCode::usage;
  }
  Output output(path.native());
  output.write(text);
  output.finish();
  if (!output.problem().empty()) {
    complain(output.problem());
    return ExitCode::internal;
  }
  return print(fmt::format("{0} is written. To test it: gltfx rules --test {0}\n",
                           printable(path.native())));
}

ExitCode test_pages(const std::vector<std::string>& paths) {
  OwnPages pages;
  if (const auto mistake = pages.read(paths)) {
    complain("--test: " + mistake->message);
    return ExitCode::usage;
  }
  const OwnRuleTests tests = test_own_rules(pages.all());
  std::string text;
  for (const std::string& failure : tests.failures) text += printable(failure) + '\n';
  for (const std::string& note : tests.notes) {
    text += fmt::format("note: {}\n", printable(note));
  }
  text += fmt::format("{}: {} passed, {} failed\n", report::counted(tests.examples / 2, "rule"),
                      report::counted(tests.examples - tests.failures.size(), "example"),
                      tests.failures.size());
  const ExitCode printed = print(text);
  return printed == ExitCode::ok && !tests.failures.empty() ? ExitCode::findings : printed;
}

}  // namespace

ExitCode run(const RulesRequest& request) {
  if (!request.tests.empty()) return test_pages(request.tests);
  if (!request.new_page.empty()) return write_page(request.new_page, request.new_on);
  const OwnRules* const own = request.own_rules.get();
  if (request.format == TableFormat::json) return print(rules_json(own));
  return print(rules_text(own, Style(colors_on_stdout(request.common.color))));
}

}  // namespace gltfx::tool
