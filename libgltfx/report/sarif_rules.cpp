// SPDX-License-Identifier: Apache-2.0
#include <gltfx/version.hpp>

#include <fmt/format.h>

#include "base/text.hpp"
#include "report/rule_lookup.hpp"
#include "report/safe_text.hpp"
#include "report/sarif_parts.hpp"

namespace gltfx::report {
namespace {

constexpr std::string_view kSpecification =
    "https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html";
constexpr std::string_view kBinary = "base64:";

// With a fence longer than any in the text, so that the text cannot end the block.
std::string code_block(std::string_view text) {
  if (text.substr(0, kBinary.size()) == kBinary) return "(a binary file)\n";
  std::string fence = "```";
  while (text.find(fence) != std::string_view::npos) fence += '`';
  return fmt::format("{0}json\n{1}\n{0}\n", fence, text);
}

std::string help_markdown(const RuleDescription& rule) {
  std::string text = fmt::format("{}\n\n**How to fix it:** {}\n", rule.why, rule.help);
  if (!rule.bad.empty()) text += "\nAn asset that raises it:\n\n" + code_block(rule.bad);
  if (!rule.good.empty()) text += "\nThe same asset, fixed:\n\n" + code_block(rule.good);
  return text;
}

// The page of the rule if the build has its address, else the section of the specification. A
// own rule has the link of its page.
std::string help_uri(const RuleDescription& rule) {
  if (rule.own) return std::string(rule.link);
  constexpr std::string_view kDocs = GLTFX_DOCS_URL;
  if (!kDocs.empty()) return fmt::format("{}/schema/rules/{}.md", kDocs, rule.code);
  return std::string(rule.link.empty() ? kSpecification : rule.link);
}

// "UNUSED_OBJECT" as "UnusedObject".
std::string friendly_name(std::string_view code) {
  std::string name;
  bool first = true;
  for (const char c : code) {
    if (c != '_') name += first ? c : ascii_lower(c);
    first = c == '_';
  }
  return name;
}

void write_text(json::Writer& writer, std::string_view name, std::string_view text) {
  writer.key(name);
  writer.begin_object();
  writer.member("text", text);
  writer.end_object();
}

// Escapes "[text](target)" so that it is not a link.
std::string literal(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '{' || text[i] == '}') out += text[i];
    if (text[i] == ']' && i + 1 < text.size() && text[i + 1] == '(') out += '\\';
    out += text[i];
  }
  return out;
}

}  // namespace

std::string_view sarif_level(Severity severity) {
  if (severity == Severity::error) return "error";
  return severity == Severity::warning ? "warning" : "note";
}

void write_sarif_message(json::Writer& writer, std::string_view text) {
  writer.begin_object();
  writer.member("text", literal(safe(text)));
  writer.end_object();
}

std::uint64_t SarifRules::index_of(std::string_view code, Severity severity) {
  const auto [entry, fresh] = positions_.try_emplace(code, met_.size());
  if (fresh) met_.push_back({code, severity});
  return entry->second;
}

void SarifRules::write_rule(json::Writer& writer, const Met& met) const {
  const RuleDescription* rule = find_rule_in(all_, met.code);
  writer.begin_object();
  writer.member("id", met.code);
  if (rule != nullptr) {
    writer.member("name", friendly_name(met.code));
    write_text(writer, "shortDescription", fmt::format("{}.", rule->summary));
    write_text(writer, "fullDescription", rule->why);
    writer.key("help");
    writer.begin_object();
    writer.member("text", rule->help);
    writer.member("markdown", help_markdown(*rule));
    writer.end_object();
    const std::string uri = help_uri(*rule);
    if (!uri.empty()) writer.member("helpUri", uri);
  }
  writer.key("defaultConfiguration");
  writer.begin_object();
  writer.member("level", sarif_level(rule != nullptr ? rule->severity : met.severity));
  writer.end_object();
  writer.end_object();
}

void SarifRules::write_tool(std::string& out) const {
  const std::size_t from = out.size();
  json::Writer writer(out);
  writer.begin_object();
  writer.key("driver");
  writer.begin_object();
  writer.member("name", "gltfx");
  writer.member("semanticVersion", version());
  writer.member("informationUri", kSpecification);
  writer.key("rules");
  writer.begin_array();
  for (const Met& met : met_) {
    out += '\n';
    write_rule(writer, met);
  }
  writer.end_array();
  writer.end_object();
  writer.end_object();
  defuse_json(out, from);
}

}  // namespace gltfx::report
