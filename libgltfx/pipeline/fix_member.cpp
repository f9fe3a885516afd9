// SPDX-License-Identifier: Apache-2.0
#include "pipeline/fix_member.hpp"

#include <algorithm>
#include <utility>

#include "change/companions.hpp"
#include "pipeline/asset_verbs.hpp"
#include "pipeline/external_needs.hpp"
#include "pipeline/open_asset.hpp"
#include "prove/findings.hpp"
#include "rules/files_read.hpp"

namespace gltfx {
namespace {

using model::OpenedAsset;

}  // namespace

FixMember::FixMember(const std::string& path, Result<EditedAsset> opened, FixOptions options,
                     std::shared_ptr<const schema::Set> schemas)
    : options_(std::move(options)), schemas_(std::move(schemas)) {
  report_.path = path;
  if (!opened) {
    fail(EditProblem::unreadable, opened.error().message);
    return;
  }
  // A text that cannot be read may be what is fixed.
  const auto obstacle = find_obstacle(opened->asset);
  if (obstacle && !(opened->asset.container().json && opened->asset.document().empty())) {
    fail(EditProblem::unreadable, obstacle->message);
    return;
  }
  old_.emplace(*std::move(opened));
}

OpenedAsset FixMember::opened() const {
  return {old_->asset.name(), old_->asset.container(), old_->asset.resolver()};
}

// With the document, which is not to be held beside that of the new asset.
OpenedAsset FixMember::take_opened() {
  OpenedAsset fresh = opened();
  return std::exchange(old_->asset, std::move(fresh));
}

ValidateOptions FixMember::validation() const {
  return fix_validation(schemas_, asked_of(old_->asset, options_));
}

void FixMember::plan(const FileGuard& guard) {
  if (!is_sound()) return;
  fixed_.reset();
  fixed_.emplace(fix_in_rounds({take_opened(), validation()}, options_, schemas_, guard));
  if (!fixed_->trouble.empty()) return fail(EditProblem::refused, fixed_->trouble);
  if (const auto obstacle = find_obstacle(fixed_->after.asset())) {
    return fail(EditProblem::unreadable, obstacle->message);
  }
  referred_ = change::referred_paths(fixed_->after.asset().document());
  fixed_->after.forget_large_document();
  uses_.clear();
}

void FixMember::find_uses() {
  if (!is_sound()) return;
  const OpenedAsset before = opened();
  if (!before.document().empty()) use(before);
  if (fixed_ && fixed_->changes) use(fixed_->after.asset());
}

void FixMember::use(const OpenedAsset& asset) {
  validate::Fixing fixing(asset, *schemas_);
  const auto& read = fixing.table<validate::FilesRead>();
  for (const auto& [file, how] : read.files()) {
    FileUse& use = uses_[file];
    use.paths.insert(how.paths.begin(), how.paths.end());
    use.reads.add(read.reads_of(how));
  }
}

std::map<FileIdentity, const change::ReplacedFile*> FixMember::changed_files() const {
  std::map<FileIdentity, const change::ReplacedFile*> files;
  if (!is_sound() || !fixed_) return files;
  for (const auto& [path, file] : fixed_->files) {
    files.emplace(identity_of(file.state, path), &file);
  }
  return files;
}

bool FixMember::is_in_place() const { return change::is_in_place(options_, report_.path); }

bool FixMember::is_in_memory() const { return old_ && !old_->asset.resolver().looks_on_disk(); }

bool FixMember::changes_files_in_place() const { return options_.output.empty() || is_in_place(); }

bool FixMember::replaces_asset() const {
  return is_sound() && fixed_ && fixed_->changes && is_in_place();
}

std::vector<change::ReplacedFile> FixMember::replaced_by(const NewContents& contents) const {
  std::vector<change::ReplacedFile> replaced;
  for (const auto& [file, content] : contents) {
    const auto use = uses_.find(file);
    if (use == uses_.end()) continue;
    for (const std::string& path : use->second.paths) {
      replaced.push_back({path, content.state, content.before, content.after});
    }
  }
  return replaced;
}

std::optional<change::AssetWrite> FixMember::write(const NewContents& contents) {
  if (!is_sound()) return std::nullopt;
  if (options_.diff) report_.diff = diff_of(old_->asset, fixed_->edits);
  report_.actions = fixed_->actions;
  report_.changes = fixed_->changes;
  for (const auto& [path, file] : fixed_->files) report_.changed_files.push_back(path);
  for (const change::NewFile& file : fixed_->new_files) report_.new_files.push_back(file.path);
  if (!writes(options_)) return std::nullopt;
  if (!fixed_->changes && contents.empty()) {
    if (!copy_unchanged(old_->asset, old_->state, options_, report_)) {
      fail(report_.problem, std::move(report_.error));
    }
    return std::nullopt;
  }
  if (options_.output.empty() && !fixed_->changes) return std::nullopt;
  change::AssetWrite asset{old_->asset, old_->state, options_};
  if (fixed_->changes) asset.now = &fixed_->after.asset().container();
  asset.replaced = replaced_by(contents);
  asset.referred = referred_;
  asset.files = fixed_->new_files;
  // Without the files that new ones replace.
  if (!asset.files.empty()) asset.companions = referred_;
  return asset;
}

std::optional<Draft> FixMember::take_draft(const NewContents& contents) {
  if (!is_sound() || !fixed_->changes) return std::nullopt;
  return Draft{std::move(fixed_->after), std::move(fixed_->new_files), replaced_by(contents)};
}

void FixMember::note(const std::optional<change::WriteFailure>& failure) {
  if (!note_written(failure, options_, report_)) fail(report_.problem, std::move(report_.error));
}

void FixMember::fail(EditProblem problem, std::string why) {
  note_failure(report_, problem, std::move(why));
  for (FixAction& action : report_.actions) action.done = false;
  report_.changed_files.clear();
  report_.new_files.clear();
}

bool FixMember::is_worse_with(const NewContents& contents) const {
  OpenedAsset before = opened();
  container::Resolver resolver = before.resolver();
  for (const change::ReplacedFile& file : replaced_by(contents)) {
    resolver.add(file.path, file.after, file.state);
  }
  const validate::ValidatedAsset now(std::move(before), validation());
  const validate::ValidatedAsset then({path(), old_->asset.container(), std::move(resolver)},
                                      validation());
  return !prove::more_findings(prove::CodeCounts(now.report()), then.report()).empty();
}

FixReport FixMember::take_report() {
  if (old_ && report_.problem != EditProblem::unreadable) {
    report_.external_assets = external_assets_where(opened(), [this](const OpenedAsset& child) {
      ValidateOptions asked = asked_of(child, options_);
      asked.schemas = schemas_;
      OpenedAsset again{child.name(), child.container(), child.resolver()};
      return validate_asset(std::move(again), asked).report().fixable > 0;
    });
  }
  return std::move(report_);
}

}  // namespace gltfx
