// SPDX-License-Identifier: Apache-2.0
#include "change/commit.hpp"

#include <array>
#include <deque>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/replace_file.hpp"
#include "base/text.hpp"
#include "change/backup.hpp"
#include "change/companions.hpp"
#include "change/rewrite.hpp"
#include "container/bytes.hpp"
#include "container/file.hpp"
#include "container/uri.hpp"

namespace gltfx::change {
namespace {

namespace fs = std::filesystem;
using Trouble = std::optional<Error>;
using Failure = std::optional<WriteFailure>;

Failure not_written(const Trouble& trouble) {
  if (!trouble) return std::nullopt;
  return WriteFailure{false, trouble->message};
}

Trouble changed_meanwhile(const AssetWrite& asset) {
  const auto now = file_state(asset.old.name());
  if (!now) return now.error();
  if (*now == asset.state) return std::nullopt;
  return Error{"it was changed by another program since it was read; run again"};
}

using Pieces = std::vector<container::Bytes>;

// Checks that the bytes on the disk are those that were proven.
Trouble compare(const FileDraft& draft, const Pieces& pieces) {
  const container::Loaded file = container::load_file(container::adopt_regular(draft.reader()));
  const bool readable = file.error == container::ResolveError::none;
  if (readable && container::same_bytes(pieces, file.bytes)) return std::nullopt;
  return Error{"the file on the disk differs from the validated file"};
}

// Fills the draft with the new bytes, which must come from the bytes that were read, and gives it
// the attributes of the replaced file.
Failure fill(FileDraft& draft, const AssetWrite& asset) {
  if (&draft == asset.filled) {
    if (auto failure = not_written(changed_meanwhile(asset))) return failure;
    return not_written(draft.finish());
  }
  const auto pieces =
      asset.now != nullptr ? rewrite(*asset.now) : Pieces{asset.old.container().bytes};
  if (!pieces) return WriteFailure{true, pieces.error().message};
  if (auto failure = not_written(container::write_pieces(draft, *pieces))) return failure;
  if (auto failure = not_written(changed_meanwhile(asset))) return failure;
  if (asset.now != nullptr) {
    if (auto failure = not_written(compare(draft, *pieces))) return failure;
  }
  return not_written(draft.finish());
}

Trouble write_new_files(const AssetWrite& asset, const fs::path& folder) {
  for (const NewFile& file : asset.files) {
    const fs::path target = folder / file.path;
    if (auto trouble = make_folder(target.parent_path())) return trouble;
    if (auto trouble = put_file(target, file.pieces)) return trouble;
  }
  return std::nullopt;
}

/// A file that a draft will replace.
struct Target {
  Target(std::string file, const FileState& state, container::Bytes bytes)
      : path(std::move(file)), before(std::move(bytes)), draft(path, state) {}

  std::string copy_name() const { return backup_of(path); }

  Trouble keep_old() {
    FileDraft copy(copy_name(), path);
    if (auto trouble = container::write_pieces(copy, {before})) return trouble;
    if (auto trouble = copy.finish()) return trouble;
    if (auto trouble = copy.publish()) return trouble;
    has_copy = true;
    return std::nullopt;
  }
  Trouble publish() {
    auto trouble = draft.publish();
    is_old = trouble.has_value();
    return trouble;
  }

  const std::string path;
  const container::Bytes before;
  FileDraft draft;
  bool has_copy = false;
  bool is_old = true;  ///< not replaced yet
};

/// Files that are replaced in place. All drafts exist before the first is published.
class InPlace {
 public:
  ~InPlace() {
    // A leftover copy of a file that was not replaced would block the next run.
    for (const auto* targets : {&files_, &assets_}) {
      for (const Target& target : *targets) {
        std::error_code ignored;
        if (target.has_copy && target.is_old) fs::remove(target.copy_name(), ignored);
      }
    }
  }

  // The obstacle, if any.
  Failure prepare(const AssetWrite& asset) {
    const fs::path folder = target_folder(asset.old.name(), {});
    Target& target =
        assets_.emplace_back(asset.old.name(), asset.state, asset.old.container().bytes);
    if (auto failure = fill(target.draft, asset)) return failure;
    if (auto failure = not_written(write_new_files(asset, folder))) return failure;
    for (const ReplacedFile& file : asset.replaced) {
      const fs::path path = folder / file.path;
      if (!known_.insert(identity_of(file.state, path.native())).second) continue;
      Target& place = files_.emplace_back(path.native(), file.state, file.before);
      if (auto failure = not_written(container::write_pieces(place.draft, {file.after}))) {
        return failure;
      }
      if (auto failure = not_written(place.draft.finish())) return failure;
    }
    return std::nullopt;
  }

  Trouble keep_old() {
    for (auto* targets : {&files_, &assets_}) {
      for (Target& target : *targets) {
        if (auto trouble = target.keep_old()) return trouble;
      }
    }
    return std::nullopt;
  }

  Trouble publish_files() {
    for (Target& file : files_) {
      if (auto trouble = file.publish()) return trouble;
    }
    return std::nullopt;
  }
  Trouble publish_asset(std::size_t position) { return assets_[position].publish(); }

 private:
  std::deque<Target> assets_, files_;
  std::set<FileIdentity> known_;
};

using Failures = std::vector<Failure>;

// An obstacle of one fails all: they may share replaced files.
void fail_all(const std::vector<const AssetWrite*>& assets, Failures& failures,
              std::size_t position, Failure failure) {
  for (std::size_t i = 0; i < assets.size(); ++i) {
    if (i == position) continue;
    failures[i] =
        WriteFailure{false, fmt::format("{}, which shares files with it, cannot be written: {}",
                                        quoted(assets[position]->old.name(), 200), failure->error)};
  }
  failures[position] = std::move(failure);
}

Failures write_in_place(const std::vector<const AssetWrite*>& assets) {
  Failures failures(assets.size());
  InPlace places;
  for (std::size_t i = 0; i < assets.size(); ++i) {
    if (auto failure = places.prepare(*assets[i])) {
      fail_all(assets, failures, i, std::move(failure));
      return failures;
    }
  }
  const bool backup = !assets.empty() && assets.front()->options.backup;
  Trouble trouble = backup ? places.keep_old() : std::nullopt;
  if (!trouble) trouble = places.publish_files();
  for (std::size_t i = 0; i < assets.size(); ++i) {
    failures[i] = not_written(trouble ? trouble : places.publish_asset(i));
  }
  return failures;
}

/// An asset that is written to another place.
class Elsewhere {
 public:
  explicit Elsewhere(const AssetWrite& asset)
      : asset_(asset), folder_(target_folder(asset.old.name(), asset.options.output)) {}

  Failure write() const {
    if (asset_.filled != nullptr) return publish(*asset_.filled);
    if (auto failure = not_written(make_folder(folder_))) return failure;
    const auto seen = state_if_there(asset_.options.output);
    if (!seen) return not_written(seen.error());
    FileDraft draft(asset_.options.output, *seen);
    return publish(draft);
  }

 private:
  Failure publish(FileDraft& draft) const {
    if (auto failure = fill(draft, asset_)) return failure;
    if (auto failure = not_written(write_replaced())) return failure;
    if (auto failure = not_written(copy_others())) return failure;
    if (auto failure = not_written(write_new_files(asset_, folder_))) return failure;
    return not_written(draft.publish());
  }

  bool is_own_folder() const {
    std::error_code error;
    return fs::equivalent(folder_, target_folder(asset_.old.name(), {}), error);
  }

  Trouble write_replaced() const {
    const std::vector<ReplacedFile>& replaced = asset_.replaced;
    if (replaced.empty()) return std::nullopt;
    if (is_own_folder()) {
      return Error{fmt::format(
          "{} would change, but the old asset also refers to it; use --in-place or another folder",
          quoted(replaced.front().path, 200))};
    }
    for (const ReplacedFile& file : replaced) {
      if (container::leads_out(file.path)) {
        return Error{fmt::format("{} is outside the asset's folder", quoted(file.path, 200))};
      }
      const fs::path target = folder_ / file.path;
      if (auto trouble = make_folder(target.parent_path())) return trouble;
      if (auto trouble = put_file(target, {file.after})) return trouble;
    }
    return std::nullopt;
  }

  Trouble copy_others() const {
    if (is_own_folder()) return std::nullopt;
    std::set<std::string> paths =
        asset_.companions ? *asset_.companions : referred_paths(asset_.old.document());
    paths.insert(asset_.referred.begin(), asset_.referred.end());
    paths.merge(paths_of_external_assets(asset_.old));
    for (const ReplacedFile& file : asset_.replaced) paths.erase(file.path);
    for (const NewFile& file : asset_.files) paths.erase(file.path);
    std::erase_if(paths, [this](const std::string& path) { return is_output(folder_ / path); });
    return copy_companions(paths, asset_.old.resolver(), folder_);
  }

  // Assets that refer to each other may all be written.
  bool is_output(const fs::path& file) const {
    const EditOptions& options = asset_.options;
    const fs::path target = file.lexically_normal();
    return target == fs::path(options.output).lexically_normal() ||
           (options.outputs && options.outputs->contains(target.native()));
  }

  const AssetWrite& asset_;
  const fs::path folder_;
};

}  // namespace

bool is_in_place(const EditOptions& options, const std::string& path) {
  std::error_code error;
  return options.in_place ||
         (!options.output.empty() && fs::equivalent(options.output, path, error));
}

Failures commit(const std::vector<AssetWrite>& assets) {
  Failures failures(assets.size());
  std::vector<const AssetWrite*> here;
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < assets.size(); ++i) {
    if (is_in_place(assets[i].options, assets[i].old.name())) {
      here.push_back(&assets[i]);
      positions.push_back(i);
    } else {
      failures[i] = Elsewhere(assets[i]).write();
    }
  }
  Failures replaced = write_in_place(here);
  for (std::size_t i = 0; i < here.size(); ++i) failures[positions[i]] = std::move(replaced[i]);
  return failures;
}

Trouble write_new_asset_file(const fs::path& target, std::string_view bytes) {
  std::error_code error;
  if (target.has_parent_path()) fs::create_directories(target.parent_path(), error);
  if (!error) return write_file(target, bytes);
  return Error{fmt::format("cannot create the folder of {}: {}", quoted(target.native(), 200),
                           error.message())};
}

fs::path target_folder(const std::string& path, const std::string& output) {
  const fs::path folder = fs::path(output.empty() ? path : output).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

}  // namespace gltfx::change

namespace gltfx {

std::string_view edit_problem_name(EditProblem problem) {
  constexpr std::array<std::string_view, 4> kNames{"none", "unreadable", "refused", "not written"};
  return kNames[static_cast<std::size_t>(problem)];
}

}  // namespace gltfx
