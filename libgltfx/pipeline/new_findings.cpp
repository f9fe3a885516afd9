// SPDX-License-Identifier: Apache-2.0
#include "pipeline/new_findings.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "rules/validator.hpp"

namespace gltfx {
namespace {

using ByCode = std::map<std::string_view, std::uint64_t>;
using Diagnostics = std::vector<Diagnostic>;

Diagnostics serious_findings(const FileReport& report) {
  Diagnostics found = report.diagnostics;
  std::erase_if(found, [](const Diagnostic& one) { return one.severity > Severity::warning; });
  return found;
}

Diagnostics serious_findings(const model::OpenedAsset& opened,
                             const std::shared_ptr<const schema::Set>& schemas) {
  model::OpenedAsset again(opened.name(), opened.container(), opened.resolver());
  return serious_findings(validate::validate(again, default_validation(schemas)));
}

Diagnostics serious_findings(const validate::ValidatedAsset& asset,
                             const std::shared_ptr<const schema::Set>& schemas) {
  if (asset.validated_by_default()) return serious_findings(asset.report());
  return serious_findings(asset.asset(), schemas);
}

ByCode count_by_code(const Diagnostics& findings, Severity severity) {
  ByCode counts;
  for (const Diagnostic& one : findings) {
    if (one.severity == severity) counts[one.code] += one.count;
  }
  return counts;
}

// By code, how many more there are than before.
ByCode more(const Diagnostics& before, const Diagnostics& after, Severity severity) {
  ByCode counts = count_by_code(after, severity);
  const ByCode known = count_by_code(before, severity);
  for (auto at = counts.begin(); at != counts.end();) {
    const auto was = known.find(at->first);
    const std::uint64_t old = was == known.end() ? 0 : was->second;
    at->second -= std::min(at->second, old);
    at = at->second == 0 ? counts.erase(at) : std::next(at);
  }
  return counts;
}

std::vector<std::string> warnings_of(const Diagnostics& before, const Diagnostics& after) {
  std::set<std::pair<std::string_view, std::string_view>> places;
  for (const Diagnostic& one : before) places.emplace(one.code, one.pointer);
  std::vector<std::string> texts;
  for (const auto& [code, count] : more(before, after, Severity::warning)) {
    const Diagnostic* shown = nullptr;
    for (const Diagnostic& one : after) {
      if (one.code != code) continue;
      const bool is_new = places.count({one.code, one.pointer}) == 0;
      if (shown == nullptr || is_new) shown = &one;
      if (is_new) break;
    }
    texts.push_back(fmt::format("{} at {}: {}", code, shown->pointer, shown->message));
    if (count > 1) texts.back() += fmt::format(" (and {} more)", count - 1);
  }
  return texts;
}

NewFindings compare(const Diagnostics& known, const Diagnostics& found) {
  const ByCode errors = more(known, found, Severity::error);
  return {errors.empty() ? std::string_view() : errors.begin()->first, warnings_of(known, found)};
}

}  // namespace

ValidateOptions default_validation(const std::shared_ptr<const schema::Set>& schemas) {
  ValidateOptions options;
  options.jobs = 1;
  options.schemas = schemas;
  return options;
}

NewFindings new_findings(const validate::ValidatedAsset& before,
                         const validate::ValidatedAsset& after,
                         const std::shared_ptr<const schema::Set>& schemas) {
  const Diagnostics found = serious_findings(after, schemas);
  if (found.empty()) return {};
  return compare(serious_findings(before, schemas), found);
}

NewFindings new_findings(const model::OpenedAsset& before, const validate::ValidatedAsset& after,
                         const std::shared_ptr<const schema::Set>& schemas) {
  const Diagnostics found = serious_findings(after, schemas);
  if (found.empty()) return {};
  return compare(serious_findings(before, schemas), found);
}

}  // namespace gltfx
