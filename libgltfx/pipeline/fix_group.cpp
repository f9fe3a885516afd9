// SPDX-License-Identifier: Apache-2.0
#include "pipeline/fix_group.hpp"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "pipeline/edit_asset.hpp"
#include "pipeline/fix_member.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using change::ByteRange;

// Conflicts are resolved in that many steps; what is left then stays as it is altogether.
constexpr unsigned kMostSteps = 8;
// Assets that are no part of the run and whose own fixes are looked at.
constexpr std::size_t kMostNeighbours = 64;

/// Bytes of a file that are to stay as they are, and for whom.
struct Kept {
  std::string user;  ///< path of the asset that reads them
  std::vector<ByteRange> ranges;
  bool is_certain = true;  ///< false: the asset cannot be read, and may read anything
};

/// What may not be changed.
class KeptBytes {
 public:
  void add(const FileIdentity& file, const FixMember& user, std::vector<ByteRange> ranges) {
    kept_[file].push_back({user.path(), std::move(ranges), user.is_sound()});
  }

  // Why the asset at `path` may not change the file so. Another asset is named where there is one.
  std::optional<std::string> find_reason(const change::ReplacedFile& file,
                                         const std::string& path) const {
    const auto known = kept_.find(identity_of(file.state, file.path));
    if (known == kept_.end()) return std::nullopt;
    const auto changed = change::differences(file.before.text(), file.after.text());
    const Kept* found = nullptr;
    for (const Kept& kept : known->second) {
      if (change::ranges_touching(changed, kept.ranges).empty()) continue;
      if (found == nullptr || found->user == path) found = &kept;
    }
    if (found == nullptr) return std::nullopt;
    return fmt::format("{} {} the same bytes of {} as something else",
                       found->user == path ? "another asset" : quoted(found->user, 200),
                       found->is_certain ? "reads" : "cannot be read, and may read",
                       quoted(file.path, 200));
  }

 private:
  std::map<FileIdentity, std::vector<Kept>> kept_;
};

class Group {
 public:
  Group(const std::vector<EditInput>& assets, FixRun& run) : run_(run) {
    for (const EditInput& asset : assets) {
      FixOptions options = run.options;
      options.output = asset.output;
      auto opened = open_to_edit(asset.path, AssetBounds::of(options));
      members_.emplace_back(asset.path, std::move(opened), std::move(options), run.schemas);
    }
  }
  Group(EditedAsset asset, FixRun& run) : run_(run) {
    const std::string name = asset.asset.name();
    members_.emplace_back(name, std::move(asset), run.options, run.schemas);
  }

  std::vector<FixReport> fix() {
    for_each_member([this](FixMember& member) { plan(member); });
    find_readers();
    unsigned steps = 0;
    while (!resolve(steps < kMostSteps)) ++steps;
    write();
    std::vector<FixReport> reports;
    for (FixMember& member : members_) reports.push_back(member.take_report());
    return reports;
  }

  std::optional<Draft> take_first_draft() { return members_.front().take_draft(contents_); }

 private:
  template <class Work>
  void for_each_member(const Work& work) {
    parallel_ordered(
        members_.size(), run_.jobs, [&](std::size_t i) { work(members_[i]); }, [](std::size_t) {});
  }

  void plan(FixMember& member) const {
    member.plan([this, &member](const change::ReplacedFile& file) {
      return kept_.find_reason(file, member.path());
    });
    if (members_.size() > 1 || !member.changed_files().empty()) member.find_uses();
  }

  // Whether all agree on the new contents of files. Where they do not, the fixes of some are made
  // anew without what others object to.
  bool resolve(bool by_bytes) {
    find_contents();
    std::set<FileIdentity> disputed;
    for (auto& [file, content] : contents_) {
      if (merge(file, content, by_bytes)) continue;
      disputed.insert(file);
    }
    if (disputed.empty() && !find_worse_neighbours(disputed)) return true;
    for_each_member([&](FixMember& member) {
      for (const auto& [file, changed] : member.changed_files()) {
        if (disputed.contains(file) && kept_.find_reason(*changed, member.path())) {
          return plan(member);
        }
      }
    });
    return false;
  }

  void find_contents() {
    contents_.clear();
    for (FixMember& member : members_) {
      for (const auto& [file, changed] : member.changed_files()) {
        const auto [known, is_new] =
            contents_.try_emplace(file, NewContent{changed->state, changed->before, {}});
        if (is_new || known->second.state == changed->state) continue;
        member.fail(EditProblem::not_written,
                    fmt::format("{} was changed by another program since it was read; run again",
                                quoted(changed->path, 200)));
      }
    }
  }

  // Puts the corrections of all together. False: some object to that, and what they object to is
  // kept from now on.
  bool merge(const FileIdentity& file, NewContent& content, bool by_bytes) {
    std::vector<change::FileUser> users;
    std::vector<const FixMember*> readers;
    const auto add = [&](const FixMember& member, bool changes) {
      const auto use = member.uses().find(file);
      const bool is_known = use != member.uses().end();
      if (!is_known && member.is_sound()) return;
      const auto changed = member.changed_files();
      const auto own = changed.find(file);
      users.push_back({own == changed.end() ? content.before.text() : own->second->after.text(),
                       is_known ? use->second.reads : change::FileReads{true, {}}, changes});
      readers.push_back(&member);
    };
    for (const FixMember& member : members_) add(member, true);
    for (const FixMember& neighbour : neighbours_of(file, content)) add(neighbour, false);
    change::MergedFile merged = change::merge_changes(content.before.text(), users);
    for (auto& conflict : merged.conflicts) {
      if (!by_bytes) conflict.ranges = {{0, UINT64_MAX}};
      kept_.add(file, *readers[conflict.user], std::move(conflict.ranges));
    }
    content.after = container::Bytes::from_string(std::move(merged.content));
    return merged.conflicts.empty();
  }

  // Assets that are no part of the run and refer to the file where it lies. Those that read bytes
  // which would change are planned, to see whether they agree.
  const std::deque<FixMember>& neighbours_of(const FileIdentity& file, const NewContent& content) {
    const auto [known, is_new] = neighbours_.try_emplace(file);
    std::deque<FixMember>& found = known->second;
    if (!is_new) return found;
    const std::vector<ByteRange> changed = changed_ranges(file, content);
    std::size_t planned = 0;
    for (const std::string& path : paths_of_neighbours(file)) {
      FixOptions options = run_.options;
      options.in_place = options.diff = false;
      options.output.clear();
      auto opened = open_to_edit(path, AssetBounds::of(options));
      FixMember& neighbour =
          found.emplace_back(path, std::move(opened), std::move(options), run_.schemas);
      neighbour.find_uses();
      const auto use = neighbour.uses().find(file);
      if (use == neighbour.uses().end() || planned == kMostNeighbours) continue;
      if (change::ranges_read(use->second.reads, changed).empty()) continue;
      neighbour.plan(nullptr);
      neighbour.find_uses();
      ++planned;
    }
    return found;
  }

  std::vector<ByteRange> changed_ranges(const FileIdentity& file, const NewContent& content) const {
    std::vector<ByteRange> ranges;
    for (const FixMember& member : members_) {
      const auto changed = member.changed_files();
      const auto own = changed.find(file);
      if (own == changed.end()) continue;
      change::add_ranges(ranges,
                         change::differences(content.before.text(), own->second->after.text()));
    }
    return ranges;
  }

  std::vector<std::string> paths_of_neighbours(const FileIdentity& file) {
    std::set<fs::path> folders;
    std::set<FileIdentity> known;
    for (const FixMember& member : members_) {
      if (member.is_in_memory()) continue;
      if (const auto state = file_state(member.path())) known.insert(identity_of(*state, {}));
      const auto use = member.uses().find(file);
      if (use == member.uses().end() || !member.changes_files_in_place()) continue;
      const fs::path folder = change::target_folder(member.path(), {});
      folders.insert(folder);
      std::error_code error;
      for (const std::string& path : use->second.paths) {
        const fs::path real = fs::canonical(folder / path, error);
        if (!error) folders.insert(change::target_folder(real, {}));
      }
    }
    std::vector<std::string> paths;
    for (const fs::path& folder : folders) {
      for (std::string& path : run_.folders.naming(folder, {file})) {
        const auto state = file_state(path);
        const bool is_new = state && known.insert(identity_of(*state, {})).second;
        if (is_new) paths.push_back(std::move(path));
      }
    }
    return paths;
  }

  // Neighbours keep their text: with the new bytes it must not be worse than before.
  bool find_worse_neighbours(std::set<FileIdentity>& disputed) {
    for (const auto& [file, content] : contents_) {
      for (const FixMember& neighbour : neighbours_[file]) {
        const auto use = neighbour.uses().find(file);
        if (use == neighbour.uses().end()) continue;
        auto changed = change::ranges_read(
            use->second.reads, change::differences(content.before.text(), content.after.text()));
        if (changed.empty() || !neighbour.is_worse_with(contents_)) continue;
        kept_.add(file, neighbour, std::move(changed));
        disputed.insert(file);
      }
    }
    return !disputed.empty();
  }

  // An asset that is read as a file, too, would move its bytes.
  void find_readers() {
    for (FixMember& member : members_) {
      if (!member.replaces_asset()) continue;
      if (auto why = find_reader(member.path(), run_.folders)) {
        member.fail(EditProblem::refused, *std::move(why));
      }
    }
  }

  void write() {
    std::vector<change::AssetWrite> together;
    std::vector<FixMember*> writers;
    for (FixMember& member : members_) {
      auto asset = member.write(contents_);
      if (!asset) continue;
      if (asset->replaced.empty()) {
        member.note(change::commit({*asset}).front());
      } else {
        together.push_back(*std::move(asset));
        writers.push_back(&member);
      }
    }
    const auto failures = change::commit(together);
    for (std::size_t i = 0; i < writers.size(); ++i) writers[i]->note(failures[i]);
  }

  FixRun& run_;
  std::deque<FixMember> members_;
  std::map<FileIdentity, std::deque<FixMember>> neighbours_;
  KeptBytes kept_;
  NewContents contents_;
};

}  // namespace

std::vector<FixReport> fix_group(const std::vector<EditInput>& assets, FixRun& run) {
  return Group(assets, run).fix();
}

std::optional<Draft> fix_in_memory(EditedAsset asset, FixRun& run, FixReport& report) {
  Group group(std::move(asset), run);
  report = std::move(group.fix().front());
  return report.problem == EditProblem::none ? group.take_first_draft() : std::nullopt;
}

}  // namespace gltfx
