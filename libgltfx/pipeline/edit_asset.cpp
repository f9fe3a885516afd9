// SPDX-License-Identifier: Apache-2.0
#include "pipeline/edit_asset.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/temporary_file.hpp"
#include "base/text.hpp"
#include "change/companions.hpp"
#include "change/diff.hpp"
#include "change/rewrite.hpp"
#include "json/lines.hpp"
#include "model/asset.hpp"
#include "rules/validated_asset.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using model::OpenedAsset;

// From the working folder, without "." and through no symbolic link, where the file lies below that
// folder; otherwise as it is named, without a leading '/'.
std::string patch_path(const OpenedAsset& asset) {
  const fs::path path = asset.name();
  if (asset.resolver().looks_on_disk()) {
    std::error_code error;
    const fs::path here = fs::canonical(".", error);
    const fs::path file = error ? fs::path() : fs::canonical(path, error);
    const fs::path below = error ? fs::path() : file.lexically_relative(here);
    if (!below.empty() && *below.begin() != "..") return below.native();
  }
  return path.lexically_normal().relative_path().native();
}

// Large drafts lie on the disk that they go to; a draft that goes nowhere, where temporary files
// lie.
fs::path folder_of_drafts(const OpenedAsset& asset, const EditOptions& options) {
  std::error_code error;
  if (!asset.resolver().looks_on_disk()) return {};
  if (!writes(options)) return fs::temp_directory_path(error);
  fs::path folder = change::target_folder(asset.name(), options.output);
  while (!fs::is_directory(folder, error) && folder.has_relative_path()) {
    folder = folder.parent_path();
  }
  return folder.empty() ? fs::path(".") : folder;
}

// Where the text leaves open which value is meant.
std::optional<std::string> find_ambiguous_text(const json::Parsed& parsed) {
  if (parsed.unrecorded_errors > 0) return "its JSON has too many errors; fix them first";
  for (const json::ParseError& error : parsed.errors) {
    switch (error.error) {
      case json::SyntaxError::missing_comma:
      case json::SyntaxError::lone_surrogate:
      case json::SyntaxError::duplicate_key: {
        const Location at = json::LineIndex(parsed.document.text()).locate(error.span);
        return fmt::format("its JSON is ambiguous at line {}, column {}: {}; fix that first",
                           at.line, at.column, error.detail);
      }
      default:
        break;
    }
  }
  return std::nullopt;
}

}  // namespace

container::Container without_zero_padding(container::Container container) {
  if (container.format != container::Format::glb || !container.json) return container;
  const std::size_t end = container.json->find_last_not_of('\0') + 1;
  if (end != container.json->size()) {
    container.json = share_text(std::string(container.json->substr(0, end)));
  }
  return container;
}

std::optional<std::string> find_edit_obstacle(const OpenedAsset& asset) {
  if (asset.container().glb_version == 1U || model::is_gltf_1(asset.document())) {
    return "glTF 1.0 is not supported";
  }
  if (auto why = change::find_glb_obstacle(asset.container())) {
    return "it cannot be written anew: " + *why;
  }
  return find_ambiguous_text(asset.parsed());
}

// The state is taken before the bytes: a change between the two is seen when it is written.
Result<EditedAsset> open_to_edit(const std::string& path, const AssetBounds& bounds) {
  const auto file = open_asset_file(path, bounds);
  if (!file) return file.error();
  auto container = container::open_file(*file, path);
  if (!container) return container.error();
  return EditedAsset{OpenedAsset(path, without_zero_padding(*std::move(container)),
                                 resolver_for(fs::path(path).parent_path(), bounds.root)),
                     file->state};
}

void note_failure(EditOutcome& outcome, EditProblem problem, std::string error) {
  outcome.problem = problem;
  outcome.error = std::move(error);
  outcome.changes = false;
  outcome.diff.clear();
}

bool writes(const EditOptions& options) { return options.in_place || !options.output.empty(); }

bool note_written(const std::optional<change::WriteFailure>& failure, const EditOptions& options,
                  EditOutcome& outcome) {
  if (failure) {
    note_failure(outcome, failure->refused ? EditProblem::refused : EditProblem::not_written,
                 failure->error);
    return false;
  }
  outcome.written = true;
  outcome.written_to = options.in_place ? outcome.path : options.output;
  return true;
}

std::optional<Draft> carry_out(const EditedFile& file, change::Change change, const Proof& proof,
                               EditOutcome& outcome, change::NewText now) {
  const OpenedAsset& old = file.before;
  const auto refuse = [&outcome](std::string why) {
    note_failure(outcome, EditProblem::refused, std::move(why));
    return std::nullopt;
  };
  change::AssetWrite asset{old, file.state, file.options};
  const bool written = writes(file.options);
  const bool in_place = change::is_in_place(file.options, old.name());
  if (written && in_place) {
    if (auto why = find_reader(old.name(), file.folders)) return refuse(*std::move(why));
  }
  change::DraftPlace place(folder_of_drafts(old, file.options),
                           in_place ? std::string() : file.options.output);
  auto draft = change::apply(old, change, std::move(now), place);
  if (!draft) return refuse(draft.error().message);
  ValidateOptions validation = validate::default_validation(file.schemas);
  validation.jobs = file.jobs;
  validate::ValidatedAsset after(*std::move(draft), validation);
  if (auto why = proof(after)) return refuse(*std::move(why));
  asset.companions = change::referred_paths(after.asset().document());
  after.forget_large_document();
  std::optional<Draft> proven(
      Draft{std::move(after), std::move(change.files), std::move(change.replaced)});
  if (!written) return proven;
  asset.now = &proven->asset.asset().container();
  asset.files = proven->files;
  asset.replaced = proven->replaced;
  asset.filled = place.asset_file();
  if (!note_written(change::commit({asset}).front(), file.options, outcome)) proven.reset();
  return proven;
}

std::optional<std::string> find_reader(const std::string& path, FolderIndex& folders) {
  const std::string reader = folders.reader_of(path);
  if (reader.empty()) return std::nullopt;
  return fmt::format("{} refers to this file, whose bytes would move; use -o", quoted(reader, 200));
}

bool copy_unchanged(const OpenedAsset& old, const FileState& state, const EditOptions& options,
                    EditOutcome& outcome) {
  if (options.output.empty()) {
    if (options.in_place) remove_stale_files(old.name());
    return true;
  }
  const auto failures = change::commit({{old, state, options}});
  return note_written(failures.front(), options, outcome);
}

// No patch changes the JSON inside a binary file: there the diff is a comment of one.
std::string diff_of(const OpenedAsset& asset, const std::vector<json::Edit>& edits, bool applies) {
  const bool is_text = applies && asset.container().format == container::Format::gltf;
  return change::unified_diff(*asset.container().json, edits, patch_path(asset),
                              is_text ? "" : "# ");
}

}  // namespace gltfx
