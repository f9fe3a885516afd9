// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "change/deletion.hpp"
#include "pipeline/edit_bytes.hpp"
#include "pipeline/edit_files.hpp"
#include "pipeline/open_asset.hpp"
#include "prove/findings.hpp"
#include "report/wording.hpp"
#include "rules/validated_asset.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

using model::OpenedAsset;
using validate::ValidatedAsset;
using SchemaSet = std::shared_ptr<const schema::Set>;
using Reason = std::optional<std::string>;

/// One asset and what is to become of it.
class DeleteRun {
 public:
  DeleteRun(const ValidatedAsset& before, const FileState& state, const DeleteOptions& options,
            const SchemaSet& schemas, FolderIndex& folders, DeleteReport& report)
      : before_(before),
        state_(state),
        options_(options),
        schemas_(schemas),
        folders_(folders),
        report_(report) {}

  std::optional<Draft> run() {
    const OpenedAsset& asset = before_.asset();
    if (auto why = find_edit_obstacle(asset)) return refuse(*std::move(why));
    auto planned = change::plan_deletion(asset.document(), *schemas_, options_.pointers,
                                         {options_.cascade, &asset.container()});
    if (!planned) return refuse(planned.error().message);
    describe(*planned);
    if (!report_.obstacles.empty()) return refuse_for_obstacles();
    report_.changes = !planned->change.edits.empty();
    if (options_.diff) report_.diff = diff_of(asset, planned->change.edits);
    if (!report_.changes) {
      copy_unchanged(asset, state_, options_, report_);
      return std::nullopt;
    }
    auto draft = carry_out(
        {before_.asset(), state_, options_, schemas_, folders_}, std::move(planned->change),
        [this](const ValidatedAsset& after) { return find_error(after); }, report_);
    if (!draft) forget_plan();
    return draft;
  }

 private:
  std::nullopt_t refuse(std::string why) {
    note_failure(report_, EditProblem::refused, std::move(why));
    forget_plan();
    return std::nullopt;
  }

  void forget_plan() {
    report_.deleted.clear();
    report_.new_warnings.clear();
  }

  std::nullopt_t refuse_for_obstacles() {
    const auto references =
        std::count_if(report_.obstacles.begin(), report_.obstacles.end(),
                      [](const DeleteObstacle& obstacle) { return !obstacle.must_have; });
    const auto owners = static_cast<std::ptrdiff_t>(report_.obstacles.size()) - references;
    return refuse(
        owners == 0
            ? fmt::format("{} to what was to be deleted; --cascade deletes "
                          "what refers to it, too",
                          report::counted(static_cast<std::uint64_t>(references), "reference"))
            : "an object cannot be without what was to be deleted; --cascade deletes it, too");
  }

  void describe(change::Deletion& planned) {
    for (change::DeletedValue& value : planned.deleted) {
      report_.deleted.push_back({std::move(value.pointer), std::move(value.cause)});
    }
    for (change::DeletionObstacle& obstacle : planned.obstacles) {
      report_.obstacles.push_back(
          {std::move(obstacle.pointer), std::move(obstacle.target), obstacle.must_have});
    }
    report_.renumbered = planned.renumbered;
    report_.names_removed = std::move(planned.names);
    report_.doubtful = std::move(planned.doubtful);
    for (const auto& [position, bin] : planned.change.bins) {
      for (const change::ByteRange& range : bin.cut) report_.bytes += range.end - range.begin;
      if (bin.drop) report_.bytes += before_.asset().container().chunks[position].length;
    }
  }

  Reason find_error(const ValidatedAsset& after) {
    prove::NewFindings found = prove::new_findings(before_, after, schemas_);
    report_.new_warnings = std::move(found.warnings);
    if (found.error.empty()) return std::nullopt;
    return fmt::format("the new file would have the new error {}", found.error);
  }

  const ValidatedAsset& before_;
  const FileState& state_;
  const DeleteOptions& options_;
  const SchemaSet& schemas_;
  FolderIndex& folders_;
  DeleteReport& report_;
};

std::optional<Draft> delete_in(EditedAsset opened, const DeleteOptions& options,
                               FolderIndex& folders, DeleteReport& report) {
  if (const auto obstacle = find_obstacle(opened.asset)) {
    note_failure(report, EditProblem::unreadable, obstacle->message);
    return std::nullopt;
  }
  const SchemaSet schemas = options.schemas ? options.schemas : schema::builtin_set();
  const ValidatedAsset before(std::move(opened.asset), validate::default_validation(schemas));
  return DeleteRun(before, opened.state, options, schemas, folders, report).run();
}

DeleteReport delete_in_file(const std::string& path, const DeleteOptions& options,
                            FolderIndex& folders) {
  return edit_file<DeleteReport>(path, options, "edit",
                                 [&](EditedAsset opened, DeleteReport& report) {
                                   delete_in(std::move(opened), options, folders, report);
                                 });
}

}  // namespace

DeleteReport delete_objects(const std::string& path, const DeleteOptions& options) {
  FolderIndex folders;
  return delete_in_file(path, options, folders);
}

EditedBytes<DeleteReport> delete_objects_in_bytes(MemoryAsset asset, const DeleteOptions& options) {
  return edit_bytes<DeleteReport>(std::move(asset), options,
                                  [&](EditedAsset opened, DeleteReport& report) {
                                    FolderIndex folders;
                                    return delete_in(std::move(opened), options, folders, report);
                                  });
}

void delete_objects_in_files(const std::vector<EditInput>& inputs, const DeleteOptions& options,
                             unsigned jobs, const std::function<void(DeleteReport&&)>& consume) {
  edit_files(inputs, options, jobs, delete_in_file, consume);
}

}  // namespace gltfx
