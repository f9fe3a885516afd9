// SPDX-License-Identifier: Apache-2.0
#include "prove/findings.hpp"

#include <set>
#include <utility>

#include <fmt/format.h>

#include "rules/validator.hpp"

namespace gltfx::prove {
namespace {

// Without findings of a severity below warning.
FileReport serious_findings(std::vector<Diagnostic> found) {
  FileReport report;
  report.diagnostics = std::move(found);
  std::erase_if(report.diagnostics,
                [](const Diagnostic& one) { return one.severity > Severity::warning; });
  return report;
}

// Validates with default options.
FileReport serious_findings(const model::OpenedAsset& opened,
                            const std::shared_ptr<const schema::Set>& schemas) {
  model::OpenedAsset again(opened.name(), opened.container(), opened.resolver());
  return serious_findings(validate::validate(again, default_validation(schemas)).diagnostics);
}

FileReport serious_findings(const validate::ValidatedAsset& asset,
                            const std::shared_ptr<const schema::Set>& schemas) {
  return asset.validated_by_default() ? serious_findings(asset.report().diagnostics)
                                      : serious_findings(asset.asset(), schemas);
}

/// Places of findings by code.
using Places = std::set<std::pair<std::string_view, std::string_view>>;

// The warning to show for a code: one at a new place, if possible.
std::string text_of(const MoreFindings& more, const FileReport& after, const Places& known) {
  const Diagnostic* shown = nullptr;
  for (const Diagnostic& one : after.diagnostics) {
    if (one.code != more.code) continue;
    const bool is_new = !known.contains({one.code, one.pointer});
    if (shown == nullptr || is_new) shown = &one;
    if (is_new) break;
  }
  std::string text = fmt::format("{} at {}: {}", more.code, shown->pointer, shown->message);
  if (more.count > 1) text += fmt::format(" (and {} more)", more.count - 1);
  return text;
}

}  // namespace

FindingCounts::FindingCounts(const FileReport& report) {
  for (const Diagnostic& one : report.diagnostics) {
    Counts& counts = codes_[one.code];
    for (auto i = static_cast<std::size_t>(one.severity); i < counts.size(); ++i) {
      counts[i] += one.count;
    }
  }
}

std::vector<MoreFindings> more_findings(const FindingCounts& before, const FileReport& after,
                                        Severity least) {
  std::vector<MoreFindings> worse;
  for (const auto& [code, now] : FindingCounts(after).codes_) {
    const auto known = before.codes_.find(code);
    const auto was = known == before.codes_.end() ? FindingCounts::Counts() : known->second;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(least); ++i) {
      if (now[i] <= was[i]) continue;
      worse.push_back({code, static_cast<Severity>(i), now[i] - was[i]});
      break;
    }
  }
  return worse;
}

ValidateOptions default_validation(const std::shared_ptr<const schema::Set>& schemas) {
  ValidateOptions options;
  options.jobs = 1;
  options.schemas = schemas;
  return options;
}

namespace {

NewFindings compare(const FileReport& known, const FileReport& found) {
  Places places;
  for (const Diagnostic& one : known.diagnostics) places.emplace(one.code, one.pointer);
  NewFindings result;
  for (const MoreFindings& more : more_findings(FindingCounts(known), found, Severity::warning)) {
    if (more.severity != Severity::error) {
      result.warnings.push_back(text_of(more, found, places));
    } else if (result.error.empty()) {
      result.error = more.code;
    }
  }
  return result;
}

template <class Before>
NewFindings find_new(const Before& before, const validate::ValidatedAsset& after,
                     const std::shared_ptr<const schema::Set>& schemas) {
  const FileReport found = serious_findings(after, schemas);
  return found.diagnostics.empty() ? NewFindings()
                                   : compare(serious_findings(before, schemas), found);
}

}  // namespace

NewFindings new_findings(const validate::ValidatedAsset& before,
                         const validate::ValidatedAsset& after,
                         const std::shared_ptr<const schema::Set>& schemas) {
  return find_new(before, after, schemas);
}

NewFindings new_findings(const model::OpenedAsset& before, const validate::ValidatedAsset& after,
                         const std::shared_ptr<const schema::Set>& schemas) {
  return find_new(before, after, schemas);
}

}  // namespace gltfx::prove
