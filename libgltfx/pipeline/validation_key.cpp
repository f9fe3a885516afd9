// SPDX-License-Identifier: Apache-2.0
#include "pipeline/validation_key.hpp"

#include <gltfx/version.hpp>

#include <filesystem>

#include "base/build_id.hpp"
#include "schema/set.hpp"

namespace gltfx {
namespace {

void add(HashParts& parts, const Budgets& budgets) {
  const auto& [texture_size, total_pixels, triangles, draw_calls, file_size] = budgets;
  for (const std::uint64_t limit : {texture_size, total_pixels, triangles, draw_calls, file_size}) {
    parts.add(limit);
  }
}

template <class Names>
void add_names(HashParts& parts, const Names& names) {
  parts.add(std::uint64_t{names.size()});
  for (const auto& name : names) parts.add(name);
}

}  // namespace

// Taken apart by name: a member that is added to the options has to be decided upon here.
Hash128 validation_key(const ValidateOptions& options, const std::string& folder) {
  const auto& [profile, pixels, budgets, lfs, inline_suppressions, root, max_issues, changed_lines,
               propose_fixes, jobs, select, ignore, severity, schemas, cache] = options;
  // The same report comes of any number of threads, with and without cache; with lines that changed
  // nothing is kept.
  static_cast<void>(changed_lines);
  static_cast<void>(jobs);
  static_cast<void>(cache);
  HashParts parts;
  parts.add(version());
  parts.add(build_id());
  parts.add(static_cast<std::uint64_t>(profile));
  parts.add(static_cast<std::uint64_t>(pixel_level(options)));
  static_cast<void>(pixels);
  add(parts, budgets);
  parts.add(static_cast<std::uint64_t>(lfs));
  parts.add(std::uint64_t{inline_suppressions});
  parts.add(root.empty() ? root
                         : (std::filesystem::path(folder) / root).lexically_normal().native());
  parts.add(max_issues);
  parts.add(std::uint64_t{propose_fixes});
  add_names(parts, select);
  add_names(parts, ignore);
  parts.add(std::uint64_t{severity.size()});
  for (const auto& [code, level] : severity) {
    parts.add(code);
    parts.add(static_cast<std::uint64_t>(level));
  }
  parts.add(schemas ? schemas->sources() : Hash128());
  return parts.finish();
}

}  // namespace gltfx
