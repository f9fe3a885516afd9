// SPDX-License-Identifier: Apache-2.0
#include "pipeline/new_error.hpp"

#include <cstdint>
#include <map>

#include "validate/validator.hpp"

namespace gltfx {
namespace {

using ErrorCounts = std::map<std::string_view, std::uint64_t>;

ErrorCounts errors_of(const Checked& asset, const std::string& path,
                      const std::shared_ptr<const schema::Set>& schemas) {
  ValidateOptions options;
  options.jobs = 1;
  options.schemas = schemas;
  ErrorCounts counts;
  for (const Diagnostic& one :
       validate::validate(asset.container, path, asset.resolver, options).diagnostics) {
    if (one.severity == Severity::error) counts[one.code] += one.count;
  }
  return counts;
}

}  // namespace

std::optional<std::string_view> new_error(const Checked& before, const Checked& after,
                                          const std::string& path,
                                          const std::shared_ptr<const schema::Set>& schemas) {
  const ErrorCounts found = errors_of(after, path, schemas);
  if (found.empty()) return std::nullopt;
  const ErrorCounts known = errors_of(before, path, schemas);
  for (const auto& [code, count] : found) {
    const auto was = known.find(code);
    if (was == known.end() || was->second < count) return code;
  }
  return std::nullopt;
}

}  // namespace gltfx
