// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <filesystem>
#include <new>
#include <optional>
#include <set>
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

edit::NewBytes new_bytes(const std::vector<container::Bytes>& pieces, const FixedAsset& fixed,
                         std::set<std::string> referred) {
  static const std::vector<edit::NewFile> kNone;
  edit::NewBytes bytes{pieces, kNone, {}, std::move(referred)};
  for (const auto& [path, file] : fixed.files) bytes.replaced.push_back(file);
  return bytes;
}

container::Bytes bin_of(const container::Container& container) {
  const auto& bin = container.bin;
  return bin ? container.bytes.part(bin->offset, bin->length) : container::Bytes();
}

std::set<Code> codes_of(const container::Container& container) {
  std::set<Code> codes;
  for (const auto* errors : {&container.errors, &container.late_errors}) {
    for (const container::ContainerError& error : *errors) codes.insert(error.code);
  }
  return codes;
}

// What was judged in memory is what lies on the disk now.
edit::WriteCheck check_of(const container::Container& judged) {
  return [&judged](container::Container on_disk) -> std::optional<std::string> {
    const std::set<Code> known = codes_of(judged), found = codes_of(on_disk);
    const bool same = judged.json && on_disk.json &&
                      edit::same_but_for_padding(*judged.json, *on_disk.json) &&
                      container::same_bytes(bin_of(judged), bin_of(on_disk)) &&
                      std::includes(known.begin(), known.end(), found.begin(), found.end());
    if (same) return std::nullopt;
    return "the file on the disk is not the one that was validated";
  };
}

void write_fixed(const OpenedAsset& old, const FileState& state, const FixedAsset& fixed,
                 std::set<std::string> referred, const FixOptions& options, FixReport& report) {
  const container::Container& container = fixed.after.asset().container();
  const auto pieces = edit::rewrite(container, container.json, {});
  if (!pieces) return note_failure(report, EditProblem::refused, pieces.error().message);
  write_edited(old, state, new_bytes(*pieces, fixed, std::move(referred)), options,
               check_of(container), report);
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
  const ValidateOptions judgement = fix_judgement(schemas, asked_of(old, options));
  FixedAsset fixed = fix_in_rounds({std::move(opened.asset), judgement}, options, schemas);
  if (const auto obstacle = find_obstacle(fixed.after.asset())) {
    note_failure(report, EditProblem::unreadable, obstacle->message);
    return report;
  }
  std::set<std::string> referred = edit::referred_paths(fixed.after.asset().document());
  fixed.after.forget_large_document();
  report.actions = fixed.actions;
  report.changes = fixed.changes;
  for (const auto& [path, file] : fixed.files) report.changed_files.push_back(path);
  if (options.diff) report.diff = diff_of(old, fixed.edits);
  if (!fixed.changes) {
    copy_unchanged(old, opened.state, options, report);
  } else if (options.in_place || !options.output.empty()) {
    write_fixed(old, opened.state, fixed, std::move(referred), options, report);
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
