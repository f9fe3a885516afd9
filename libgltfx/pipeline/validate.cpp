// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>
#include <gltfx/result_cache.hpp>
#include <gltfx/validate.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/bit_cast.hpp"
#include "base/hash.hpp"
#include "change/apply.hpp"
#include "container/container.hpp"
#include "container/memory_asset.hpp"
#include "json/parse.hpp"
#include "pipeline/asset_verbs.hpp"
#include "pipeline/cached_verb.hpp"
#include "pipeline/fixable.hpp"
#include "pipeline/in_order.hpp"
#include "pipeline/open_asset.hpp"
#include "prove/findings.hpp"
#include "report/packed.hpp"
#include "rules/shared_reports.hpp"
#include "rules/validated_asset.hpp"
#include "rules/validation_key.hpp"
#include "rules/validator.hpp"
#include "schema/compile.hpp"
#include "steps/upgrade/plan.hpp"

namespace gltfx {
namespace {

bool asks_for_upgrade(const Diagnostic& finding) {
  return finding.code == "EXTENSION_LEGACY" || finding.code == "EXTENSION_ARCHIVED";
}

// The place of the first finding that names an extension of which the plan upgrades something.
std::optional<std::size_t> first_fixed(const FileReport& report, const json::Document& document,
                                       const upgrade::Plan& plan) {
  for (std::size_t i = 0; i < report.diagnostics.size(); ++i) {
    const Diagnostic& finding = report.diagnostics[i];
    if (!asks_for_upgrade(finding)) continue;
    const json::NodeId entry = document.resolve(finding.pointer);
    if (entry == json::kNoNode || !document.is_string(entry)) continue;
    const std::string name = document.string(entry);
    for (const UpgradeAction& action : plan.actions) {
      if (action.done && action.from == name) return i;
    }
  }
  return std::nullopt;
}

std::string description_of(const upgrade::Plan& plan) {
  std::uint64_t done = 0;
  for (const UpgradeAction& action : plan.actions) done += action.done ? 1U : 0U;
  return fmt::format(
      "Bring {} of {} legacy object{} to the successor, with the same picture, as 'gltfx upgrade' "
      "does.",
      done, plan.actions.size(), plan.actions.size() == 1 ? "" : "s");
}

bool is_sound(const container::Container& container, const json::Parsed& parsed) {
  return parsed.ok() && container.errors.empty() && container.late_errors.empty() &&
         container.format == container::Format::gltf;
}

// Gives the first finding about an extension that was replaced the edits that bring all objects to
// their successors for which that is safe. Nothing where the text has errors, the new text would
// have an error that the old one has not, or the asset is binary.
void propose_fix(validate::ValidatedAsset& validated, const ValidateOptions& options) {
  const model::OpenedAsset& asset = validated.asset();
  const auto& findings = validated.report().diagnostics;
  const bool asked = std::any_of(findings.begin(), findings.end(), asks_for_upgrade);
  if (!asked || asset.document().empty()) return;
  if (!is_sound(asset.container(), asset.parsed())) return;
  const auto schemas = options.schemas ? options.schemas : schema::builtin_set();
  const upgrade::Plan plan = upgrade::make_plan(asset.document(), *schemas, {});
  const auto finding = first_fixed(validated.report(), asset.document(), plan);
  if (!finding || plan.change.edits.empty()) return;
  change::Change change;
  change.edits = plan.change.edits;
  auto fixed = change::apply(asset, change);
  if (!fixed) return;
  const validate::ValidatedAsset after(*std::move(fixed), validate::default_validation(schemas));
  if (!prove::new_findings(validated, after, schemas).error.empty()) return;
  validated.propose(*finding, proposed_fix(description_of(plan), asset, plan.change.edits));
}

namespace fs = std::filesystem;

// The library does not throw: memory that cannot be had is one more reason why a file is
// unreadable.
template <class Work>
FileReport without_throwing(const std::string& name, const ValidateOptions& options,
                            const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return validate::unreadable(name, "There is not enough memory to check the file.", options);
  } catch (const fs::filesystem_error&) {
    return validate::unreadable(name, "The path cannot be looked up.", options);
  }
}

template <class Work>
FileReport guarded(const std::string& name, const ValidateOptions& options, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  FileReport report = without_throwing(name, options, work);
  const auto time = std::chrono::steady_clock::now() - start;
  report.microseconds = static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::microseconds>(time).count());
  return report;
}

Validation with_report(validate::ValidatedAsset validated) {
  FileReport report = validated.take_report();
  return {std::move(report), validated.take_asset()};
}

// A kept report is found by bytes, wherever the file lies: external assets are named from its
// folder on.
std::string folder_with_slash(const std::string& path) {
  return path.substr(0, path.rfind('/') + 1);
}

std::string pack_with_places(FileReport report) {
  const std::size_t folder = folder_with_slash(report.path).size();
  for (FileReport& external : report.external_assets) external.path.erase(0, folder);
  return report::pack(report);
}

void name_places(FileReport& report, const std::string& path) {
  report.path = path;
  for (FileReport& external : report.external_assets) {
    external.path.insert(0, folder_with_slash(path));
  }
}

/// Validation of one file, for cached().
struct ValidateVerb {
  using Report = Validation;
  const std::string& path;
  const ValidateOptions& options;
  validate::SharedReports* shared;

  Result<model::OpenedAsset> open() const { return open_asset(path, AssetBounds::of(options)); }
  Validation refuse(const std::string& why) const {
    return {validate::unreadable(path, why, options), std::nullopt};
  }
  Validation run(model::OpenedAsset asset) const {
    return with_report(validate_asset(std::move(asset), options, shared));
  }
  static std::optional<std::string> pack(const Validation& validation) {
    if (!validation.report.readable) return std::nullopt;
    return pack_with_places(validation.report);
  }
  std::optional<Validation> unpack(const std::string& kept, model::OpenedAsset* asset) const {
    auto report = report::unpack(kept, rules(options.own_rules.get()));
    if (!report) return std::nullopt;
    name_places(*report, path);
    Validation validation{*std::move(report), std::nullopt};
    if (asset != nullptr) validation.asset = std::move(*asset);
    return validation;
  }
};

// What is kept is found by the name and the bytes of a file. Own rules see its path as well.
Hash128 key_of_file(const std::string& path, const ValidateOptions& options) {
  HashParts parts;
  parts.add(validation_key(options, options.cache->folder()));
  if (options.own_rules) parts.add(path);
  if (options.products) {
    for (const double size : options.products->find(path)) {
      parts.add(bit_cast<std::uint64_t>(size));
    }
  }
  return parts.finish();
}

Validation validate_or_recall(const std::string& path, const ValidateOptions& options,
                              validate::SharedReports* shared) {
  const ValidateVerb verb{path, options, shared};
  if (options.cache && !options.changed_lines && !options.changed_lines_of) {
    return cached(path, AssetBounds::of(options), *options.cache, key_of_file(path, options), verb);
  }
  auto opened = verb.open();
  return opened ? verb.run(*std::move(opened)) : verb.refuse(opened.error().message);
}

}  // namespace

validate::ValidatedAsset validate_asset(model::OpenedAsset asset, const ValidateOptions& options,
                                        validate::SharedReports* shared) {
  validate::ValidatedAsset validated(std::move(asset), options, shared);
  if (options.propose_fixes) propose_fix(validated, options);
  if (options.profile != Profile::khronos && !validated.sites().empty()) {
    mark_fixable(validated, options);
  }
  return validated;
}

Validation validate_path(const std::string& path, const ValidateOptions& options,
                         validate::SharedReports* shared) {
  Validation validation;
  validation.report = guarded(path, options, [&] {
    Validation made = validate_or_recall(path, options, shared);
    validation.asset = std::move(made.asset);
    return std::move(made.report);
  });
  return validation;
}

FileReport validate_file(const std::string& path, const ValidateOptions& options) {
  return validate_path(path, options).report;
}

FileReport validate_bytes(std::string bytes, const std::string& name,
                          const ValidateOptions& options) {
  return validate_bytes({std::move(bytes), name, AssetFormat::detect, {}}, options);
}

FileReport validate_bytes(MemoryAsset asset, const ValidateOptions& options) {
  return guarded(asset.name, options, [&] {
    container::Container opened =
        container::open_memory(std::move(asset.bytes), asset.name, asset.format);
    return validate_asset({asset.name, std::move(opened),
                           container::resolver_of(std::move(asset), options.root)},
                          options)
        .take_report();
  });
}

void validate_files(std::span<const ValidateInput> inputs, unsigned jobs,
                    const std::function<void(FileReport&&)>& consume) {
  validate::SharedReports shared;
  report_in_order<FileReport>(
      inputs.size(), jobs,
      [&](std::size_t i) {
        return validate_path(inputs[i].path, *inputs[i].options, &shared).report;
      },
      consume);
}

void validate_files(const std::vector<std::string>& paths, const ValidateOptions& options,
                    unsigned jobs, const std::function<void(FileReport&&)>& consume) {
  // Many files keep all threads busy by themselves.
  const unsigned each = paths.size() == 1 ? jobs : 1;
  validate::SharedReports shared;
  report_in_order<FileReport>(
      paths.size(), jobs,
      [&](std::size_t i) {
        return guarded(paths[i], options, [&] {
          ValidateOptions own = options;
          own.jobs = each;
          return validate_path(paths[i], own, &shared).report;
        });
      },
      consume);
}

}  // namespace gltfx
