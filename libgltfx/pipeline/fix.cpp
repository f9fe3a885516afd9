// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <filesystem>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "edit/companions.hpp"
#include "edit/rewrite.hpp"
#include "pipeline/edit_asset.hpp"
#include "pipeline/fix_rounds.hpp"
#include "pipeline/in_order.hpp"
#include "pipeline/open_asset.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

using model::OpenedAsset;
using validate::ValidatedAsset;
using SchemaSet = std::shared_ptr<const schema::Set>;

edit::NewBytes new_bytes(const std::vector<container::Bytes>& pieces, const FixedAsset& fixed) {
  static const std::vector<edit::NewFile> kNone;
  edit::NewBytes bytes{pieces, kNone, {}};
  for (const auto& [path, file] : fixed.files) bytes.replaced.push_back(file);
  bytes.referred = edit::referred_paths(fixed.after.asset().document());
  return bytes;
}

// What was judged in memory is judged once more as it is on the disk.
edit::WriteCheck check_of(const FixedAsset& fixed, const SchemaSet& schemas) {
  return [&fixed, &schemas](container::Container on_disk) -> std::optional<std::string> {
    const OpenedAsset& asset = fixed.after.asset();
    const ValidatedAsset written({asset.name(), std::move(on_disk), asset.resolver()},
                                 fix_judgement(schemas));
    const auto worse = worse_codes(findings_by_code(fixed.after.report()), written.report());
    if (worse.empty()) return std::nullopt;
    return fmt::format("the new file would have the new finding {}", worse.front());
  };
}

void write_fixed(const OpenedAsset& old, const FileState& state, const FixedAsset& fixed,
                 const FixOptions& options, const SchemaSet& schemas, FixReport& report) {
  const container::Container& container = fixed.after.asset().container();
  const auto pieces = edit::rewrite(container, container.json, {});
  if (!pieces) return note_failure(report, EditProblem::refused, pieces.error().message);
  write_edited(old, state, new_bytes(*pieces, fixed), options, check_of(fixed, schemas), report);
}

FixReport fix_opened(EditedAsset opened, const FixOptions& options) {
  FixReport report;
  report.path = opened.asset.name();
  // A text that cannot be read may be what is fixed.
  if (const auto obstacle = find_obstacle(opened.asset);
      obstacle && !(opened.asset.container().json && opened.asset.document().empty())) {
    note_failure(report, EditProblem::unreadable, obstacle->message);
    return report;
  }
  const SchemaSet schemas = options.schemas ? options.schemas : schema::builtin_set();
  const OpenedAsset old(opened.asset.name(), opened.asset.container(), opened.asset.resolver());
  const FixedAsset fixed =
      fix_in_rounds({std::move(opened.asset), fix_judgement(schemas)}, options, schemas);
  if (const auto obstacle = find_obstacle(fixed.after.asset())) {
    note_failure(report, EditProblem::unreadable, obstacle->message);
    return report;
  }
  report.actions = fixed.actions;
  report.changes = fixed.changes;
  for (const auto& [path, file] : fixed.files) report.changed_files.push_back(path);
  if (options.diff) report.diff = diff_of(old, fixed.edits);
  if (!fixed.changes) {
    copy_unchanged(old, opened.state, options, report);
  } else if (options.in_place || !options.output.empty()) {
    write_fixed(old, opened.state, fixed, options, schemas, report);
  }
  if (report.problem != EditProblem::none) {
    for (FixAction& action : report.actions) action.done = false;
    report.changed_files.clear();
  }
  return report;
}

FixReport guarded(const std::string& path, const FixOptions& options) {
  FixReport report;
  report.path = path;
  try {
    auto opened = open_to_edit(path, options.root);
    if (opened) return fix_opened(*std::move(opened), options);
    note_failure(report, EditProblem::unreadable, opened.error().message);
  } catch (const std::bad_alloc&) {
    note_failure(report, EditProblem::unreadable, "there is not enough memory to fix this file");
  } catch (const std::filesystem::filesystem_error&) {
    note_failure(report, EditProblem::unreadable, "the path cannot be looked up");
  }
  return report;
}

}  // namespace

std::uint64_t FixReport::fixed() const {
  std::uint64_t count = 0;
  for (const FixAction& action : actions) count += action.done ? action.count : 0;
  return count;
}

std::uint64_t FixReport::left() const {
  std::uint64_t count = 0;
  for (const FixAction& action : actions) count += action.done ? 0 : action.count;
  return count;
}

FixReport fix_file(const std::string& path, const FixOptions& options) {
  return guarded(path, options);
}

void fix_files(const std::vector<EditInput>& inputs, const FixOptions& options, unsigned jobs,
               const std::function<void(FixReport&&)>& consume) {
  report_in_order<FixReport>(
      inputs.size(), jobs,
      [&](std::size_t i) {
        FixOptions each = options;
        each.output = inputs[i].output;
        return fix_file(inputs[i].path, each);
      },
      consume);
}

}  // namespace gltfx
