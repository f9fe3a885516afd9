// SPDX-License-Identifier: Apache-2.0
#include "staged_assets.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "change/companions.hpp"
#include "container/container.hpp"
#include "folder_walk.hpp"
#include "json/parse.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

// Endings of files that assets refer to. Assets may refer to any name, but a commit of source files
// should not cause a search of the whole index.
constexpr std::array<std::string_view, 12> kCompanions{".bin",  ".png",  ".jpg", ".jpeg",
                                                       ".webp", ".ktx2", ".ktx", ".basis",
                                                       ".dds",  ".avif", ".tga", ".glbin"};

bool is_companion_name(const RepositoryName& name) {
  const std::string ending = ending_of(name);
  return std::find(kCompanions.begin(), kCompanions.end(), ending) != kCompanions.end();
}

std::string_view folder_of(std::string_view name) {
  return name.substr(0, name.rfind('/') + 1);  // with its '/', or empty
}

// Whether one of the references is one of the names, or below it (a submodule).
bool leads_to(const std::set<RepositoryName>& references, const std::set<RepositoryName>& names) {
  return std::any_of(references.begin(), references.end(), [&](const RepositoryName& reference) {
    for (std::size_t end = reference.size(); end != std::string::npos && end > 0;
         end = reference.rfind('/', end - 1)) {
      if (names.count(reference.substr(0, end)) > 0) return true;
    }
    return false;
  });
}

}  // namespace

std::optional<Error> StagedAssets::find(const std::set<RepositoryName>& names) {
  std::set<RepositoryName> others;
  std::set<RepositoryName> changed;  // assets, which may be external assets of others
  for (const RepositoryName& name : names) {
    const auto entry = index_.entries().find(name);
    const bool submodule = entry != index_.entries().end() && index_.file(name) == nullptr;
    std::error_code error;
    if (is_companion_name(name) || submodule) {
      others.insert(name);
    } else if (is_asset_name(name)) {
      changed.insert(name);
      const bool there = entry != index_.entries().end() || fs::exists(index_.path_of(name), error);
      if (there) found_.insert(name);
    }
  }
  std::vector<RepositoryName> wanted;
  for (const auto& [name, entry] : index_.entries()) {
    if (is_asset_name(name) && (!others.empty() || !changed.empty())) wanted.push_back(name);
  }
  auto trouble = index_.read(wanted, [&](const RepositoryName& name, std::string&& bytes) {
    note(name, std::move(bytes));
  });
  if (trouble) return trouble;
  for (const auto& [asset, references] : references_) {
    if (leads_to(references, others)) found_.insert(asset);
  }
  changed.insert(found_.begin(), found_.end());
  add_parents_of(changed);
  for (const RepositoryName& asset : found_) {
    if (index_.file(asset) == nullptr) note_file(asset);
  }
  return std::nullopt;
}

// What an asset shows depends on all external assets below it.
void StagedAssets::add_parents_of(const std::set<RepositoryName>& assets) {
  std::map<RepositoryName, std::vector<RepositoryName>> parents;
  for (const auto& [asset, references] : references_) {
    for (const RepositoryName& name : references) {
      if (is_asset_name(name)) parents[name].push_back(asset);
    }
  }
  std::vector<RepositoryName> left(assets.begin(), assets.end());
  while (!left.empty()) {
    const RepositoryName name = std::move(left.back());
    left.pop_back();
    for (const RepositoryName& parent : parents[name]) {
      if (found_.insert(parent).second) left.push_back(parent);
    }
  }
}

void StagedAssets::look_at_files(const std::set<RepositoryName>& but) {
  for (const RepositoryName& asset : found_) {
    if (but.count(asset) == 0) note_file(asset);
  }
}

void StagedAssets::note_file(const RepositoryName& asset) {
  const auto opened = container::open_file(index_.path_of(asset));
  if (opened && opened->json) note(asset, std::string(*opened->json));
}

void StagedAssets::note(const RepositoryName& asset, std::string&& bytes) {
  const auto opened = container::open_bytes(container::Bytes::from_string(std::move(bytes)), asset);
  if (opened.format == container::Format::git_lfs_pointer) return note_file(asset);
  std::set<RepositoryName>& references = references_[asset];
  references.clear();
  if (!opened.json) return;
  const json::Parsed parsed = json::parse(opened.json);
  if (parsed.document.empty()) return;
  for (const std::string& path : change::referred_paths(parsed.document)) {
    const fs::path whole = (fs::path(folder_of(asset)) / path).lexically_normal();
    if (*whole.begin() != "..") references.insert(whole.native());
  }
}

namespace {

/// Visits every reference of the assets once.
class Check {
 public:
  Check(const GitIndex& index, const StagedAssets& assets) : index_(index), assets_(assets) {}

  Result<CommitCheck> run(const std::map<RepositoryName, char>& staged) {
    for (const RepositoryName& asset : assets_.found()) {
      const auto references = assets_.references().find(asset);
      if (references == assets_.references().end()) continue;
      for (const RepositoryName& name : references->second) look_at(asset, name, staged);
    }
    leave_out_ignored();
    if (auto trouble = find_lfs()) return *std::move(trouble);
    return std::move(check_);
  }

 private:
  void look_at(const RepositoryName& asset, const RepositoryName& name,
               const std::map<RepositoryName, char>& staged) {
    if (index_.leads_elsewhere(name)) return;
    const bool known = index_.entries().count(name) > 0;
    const auto change = staged.find(name);
    if (!known || (change != staged.end() && change->second == 'A')) fresh_.emplace(name, asset);
    if (known) return;
    std::error_code error;
    if (fs::exists(index_.path_of(name), error)) {
      check_.to_stage.insert(name);
      owners_.emplace(name, asset);
    } else {
      check_.missing.emplace(name, asset);
    }
  }

  void leave_out_ignored() {
    std::set<RepositoryName> names = check_.to_stage;
    for (const auto& [name, asset] : check_.missing) names.insert(name);
    for (const RepositoryName& name : index_.ignored(names)) {
      const auto missing = check_.missing.find(name);
      check_.ignored.emplace(name,
                             missing == check_.missing.end() ? owners_[name] : missing->second);
      check_.missing.erase(name);
      check_.to_stage.erase(name);
      fresh_.erase(name);
    }
  }

  // Files beside a new one: those in its folder, and others that the asset refers to.
  std::set<RepositoryName> siblings_of(const RepositoryName& name, const RepositoryName& asset) {
    std::set<RepositoryName> siblings = assets_.references().at(asset);
    const std::string folder(folder_of(name));
    const auto& entries = index_.entries();
    for (auto entry = entries.lower_bound(folder);
         entry != entries.end() && entry->first.starts_with(folder); ++entry) {
      const bool same_folder = folder_of(entry->first) == folder;
      if (same_folder && is_companion_name(entry->first)) siblings.insert(entry->first);
    }
    for (const auto& [other, owner] : fresh_) siblings.erase(other);
    return siblings;
  }

  std::optional<Error> find_lfs() {
    std::set<RepositoryName> asked;
    std::map<RepositoryName, std::set<RepositoryName>> siblings;
    for (const auto& [name, asset] : fresh_) {
      std::set<RepositoryName>& beside = siblings[name] = siblings_of(name, asset);
      asked.insert(name);
      asked.insert(beside.begin(), beside.end());
    }
    const auto kept = index_.kept_by_lfs(asked);
    if (!kept) return kept.error();
    for (const auto& [name, beside] : siblings) {
      if (kept->count(name) > 0) continue;
      const auto other = std::find_if(beside.begin(), beside.end(),
                                      [&](const auto& one) { return kept->count(one) > 0; });
      if (other != beside.end()) check_.not_lfs.emplace(name, *other);
    }
    return std::nullopt;
  }

  const GitIndex& index_;
  const StagedAssets& assets_;
  CommitCheck check_;
  std::map<RepositoryName, RepositoryName> owners_;  ///< an asset that refers to the name
  std::map<RepositoryName, RepositoryName> fresh_;   ///< the same, for names that are not committed
};

}  // namespace

Result<CommitCheck> check_commit(const GitIndex& index, const StagedAssets& assets,
                                 const std::map<RepositoryName, char>& staged) {
  return Check(index, assets).run(staged);
}

std::string shell_word(std::string_view text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+@%,=:-";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string_view::npos) {
    return std::string(text);
  }
  std::string word;
  if (printable(text) == text) {
    for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return "'" + word + "'";
  }
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= 0x20 && byte < 0x7F && c != '\'' && c != '\\';
    word += plain ? std::string(1, c) : fmt::format("\\{:03o}", byte);
  }
  return "$'" + word + "'";
}

}  // namespace gltfx::tool
