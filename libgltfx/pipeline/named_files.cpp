// SPDX-License-Identifier: Apache-2.0
#include "pipeline/named_files.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/directory.hpp"
#include "base/disjoint_sets.hpp"
#include "base/media_type.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "change/companions.hpp"
#include "container/container.hpp"
#include "json/parse.hpp"
#include "model/fields.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;

// What a search for neighbours of an asset may cost.
constexpr std::size_t kMostAssets = 4096;
constexpr std::size_t kMostText = std::size_t{256} << 20U;

fs::path folder_of(const fs::path& path) {
  return path.parent_path().empty() ? fs::path(".") : path.parent_path();
}

// The values of `uri` in the elements of an array for which `counts` is true.
template <class Counts>
std::set<json::NodeId> uris_in(const json::Document& document, std::string_view array,
                               const Counts& counts) {
  std::set<json::NodeId> values;
  const json::NodeId list = document.empty() || !document.is_object(document.root())
                                ? json::kNoNode
                                : document.find(document.root(), array);
  if (list == json::kNoNode || document.kind(list) != json::Kind::array) return values;
  for (const json::NodeId element : document.elements(list)) {
    if (document.is_object(element) && counts(element)) {
      values.insert(document.find(element, "uri"));
    }
  }
  return values;
}

// Adds the length of the text that was read to `cost`.
NamedFiles named_by(const std::string& path, const AssetBounds& bounds, std::size_t& cost) {
  NamedFiles named;
  named.path = path;
  const auto file = open_asset_file(path, bounds);
  named.unread = !file || file->error != container::ResolveError::none;
  if (named.unread) return named;
  named.own = identity_of(file->state, path);
  const auto container = container::open_file(*file, path);
  if (!container || !container->json) return named;
  const std::string_view text = *container->json;
  cost += text.size();
  if (text.find("uri") == text.npos && text.find("\\u") == text.npos) return named;
  const json::Parsed parsed = json::parse(container->json);
  if (parsed.document.empty()) return named;
  const json::Document& document = parsed.document;
  const std::set<json::NodeId> buffers =
      uris_in(document, "buffers", [](json::NodeId) { return true; });
  // An asset that is read as one does not depend on where its bytes are.
  const std::set<json::NodeId> assets = uris_in(document, "files", [&](json::NodeId referred) {
    const std::string type = model::string_member(document, referred, "mimeType");
    return type == kGltfMediaType || type == kGlbMediaType;
  });
  for (const auto& [value, name] : change::referred_files(parsed.document)) {
    if (assets.contains(value)) continue;
    const auto state = file_state(folder_of(path) / name);
    if (!state) continue;
    const FileIdentity referred = identity_of(*state, name);
    named.files.insert(referred);
    if (buffers.contains(value)) named.buffers.insert(referred);
  }
  return named;
}

}  // namespace

bool NamedFiles::names(const std::set<FileIdentity>& wanted) const {
  return std::any_of(wanted.begin(), wanted.end(),
                     [this](const FileIdentity& file) { return files.contains(file); });
}

std::vector<InputGroup> groups_of(const std::vector<std::string>& paths, const AssetBounds& bounds,
                                  unsigned jobs) {
  std::vector<NamedFiles> named(paths.size());
  if (paths.size() > 1) {
    parallel_ordered(
        paths.size(), jobs,
        [&](std::size_t i) {
          std::size_t cost = 0;
          named[i] = named_by(paths[i], bounds, cost);
        },
        [](std::size_t) {});
  }
  // Files that may change, and one of those that would change them.
  std::map<FileIdentity, std::size_t> changing;
  for (std::size_t i = 0; i < named.size(); ++i) {
    changing.emplace(named[i].own, i);
    for (const FileIdentity& file : named[i].buffers) changing.emplace(file, i);
  }
  DisjointSets groups(paths.size());
  for (std::size_t i = 0; i < named.size(); ++i) {
    if (named[i].own.inode != 0) named[i].files.insert(named[i].own);
    for (const FileIdentity& file : named[i].files) {
      if (const auto other = changing.find(file); other != changing.end()) {
        groups.join(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(other->second));
      }
    }
  }
  std::map<std::size_t, InputGroup> members;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    members[groups.find(static_cast<std::uint32_t>(i))].push_back(i);
  }
  std::vector<InputGroup> all;
  for (auto& [first, group] : members) all.push_back(std::move(group));
  return all;
}

FolderIndex::Folder FolderIndex::assets_in(const fs::path& folder) {
  Folder found;
  std::vector<std::string> names;
  DirectoryReader directory(folder.native());
  while (const char* entry = directory.next()) {
    const std::string ending = ending_of(entry);
    const bool is_asset = ending == ".gltf" || ending == ".glb" || ending == ".vrm";
    if (is_asset && directory.is_file()) names.emplace_back(entry);
    if (names.size() == kMostAssets) break;
  }
  if (directory.error()) {
    found.gap = fmt::format("the folder {} cannot be listed: {}", quoted(folder.native(), 200),
                            directory.error().message());
  }
  std::sort(names.begin(), names.end());
  std::size_t cost = 0;
  for (const std::string& name : names) {
    if (cost > kMostText) break;
    const std::string path = (folder / name).native();
    found.assets.push_back(named_by(path, {folder.native(), nullptr}, cost));
    if (found.assets.back().unread && found.gap.empty()) {
      found.gap = fmt::format("{} cannot be read", quoted(path, 200));
    }
  }
  return found;
}

// Precondition: the mutex is locked.
const FolderIndex::Folder& FolderIndex::read(const fs::path& folder) {
  auto known = folders_.find(folder);
  if (known == folders_.end()) known = folders_.emplace(folder, assets_in(folder)).first;
  return known->second;
}

std::string FolderIndex::find_gap(const fs::path& folder) {
  const std::lock_guard lock(mutex_);
  return read(folder).gap;
}

std::vector<std::string> FolderIndex::naming(const fs::path& folder,
                                             const std::set<FileIdentity>& files) {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> paths;
  for (const NamedFiles& asset : read(folder).assets) {
    if (asset.names(files)) paths.push_back(asset.path);
  }
  return paths;
}

std::string FolderIndex::reader_of(const std::string& path) {
  const auto state = file_state(path);
  if (!state) return {};
  for (std::string& asset : naming(folder_of(path), {identity_of(*state, path)})) {
    return std::move(asset);
  }
  return {};
}

}  // namespace gltfx
