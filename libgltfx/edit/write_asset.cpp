// SPDX-License-Identifier: Apache-2.0
#include "edit/write_asset.hpp"

#include <gltfx/edited_file.hpp>

#include <array>
#include <deque>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/replace_file.hpp"
#include "base/text.hpp"
#include "container/bytes.hpp"
#include "container/container.hpp"
#include "edit/companions.hpp"

namespace gltfx::edit {
namespace {

namespace fs = std::filesystem;
using Trouble = std::optional<Error>;
using Failure = std::optional<WriteFailure>;

Failure not_written(const Trouble& trouble) {
  if (!trouble) return std::nullopt;
  return WriteFailure{false, trouble->message};
}

class Writer {
 public:
  Writer(const OldAsset& old, const Destination& to, const NewBytes& bytes, const WriteCheck& check)
      : old_(old), to_(to), bytes_(bytes), check_(check) {}

  Failure run() const {
    std::error_code error;
    const bool in_place = to_.in_place || fs::equivalent(to_.output, old_.path, error);
    return in_place ? write_in_place() : write_elsewhere();
  }

 private:
  // The draft holds the new bytes, and these can take their place: made of what was read, checked
  // as they are on the disk, with the attributes of what they replace.
  Failure fill(FileDraft& draft) const {
    if (auto failure = not_written(container::write_pieces(draft, bytes_.pieces))) return failure;
    if (auto failure = not_written(changed_meanwhile())) return failure;
    if (check_) {
      auto written = container::open_file(container::adopt_regular(draft.reader()), old_.path);
      if (!written) return not_written(written.error());
      if (auto why = check_(*std::move(written))) return WriteFailure{true, *std::move(why)};
    }
    return not_written(draft.finish());
  }

  Trouble changed_meanwhile() const {
    const auto now = file_state(old_.path);
    if (!now) return now.error();
    if (*now == old_.state) return std::nullopt;
    return Error{"it was changed by another program since it was read; run again"};
  }

  Trouble write_files() const {
    const fs::path folder = target_folder(old_.path, to_.output);
    for (const NewFile& file : bytes_.files) {
      if (auto trouble = put_file(folder / file.path, file.content())) return trouble;
    }
    return std::nullopt;
  }

  Failure write_in_place() const {
    FileDraft draft(old_.path, old_.state);
    if (auto failure = fill(draft)) return failure;
    if (auto failure = not_written(write_files())) return failure;
    const fs::path copy = old_.path + ".bak";
    if (auto failure = not_written(to_.backup ? keep_old(copy, old_.path, old_.container.bytes)
                                              : std::nullopt)) {
      return failure;
    }
    if (auto failure = not_written(replace_files())) return failure;
    Failure failure = not_written(draft.publish());
    std::error_code ignored;
    if (failure && to_.backup) fs::remove(copy, ignored);
    return failure;
  }

  static Trouble keep_old(const fs::path& copy, const fs::path& path,
                          const container::Bytes& bytes) {
    FileDraft draft(copy, path);
    if (auto trouble = container::write_pieces(draft, {bytes})) return trouble;
    if (auto trouble = draft.finish()) return trouble;
    return draft.publish();
  }

  // All drafts are there before the first one takes its place.
  Trouble replace_files() const {
    const fs::path folder = target_folder(old_.path, {});
    std::deque<FileDraft> drafts;
    for (const ReplacedFile& file : bytes_.replaced) {
      const fs::path path = folder / file.path;
      FileDraft& draft = drafts.emplace_back(path, file.state);
      if (auto trouble = container::write_pieces(draft, {file.after})) return trouble;
      if (auto trouble = draft.finish()) return trouble;
      if (!to_.backup) continue;
      if (auto trouble = keep_old(path.native() + ".bak", path, file.before)) return trouble;
    }
    for (FileDraft& draft : drafts) {
      if (auto trouble = draft.publish()) return trouble;
    }
    return std::nullopt;
  }

  Failure write_elsewhere() const {
    const fs::path folder = target_folder(old_.path, to_.output);
    if (auto failure = not_written(make_folder(folder))) return failure;
    const auto seen = state_if_there(to_.output);
    if (!seen) return not_written(seen.error());
    FileDraft draft(to_.output, *seen);
    if (auto failure = fill(draft)) return failure;
    if (auto failure = not_written(write_replaced(folder))) return failure;
    if (auto failure = not_written(copy_others(folder))) return failure;
    if (auto failure = not_written(write_files())) return failure;
    return not_written(draft.publish());
  }

  bool is_own_folder(const fs::path& folder) const {
    std::error_code error;
    return fs::equivalent(folder, target_folder(old_.path, {}), error);
  }

  Trouble write_replaced(const fs::path& folder) const {
    if (bytes_.replaced.empty()) return std::nullopt;
    if (is_own_folder(folder)) {
      return Error{fmt::format(
          "{} would change, to which the old asset refers, too; use --in-place or another folder",
          quoted(bytes_.replaced.front().path, 200))};
    }
    for (const ReplacedFile& file : bytes_.replaced) {
      if (file.path.starts_with("..")) {
        return Error{fmt::format("{} lies outside the asset's folder", quoted(file.path, 200))};
      }
      const fs::path target = folder / file.path;
      if (auto trouble = make_folder(target.parent_path())) return trouble;
      if (auto trouble = put_file(target, file.after)) return trouble;
    }
    return std::nullopt;
  }

  Trouble copy_others(const fs::path& folder) const {
    if (is_own_folder(folder)) return std::nullopt;
    std::set<std::string> paths = referred_paths(old_.document());
    paths.insert(bytes_.referred.begin(), bytes_.referred.end());
    for (const ReplacedFile& file : bytes_.replaced) paths.erase(file.path);
    return copy_companions(paths, old_.resolver, folder);
  }

  const OldAsset& old_;
  const Destination& to_;
  const NewBytes& bytes_;
  const WriteCheck& check_;
};

}  // namespace

Failure write_asset(const OldAsset& old, const Destination& to, const NewBytes& bytes,
                    const WriteCheck& check) {
  return Writer(old, to, bytes, check).run();
}

fs::path target_folder(const std::string& path, const std::string& output) {
  const fs::path folder = fs::path(output.empty() ? path : output).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

}  // namespace gltfx::edit

namespace gltfx {

std::string_view edit_problem_name(EditProblem problem) {
  constexpr std::array<std::string_view, 4> kNames{"none", "unreadable", "refused", "not written"};
  return kNames[static_cast<std::size_t>(problem)];
}

}  // namespace gltfx
