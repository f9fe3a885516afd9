// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "commands.hpp"
#include "json/writer.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

void write_rule(json::Writer& writer, const RuleDescription& rule) {
  writer.begin_object();
  writer.member("code", rule.code);
  writer.member("severity", severity_name(rule.severity));
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
  writer.end_object();
}

std::string rules_json() {
  std::string text;
  json::Writer writer(text, true);
  writer.begin_object();
  writer.key("rules");
  writer.begin_array();
  for (const RuleDescription& rule : rules()) write_rule(writer, rule);
  writer.end_array();
  writer.end_object();
  return text + '\n';
}

std::string rules_text(const Style& style) {
  std::size_t width = 0;
  std::size_t shared = 0;
  for (const RuleDescription& rule : rules()) {
    width = std::max(width, rule.code.size());
    if (rule.khronos) ++shared;
  }
  std::string text;
  for (const RuleDescription& rule : rules()) {
    text += fmt::format("{}  {}  {}\n", padded(rule.code, width),
                        style.severity(rule.severity, padded(severity_name(rule.severity), 7)),
                        rule.summary);
  }
  text += fmt::format(
      "\n{} rules, {} of them under the name they have in the Khronos validator. "
      "'gltfx explain CODE' says more.\n",
      rules().size(), shared);
  return text;
}

}  // namespace

ExitCode run(const RulesRequest& request) {
  if (request.format == TableFormat::json) return print(rules_json());
  return print(rules_text(Style(colors_on_stdout(request.common.color))));
}

}  // namespace gltfx::tool
