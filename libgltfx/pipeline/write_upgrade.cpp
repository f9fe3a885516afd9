// SPDX-License-Identifier: Apache-2.0
#include "pipeline/write_upgrade.hpp"

#include <system_error>
#include <utility>

#include "base/file_draft.hpp"
#include "base/replace_file.hpp"
#include "container/open_file.hpp"
#include "container/pieces.hpp"
#include "pipeline/companions.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using Trouble = std::optional<Error>;
using Failure = std::optional<UpgradeFailure>;
using Pieces = std::vector<container::Bytes>;

Failure not_written(const Trouble& trouble) {
  if (!trouble) return std::nullopt;
  return UpgradeFailure{UpgradeProblem::not_written, trouble->message};
}

class Writer {
 public:
  Writer(const UpgradeSource& source, const UpgradeOptions& options,
         const std::vector<upgrade::NewFile>& files, const Pieces& pieces,
         const UpgradeCheck& check)
      : source_(source), options_(options), files_(files), pieces_(pieces), check_(check) {}

  Failure run() const {
    std::error_code fault;
    const bool in_place = options_.in_place || fs::equivalent(options_.output, source_.path, fault);
    return in_place ? write_in_place() : write_elsewhere();
  }

 private:
  // The draft holds the new bytes, and these can take their place: made of what was read, checked
  // as they are on the disk, with the attributes of what they replace.
  Failure fill(FileDraft& draft) const {
    if (auto failure = not_written(container::write_pieces(draft, pieces_))) return failure;
    if (auto failure = not_written(changed_meanwhile())) return failure;
    if (check_) {
      const auto written =
          container::open_file(container::adopt_regular(draft.reader()), source_.path);
      if (!written) return not_written(written.error());
      if (auto why = check_(*written)) return UpgradeFailure{UpgradeProblem::refused, *why};
    }
    return not_written(draft.finish());
  }

  Trouble changed_meanwhile() const {
    const auto now = file_state(source_.path);
    if (!now) return now.error();
    if (*now == source_.state) return std::nullopt;
    return Error{"it was changed by another program since it was read; run again"};
  }

  Trouble write_files() const {
    for (const upgrade::NewFile& file : files_) {
      const fs::path folder = target_folder(source_.path, options_);
      if (auto trouble = put_file(folder / file.path, content_of(file))) return trouble;
    }
    return std::nullopt;
  }

  Failure write_in_place() const {
    FileDraft draft(source_.path, source_.state);
    if (auto failure = fill(draft)) return failure;
    if (auto failure = not_written(write_files())) return failure;
    const fs::path copy = source_.path + ".bak";
    if (auto failure = not_written(options_.backup ? keep_old(copy) : std::nullopt)) return failure;
    const Failure failure = not_written(draft.publish());
    std::error_code ignored;
    if (failure && options_.backup) fs::remove(copy, ignored);
    return failure;
  }

  Trouble keep_old(const fs::path& copy) const {
    FileDraft draft(copy, fs::path(source_.path));
    if (auto trouble = container::write_pieces(draft, {source_.container.bytes})) return trouble;
    if (auto trouble = draft.finish()) return trouble;
    return draft.publish();
  }

  Failure write_elsewhere() const {
    const fs::path folder = target_folder(source_.path, options_);
    if (auto failure = not_written(make_folder(folder))) return failure;
    const auto seen = state_if_there(options_.output);
    if (!seen) return not_written(seen.error());
    FileDraft draft(options_.output, *seen);
    if (auto failure = fill(draft)) return failure;
    if (auto failure = not_written(copy_others(folder))) return failure;
    if (auto failure = not_written(write_files())) return failure;
    return not_written(draft.publish());
  }

  Trouble copy_others(const fs::path& folder) const {
    const fs::path own = fs::path(source_.path).parent_path();
    std::error_code fault;
    if (fs::equivalent(folder, own.empty() ? fs::path(".") : own, fault)) return std::nullopt;
    return copy_companions(source_.document, source_.resolver, folder);
  }

  const UpgradeSource& source_;
  const UpgradeOptions& options_;
  const std::vector<upgrade::NewFile>& files_;
  const Pieces& pieces_;
  const UpgradeCheck& check_;
};

}  // namespace

Failure write_upgrade(const UpgradeSource& source, const UpgradeOptions& options,
                      const std::vector<upgrade::NewFile>& files, const Pieces& pieces,
                      const UpgradeCheck& check) {
  return Writer(source, options, files, pieces, check).run();
}

fs::path target_folder(const std::string& path, const UpgradeOptions& options) {
  const fs::path folder = fs::path(options.output.empty() ? path : options.output).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

}  // namespace gltfx
