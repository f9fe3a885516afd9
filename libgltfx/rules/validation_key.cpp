// SPDX-License-Identifier: Apache-2.0
#include "rules/validation_key.hpp"

#include <gltfx/version.hpp>

#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/bit_cast.hpp"
#include "base/build_id.hpp"
#include "rules/own/own_rules.hpp"
#include "schema/set.hpp"

namespace gltfx {
namespace {

template <class Names>
void add_names(HashParts& parts, const Names& names) {
  parts.add(std::uint64_t{names.size()});
  for (const auto& name : names) parts.add(name);
}

void add(HashParts& parts, double number) { parts.add(bit_cast<std::uint64_t>(number)); }

void add(HashParts& parts, const Limit& limit) {
  const auto& [measure, on, op, number, flag, texts, severity, parameters, from, note] = limit;
  parts.add(measure->code);
  for (const auto choice : {static_cast<std::uint64_t>(on), static_cast<std::uint64_t>(op),
                            std::uint64_t{flag}, static_cast<std::uint64_t>(severity)}) {
    parts.add(choice);
  }
  add(parts, number);
  add_names(parts, texts);
  const auto& [weld, angle, at, slot, product] = parameters;
  add(parts, weld);
  add(parts, angle);
  parts.add(std::uint64_t{at});
  parts.add(slot);
  for (const double size : product) add(parts, size);
  parts.add(from);
  parts.add(note);
}

void add(HashParts& parts, const std::vector<TargetRange>& ranges) {
  parts.add(std::uint64_t{ranges.size()});
  for (const TargetRange& range : ranges) {
    parts.add(std::uint64_t{range.first});
    parts.add(std::uint64_t{range.last});
    parts.add(static_cast<std::uint64_t>(range.outcome));
  }
}

// A user's own target says what its file says.
void add(HashParts& parts, const TargetChoice& choice) {
  parts.add(choice.label());
  parts.add(std::uint64_t{choice.version});
  for (const auto& [name, feature] : choice.target->features) {
    parts.add(name);
    add(parts, feature.used);
    add(parts, feature.required);
    add(parts, feature.required_with_fallback);
  }
}

}  // namespace

// Taken apart by name: a member that is added to the options has to be decided upon here.
Hash128 validation_key(const ValidateOptions& options, const std::string& folder) {
  const auto& [profile, pixels, limits, products, lfs, inline_suppressions, root, searched,
               max_issues, changed_lines, changed_lines_of, propose_fixes, targets, jobs, select,
               ignore, severity, schemas, own_rules, cache] = options;
  // The same report comes of any number of threads, with and without cache; with lines that changed
  // nothing is kept in that.
  static_cast<void>(changed_lines);
  static_cast<void>(changed_lines_of);
  // Says whether the asset may be opened, not what is in it.
  static_cast<void>(searched);
  static_cast<void>(products);  // key_of_file() has that of the file
  static_cast<void>(jobs);
  static_cast<void>(cache);
  HashParts parts;
  parts.add(version());
  parts.add(build_id());
  parts.add(static_cast<std::uint64_t>(profile));
  parts.add(static_cast<std::uint64_t>(pixel_level(options)));
  parts.add(std::uint64_t{pixels == PixelLevel::headers});  // limits and own rules read no pixels
  parts.add(std::uint64_t{limits.size()});
  for (const Limit& limit : limits) add(parts, limit);
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
  parts.add(std::uint64_t{targets.size()});
  for (const TargetChoice& choice : targets) add(parts, choice);
  parts.add(schemas ? schemas->sources() : Hash128());
  parts.add(own_rules ? own_rules->sources() : Hash128());
  return parts.finish();
}

}  // namespace gltfx
