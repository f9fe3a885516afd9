// SPDX-License-Identifier: Apache-2.0
#include "compare_pairs.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "folder_walk.hpp"
#include "git_changes.hpp"
#include "pipeline/open_asset.hpp"
#include "staged_assets.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestPath = 200;

/// Names of an asset on both sides; an empty one: it is missing there.
struct NamePair {
  RepositoryName before, after;
  std::vector<RepositoryName> parents = {};  ///< that have it as an external asset
  bool is_parent = false;  ///< it did not change, but an external asset below it did
  const RepositoryName& key() const { return after.empty() ? before : after; }
};

// The places from which symbolic links of the commit lead to changed files.
std::set<RepositoryName> places_behind_links(GitTree& tree, const std::set<RepositoryName>& names) {
  std::set<RepositoryName> places;
  constexpr std::size_t kMostPlaces = 100'000;
  for (const auto& [link, entry] : tree.index().entries()) {
    if (entry.mode != kSymbolicLink) continue;
    const auto target = tree.follow(link);
    if (!target) continue;
    for (auto name = names.lower_bound(*target); name != names.end(); ++name) {
      if (!name->starts_with(*target) || places.size() >= kMostPlaces) break;
      const std::string rest = name->substr(target->size());
      if (rest.empty() || rest.front() == '/') places.insert(link + rest);
    }
  }
  return places;
}

/// Finds the pairs of names.
class GitPairSearch {
 public:
  explicit GitPairSearch(GitTree& before) : before_(before) {}

  std::optional<Error> run(const GitRange& range) {
    const auto changes = read_git_changes(before_.index().folder(), range);
    if (!changes) return changes.error();
    std::set<RepositoryName> names, others;
    for (const GitChange& change : *changes) {
      add(change);
      for (const RepositoryName& name : {change.before, change.after}) {
        if (!name.empty() && !is_asset_name(name)) others.insert(name);
      }
      if (change.file_before && is_asset_name(change.before)) names.insert(change.before);
      if (change.file_after && is_asset_name(change.after)) names.insert(change.after);
    }
    return add_owners(std::move(names), std::move(others));
  }

  /// Sorted by name.
  const std::map<RepositoryName, NamePair>& found() const { return found_; }
  /// Whether one of the assets below another one changed and is wanted.
  bool is_told_below(const RepositoryName& parent,
                     const std::function<bool(const NamePair&)>& wanted) const {
    std::set<RepositoryName> seen{parent};
    std::vector<RepositoryName> left{parent};
    while (!left.empty()) {
      const auto references = references_.find(left.back());
      left.pop_back();
      if (references == references_.end()) continue;
      for (const RepositoryName& name : references->second) {
        if (!seen.insert(name).second) continue;
        const auto child = found_.find(name);
        if (child == found_.end()) continue;
        if (!child->second.is_parent && wanted(child->second)) return true;
        left.push_back(name);
      }
    }
    return false;
  }

 private:
  void add(const GitChange& change) {
    NamePair pair;
    if (change.file_before && is_asset_name(change.before)) pair.before = change.before;
    if (change.file_after && is_asset_name(change.after)) pair.after = change.after;
    if (pair.key().empty()) return;
    changed_.insert(change.before);
    found_.emplace(pair.key(), pair);
  }

  // An asset that did not change refers to the same files on both sides.
  std::optional<Error> add_owners(std::set<RepositoryName> names, std::set<RepositoryName> others) {
    if (names.empty() && others.empty()) return std::nullopt;
    others.merge(places_behind_links(before_, others));
    names.insert(others.begin(), others.end());
    StagedAssets assets(before_.index());
    if (auto trouble = assets.find(names)) return trouble;
    const auto is_changed_file = [&](const auto& name) { return others.count(name) > 0; };
    for (const RepositoryName& name : assets.found()) {
      const auto references = assets.references().find(name);
      const bool known = before_.index().entries().count(name) > 0;
      if (references == assets.references().end()) continue;
      references_.emplace(name, references->second);
      if (!known || changed_.count(name) > 0) continue;
      const bool owns =
          std::any_of(references->second.begin(), references->second.end(), is_changed_file);
      found_.emplace(name, NamePair{name, name, {}, !owns});
    }
    for (const auto& [asset, references] : references_) {
      for (const RepositoryName& name : references) {
        const auto child = found_.find(name);
        if (child == found_.end() || asset == name) continue;
        if (!child->second.is_parent) child->second.parents.push_back(asset);
      }
    }
    return std::nullopt;
  }

  GitTree& before_;
  std::set<RepositoryName> changed_;  ///< assets by their old names
  std::map<RepositoryName, NamePair> found_;
  References references_;  ///< of found assets
};

/// Files and folders of the user.
class Restriction {
 public:
  static Result<Restriction> read(const std::string& top, const std::vector<std::string>& paths) {
    Restriction restriction;
    for (const std::string& path : paths) {
      std::error_code error;
      const fs::path whole = fs::absolute(path, error).lexically_normal();
      std::string name = whole.lexically_relative(top).native();
      if (error || name.empty() || name == ".." || name.starts_with("../")) {
        return Error{fmt::format("{} is outside the repository", quoted(path, kLongestPath))};
      }
      if (name == "." || name == "./") name.clear();
      if (name.ends_with('/')) name.pop_back();
      restriction.names_.push_back(std::move(name));
    }
    return restriction;
  }

  bool has(const RepositoryName& asset) const {
    return !asset.empty() &&
           (names_.empty() || std::any_of(names_.begin(), names_.end(), [&](const auto& name) {
              return name.empty() || asset == name || asset.starts_with(name + '/');
            }));
  }

 private:
  std::vector<RepositoryName> names_;  ///< an empty one: all
};

// Opens a file of the working tree, whose references may lead to all of the tree.
OpenCompared open_in_working_tree(std::string path, std::string top) {
  return [path = std::move(path), top = std::move(top)] {
    return open_asset(path, AssetBounds{top, nullptr});
  };
}

OpenCompared open_in_commit(GitTree& tree, RepositoryName name, std::string shown) {
  return
      [&tree, name = std::move(name), shown = std::move(shown)] { return tree.open(name, shown); };
}

}  // namespace

Result<GitPairs> find_git_pairs(const std::string& range, const std::vector<std::string>& paths) {
  const auto sides = read_git_range(range);
  if (!sides) return sides.error();
  GitPairs found;
  for (const GitRange::Commit& side : {sides->before, sides->after}) {
    if (side.id.empty()) continue;
    auto index = GitIndex::at(side.id);
    if (!index) return index.error();
    found.trees.push_back(std::make_unique<GitTree>(*std::move(index), side.name));
  }
  GitTree& before = *found.trees.front();
  const std::string& top = before.index().folder();
  const auto restriction = Restriction::read(top, paths);
  if (!restriction) return restriction.error();
  GitPairSearch search(before);
  if (auto trouble = search.run(*sides)) return *std::move(trouble);
  const auto wanted = [&](const NamePair& names) {
    return restriction->has(names.before) || restriction->has(names.after);
  };
  for (const auto& [key, names] : search.found()) {
    if (!wanted(names)) continue;
    // What changed is told once, at the external asset.
    if (names.is_parent && search.is_told_below(names.before, wanted)) continue;
    ComparePair pair;
    for (const RepositoryName& parent : names.parents) {
      pair.external_asset_of.push_back(before.index().path_of(parent));
    }
    if (!names.before.empty()) {
      pair.before = before.index().path_of(names.before);
      pair.open_before = open_in_commit(before, names.before, pair.before);
    }
    if (!names.after.empty()) {
      pair.after = before.index().path_of(names.after);
      pair.open_after = found.trees.size() > 1
                            ? open_in_commit(*found.trees[1], names.after, pair.after)
                            : open_in_working_tree(pair.after, top);
    }
    found.pairs.push_back(std::move(pair));
  }
  return found;
}

}  // namespace gltfx::tool
