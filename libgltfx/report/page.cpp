// SPDX-License-Identifier: Apache-2.0
// The data of the page: everything from assets is in one block of JSON, in which no '<' is left
// that could end it.
#include <gltfx/page.hpp>
#include <gltfx/version.hpp>

#include <algorithm>

#include "json/writer.hpp"
#include "report/facts_json.hpp"
#include "report/page_parts.hpp"
#include "report/page_requirements.hpp"
#include "report/page_source.hpp"
#include "report/read_line.hpp"
#include "report/rule_lookup.hpp"

namespace gltfx {
namespace {

using json::Writer;

constexpr std::size_t kMostOfAKind = 12;   // listed meshes, images and so on of an asset
constexpr std::size_t kMostUpgrades = 50;  // legacy objects
// Several assets may have the same external asset.
constexpr std::size_t kMostExternal = 100, kMostOfExternal = 50;

void member_if(Writer& writer, std::string_view name, const std::string& text) {
  if (!text.empty()) writer.member(name, text);
}

void write_counts(Writer& writer, const Counts& counts) {
  writer.member("errors", counts.errors);
  writer.member("warnings", counts.warnings);
  writer.member("infos", counts.infos);
  writer.member("hints", counts.hints);
}

void write_excerpt(Writer& writer, const Excerpt& excerpt) {
  writer.key("excerpt");
  writer.begin_object();
  writer.member("text", excerpt.text);
  writer.member("caret", std::uint64_t{excerpt.caret});
  writer.member("width", std::uint64_t{excerpt.width});
  if (excerpt.cut_left) writer.member("cutLeft", true);
  if (excerpt.cut_right) writer.member("cutRight", true);
  writer.end_object();
}

void write_finding(Writer& writer, const Diagnostic& finding) {
  writer.begin_object();
  writer.member("code", finding.code);
  writer.member("severity", severity_name(finding.severity));
  writer.member("message", finding.message);
  member_if(writer, "help", finding.help);
  if (finding.fixable) writer.member("fixable", true);
  member_if(writer, "pointer", finding.pointer);
  member_if(writer, "object", finding.object_name);
  if (finding.offset) writer.member("offset", *finding.offset);
  if (finding.location.line > 0) {
    writer.member("line", std::uint64_t{finding.location.line});
    writer.member("column", std::uint64_t{finding.location.column});
  }
  if (finding.excerpt.width > 0) write_excerpt(writer, finding.excerpt);
  if (finding.count > 1) {
    writer.member("count", finding.count);
    writer.member("lastPointer", finding.last_pointer);
  }
  writer.end_object();
}

void write_picture(Writer& writer, std::string_view name, const PagePicture& picture) {
  writer.key(name);
  writer.begin_object();
  if (!picture.uri.empty()) {
    writer.member("src", picture.uri);
    writer.member("size", std::uint64_t{picture.size});
  }
  member_if(writer, "problem", picture.problem);
  writer.end_object();
}

void write_upgrade(Writer& writer, const InspectReport& inspection) {
  const auto& all = inspection.upgrade;
  const std::size_t shown = std::min(all.size(), kMostUpgrades);
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(shown);
  writer.key("upgrade");
  report::write_upgrade_facts(writer, std::vector<UpgradeFact>(all.begin(), end));
  if (all.size() > shown) writer.member("upgradeOmitted", std::uint64_t{all.size() - shown});
  member_if(writer, "upgradeProblem", inspection.upgrade_problem);
}

// What a report says, with the first findings.
void write_report(Writer& writer, const FileReport& report, std::size_t most) {
  writer.member("path", report.path);
  writer.member("readable", report.readable);
  writer.key("counts");
  writer.begin_object();
  write_counts(writer, report.counts);
  writer.end_object();
  if (report.truncated) writer.member("truncated", true);
  writer.member("suppressed", report.suppressed);
  writer.member("leftOut", report.left_out);
  writer.member("unverified", report.unverified);
  writer.key("findings");
  writer.begin_array();
  const std::size_t shown = std::min(report.diagnostics.size(), most);
  for (std::size_t i = 0; i < shown; ++i) write_finding(writer, report.diagnostics[i]);
  writer.end_array();
  if (shown < report.diagnostics.size()) {
    writer.member("findingsOmitted", std::uint64_t{report.diagnostics.size() - shown});
  }
}

void write_external_assets(Writer& writer, const std::vector<FileReport>& all) {
  if (all.empty()) return;
  const std::size_t shown = std::min(all.size(), kMostExternal);
  writer.key("externalAssets");
  writer.begin_array();
  for (std::size_t i = 0; i < shown; ++i) {
    writer.begin_object();
    write_report(writer, all[i], kMostOfExternal);
    writer.end_object();
  }
  writer.end_array();
  if (all.size() > shown) writer.member("externalAssetsOmitted", std::uint64_t{all.size() - shown});
}

void write_asset(Writer& writer, const PageAsset& asset, bool with_position) {
  const FileReport& report = asset.report;
  writer.begin_object();
  if (with_position) writer.member("position", report.position);
  write_report(writer, report, report.diagnostics.size());
  write_external_assets(writer, report.external_assets);
  if (!report.requirements.empty()) {
    writer.key("requirements");
    report::write_page_requirements(writer, report.requirements, asset.previous);
  }
  if (report.unlisted_requirements > 0) {
    writer.member("unlistedRequirements", report.unlisted_requirements);
  }
  member_if(writer, "error", asset.inspection.error);
  if (asset.inspection.facts) {
    writer.key("facts");
    report::write_facts(writer, *asset.inspection.facts, kMostOfAKind);
  }
  write_upgrade(writer, asset.inspection);
  write_picture(writer, "picture", asset.picture);
  if (asset.upgraded) write_picture(writer, "upgraded", *asset.upgraded);
  writer.end_object();
}

void write_rule(Writer& writer, const RuleDescription& rule) {
  writer.begin_object();
  writer.member("summary", rule.summary);
  writer.member("why", rule.why);
  writer.member("help", rule.help);
  if (!rule.group.empty()) writer.member("group", rule.group);
  writer.end_object();
}

void write_shard(Writer& writer, const PageOptions& options) {
  writer.key("shard");
  writer.begin_object();
  writer.member("index", std::uint64_t{options.shard.index});
  writer.member("count", std::uint64_t{options.shard.count});
  writer.member("failOn", options.fail_on ? severity_name(*options.fail_on) : report::kNever);
  writer.end_object();
}

// The data after the assets.
std::string tail_of(const std::set<std::string_view>& codes, const std::set<std::string>& targets,
                    std::span<const RuleDescription> rules, const RunSummary& summary) {
  std::string json;
  Writer writer(json);
  writer.begin_object();
  writer.key("rules");
  writer.begin_object();
  for (const std::string_view code : codes) {
    const RuleDescription* rule = report::find_rule_in(rules, code);
    if (rule == nullptr) continue;
    writer.key(code);
    write_rule(writer, *rule);
  }
  writer.end_object();
  writer.key("targets");
  writer.begin_array();
  for (const std::string& label : targets) writer.string(label);
  writer.end_array();
  writer.key("summary");
  writer.begin_object();
  writer.member("files", summary.files);
  writer.member("filesWithErrors", summary.files_with_errors);
  writer.member("unreadable", summary.unreadable);
  write_counts(writer, summary.counts);
  writer.end_object();
  writer.end_object();
  std::string out = "\n],\n";
  report::append_page_json(out, json.substr(1));
  return out.append(report::page_end());
}

}  // namespace

void PageWriter::begin(std::string& out) const {
  out += report::page_begin();
  std::string json;
  Writer writer(json);
  writer.begin_object();
  writer.member("gltfx", version());
  writer.member("title", options_.title);
  writer.member("profile", options_.profile);
  writer.member("pixels", options_.pixel_level);
  if (options_.shard.count > 1) write_shard(writer, options_);
  writer.key("assets");
  report::append_page_json(out, json);
  out += "[";
}

void PageWriter::asset(const PageAsset& asset, std::string& out) {
  const FileReport& report = asset.report;
  for (const Diagnostic& finding : report.diagnostics) codes_.insert(finding.code);
  const std::size_t listed = std::min(report.external_assets.size(), kMostExternal);
  for (std::size_t i = 0; i < listed; ++i) {
    const auto& findings = report.external_assets[i].diagnostics;
    const std::size_t shown = std::min(findings.size(), kMostOfExternal);
    for (std::size_t k = 0; k < shown; ++k) codes_.insert(findings[k].code);
  }
  targets_.insert(asset.targets.begin(), asset.targets.end());
  out += has_assets_ ? ",\n" : "\n";
  has_assets_ = true;
  std::string json;
  Writer writer(json);
  write_asset(writer, asset, options_.shard.count > 1);
  report::append_page_json(out, json);
}

void PageWriter::end(const RunSummary& summary, std::string& out) const {
  out += tail_of(codes_, targets_, options_.rules, summary);
}

std::string report::page_tail(const std::set<std::string_view>& codes,
                              const std::set<std::string>& targets,
                              std::span<const RuleDescription> rules, const RunSummary& summary) {
  return tail_of(codes, targets, rules, summary);
}

}  // namespace gltfx
