// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>
#include <gltfx/validate.hpp>

#include <filesystem>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "base/pages.hpp"
#include "inspect/facts.hpp"
#include "pipeline/asset_verbs.hpp"
#include "pipeline/in_order.hpp"
#include "pipeline/open_asset.hpp"
#include "rules/validated_asset.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

UpgradeFact fact_of(UpgradeAction&& action) {
  UpgradeFact fact;
  fact.pointer = std::move(action.pointer);
  fact.from = std::move(action.from);
  if (!action.removed) fact.to = std::move(action.to);
  fact.outcome = action.removed ? "removed" : upgrade_outcome_name(action.outcome);
  fact.done = action.done;
  fact.notes = std::move(action.notes);
  return fact;
}

void add_shown(const FileReport& validation, InspectReport& report) {
  for (const Diagnostic& each : validation.diagnostics) {
    const RuleDescription* rule = find_rule(each.code);
    if (rule == nullptr || rule->group != "shows") continue;
    report.shown.push_back({std::string(each.code), std::string(severity_name(each.severity)),
                            each.pointer, each.message});
  }
  const std::uint64_t errors = validation.counts.errors;
  if (errors == 0) return;
  report.shown_problem = fmt::format(
      "The asset has {} error{}, see 'gltfx validate': what it shows is checked without errors.",
      errors, errors == 1 ? "" : "s");
}

InspectReport failed(const std::string& path, std::string why) {
  InspectReport report;
  report.path = path;
  report.error = std::move(why);
  return report;
}

// The library does not throw.
template <class Work>
InspectReport guarded(const std::string& path, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return failed(path, "there is not enough memory to inspect the file");
  } catch (const std::filesystem::filesystem_error&) {
    return failed(path, "the path cannot be looked up");
  }
}

InspectReport collect(const model::OpenedAsset& asset, const schema::Set& schemas,
                      const InspectOptions& options) {
  InspectReport report;
  report.path = asset.name();
  report.facts = inspect::collect_facts(asset, schemas, options);
  return report;
}

InspectReport inspect_opened(const std::string& path, Result<model::OpenedAsset> asset,
                             const InspectOptions& options) {
  if (!asset) return failed(path, asset.error().message);
  if (auto obstacle = find_inspection_obstacle(*asset)) {
    return failed(path, std::move(obstacle->message));
  }
  const auto schemas = options.schemas ? options.schemas : schema::builtin_set();
  UpgradeOptions wanted;
  wanted.root = options.root;
  wanted.schemas = schemas;
  ValidateOptions check;
  check.root = options.root;
  check.schemas = schemas;
  check.jobs = options.jobs;
  validate::ValidatedAsset validated(*std::move(asset), check);
  UpgradeReport upgrade = dry_run_upgrade(validated, wanted).report;
  give_back_memory();
  InspectReport report = collect(validated.asset(), *schemas, options);
  add_upgrade(std::move(upgrade), report);
  add_shown(validated.report(), report);
  return report;
}

InspectReport inspect_path(const std::string& path, const InspectOptions& options) {
  return inspect_opened(path, open_asset(path, AssetBounds::of(options)), options);
}

}  // namespace

std::optional<Error> find_inspection_obstacle(const model::OpenedAsset& asset) {
  if (auto obstacle = find_obstacle(asset)) return obstacle;
  const json::Document& document = asset.document();
  if (document.is_object(document.root())) return std::nullopt;
  return Error{"it is not a glTF asset; see 'gltfx validate'"};
}

InspectReport inspect_asset(const model::OpenedAsset& asset, const schema::Set& schemas,
                            unsigned jobs) {
  if (auto obstacle = find_inspection_obstacle(asset)) {
    return failed(asset.name(), std::move(obstacle->message));
  }
  InspectOptions options;
  options.jobs = jobs;
  return guarded(asset.name(), [&] { return collect(asset, schemas, options); });
}

void add_upgrade(UpgradeReport upgrade, InspectReport& report) {
  report.upgrade.reserve(upgrade.actions.size());
  for (UpgradeAction& action : upgrade.actions) {
    report.upgrade.push_back(fact_of(std::move(action)));
  }
  report.upgrade_problem = std::move(upgrade.error);
}

InspectReport inspect_file(const std::string& path, const InspectOptions& options) {
  return guarded(path, [&] { return inspect_path(path, options); });
}

InspectReport inspect_bytes(MemoryAsset asset, const InspectOptions& options) {
  const std::string name = asset.name;
  return guarded(name, [&] {
    return inspect_opened(name, open_memory(std::move(asset), options.root), options);
  });
}

void inspect_files(const std::vector<std::string>& paths, const InspectOptions& options,
                   unsigned jobs, const std::function<void(InspectReport&&)>& consume) {
  const unsigned each = paths.size() == 1 ? jobs : 1;
  report_in_order<InspectReport>(
      paths.size(), jobs,
      [&](std::size_t i) {
        return guarded(paths[i], [&] {
          InspectOptions own = options;
          own.jobs = each;
          return inspect_path(paths[i], own);
        });
      },
      consume);
}

}  // namespace gltfx
