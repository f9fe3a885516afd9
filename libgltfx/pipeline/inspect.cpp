// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <filesystem>
#include <new>
#include <utility>

#include "base/pages.hpp"
#include "inspect/facts.hpp"
#include "pipeline/in_order.hpp"
#include "pipeline/opened_asset.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

UpgradeFact fact_of(UpgradeAction&& action) {
  UpgradeFact fact;
  fact.pointer = std::move(action.pointer);
  fact.from = std::move(action.from);
  if (!action.removed) fact.to = std::move(action.to);
  fact.outcome = action.removed ? "removed" : upgrade_fate_name(action.fate);
  fact.done = action.done;
  fact.notes = std::move(action.notes);
  return fact;
}

// False when there are none; then the report says why. The asset is closed at the end: what looks
// at it next opens it anew, and a large document is held once.
bool collect(const std::string& path, const InspectOptions& options, const schema::Set& schemas,
             InspectReport& report) {
  auto opened = open_asset(path, options.root);
  if (!opened) {
    report.error = opened.error().message;
    return false;
  }
  const json::Document& document = opened->parsed.document;
  if (!document.is_object(document.root())) {
    report.error = "it is not a glTF asset; see 'gltfx validate'";
    return false;
  }
  report.facts =
      inspect::collect_facts(opened->container, opened->resolver, document, schemas, options.jobs);
  return true;
}

InspectReport inspect_opened(const std::string& path, const InspectOptions& options) {
  InspectReport report;
  report.path = path;
  const auto schemas = options.schemas ? options.schemas : schema::builtin_set();
  if (!collect(path, options, *schemas, report)) return report;
  give_back_memory();
  UpgradeOptions wanted;
  wanted.root = options.root;
  wanted.schemas = schemas;
  UpgradeReport upgrade = upgrade_file(path, wanted);
  for (UpgradeAction& action : upgrade.actions)
    report.upgrade.push_back(fact_of(std::move(action)));
  report.upgrade_problem = std::move(upgrade.error);
  return report;
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

}  // namespace

InspectReport inspect_file(const std::string& path, const InspectOptions& options) {
  return guarded(path, [&] { return inspect_opened(path, options); });
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
          return inspect_opened(paths[i], own);
        });
      },
      consume);
}

}  // namespace gltfx
