// SPDX-License-Identifier: Apache-2.0
#include "model/external_assets.hpp"

#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "container/opened_files.hpp"
#include "container/uri.hpp"
#include "model/fields.hpp"

namespace gltfx::model {
namespace {

using container::Bytes;
using container::Uri;
using container::UriKind;

// The objects of an array of the root.
std::vector<json::NodeId> objects_of(const json::Document& document, std::string_view name) {
  std::vector<json::NodeId> objects;
  if (document.empty()) return objects;
  const json::NodeId array = document.find(document.root(), name);
  if (array == json::kNoNode || document.kind(array) != json::Kind::array) return objects;
  for (const json::NodeId element : document.elements(array)) {
    objects.push_back(document.is_object(element) ? element : json::kNoNode);
  }
  return objects;
}

json::NodeId at(const std::vector<json::NodeId>& objects, std::uint64_t index) {
  return index < objects.size() ? objects[index] : json::kNoNode;
}

std::string folder_of(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string_view::npos ? std::string() : std::string(path.substr(0, slash + 1));
}

// The file name of an asset as its neighbours may name it.
std::string file_name(std::string_view name) {
  const std::size_t slash = name.rfind('/');
  return std::string(slash == std::string_view::npos ? name : name.substr(slash + 1));
}

// The asset is no file that it refers to: the look-up is not recorded.
FileIdentity identity_of_first(const OpenedAsset& asset) {
  const std::string name = file_name(asset.name());
  container::Resolver resolver = asset.resolver();
  resolver.record(nullptr);
  return identity_of(resolver.state(name), name);
}

std::string place_in(const AssetInTree& parent, std::uint32_t index) {
  return fmt::format("{}#/files/{}", parent.asset().name(), index);
}

FileIdentity identity_in(const AssetInTree& parent, std::uint32_t index) {
  FileIdentity identity = parent.identity();
  identity.path += fmt::format("#/files/{}", index);
  return identity;
}

std::string text_of(const FileIdentity& identity) {
  return fmt::format("{}:{}:{}", identity.device, identity.inode, identity.path);
}

std::string text_of(const std::map<std::string, ReferredFile, std::less<>>& aliases) {
  std::string text;
  for (const auto& [alias, target] : aliases) {
    text += fmt::format("{}:{}={};", alias.size(), alias, text_of(target.identity));
  }
  return text;
}

container::Format format_of(std::string_view media_type) {
  return media_type == "model/gltf-binary" ? container::Format::glb : container::Format::gltf;
}

}  // namespace

AssetInTree::AssetInTree(const OpenedAsset& asset, FileIdentity identity, Aliases aliases,
                         std::size_t depth)
    : asset_(&asset),
      identity_(std::move(identity)),
      aliases_(std::move(aliases)),
      depth_(depth),
      files_(objects_of(asset.document(), "files")),
      external_assets_(objects_of(asset.document(), "externalAssets")) {}

std::optional<std::uint32_t> AssetInTree::file_of(std::uint32_t external_asset) const {
  const json::NodeId object = at(external_assets_, external_asset);
  const auto file = unsigned_member(asset_->document(), object, "file");
  if (!file || *file >= files_.size()) return std::nullopt;
  return static_cast<std::uint32_t>(*file);
}

std::string AssetInTree::aliases() const { return text_of(aliases_); }

ExternalAssets::ExternalAssets(const OpenedAsset& asset) {
  FileIdentity identity = identity_of_first(asset);
  assets_.push_back(
      std::unique_ptr<AssetInTree>(new AssetInTree(asset, identity, AssetInTree::Aliases(), 0)));
  root_ = assets_.back().get();
  files_on_disk_.insert(identity);
  names_.insert(asset.name());
  bytes_on_disk_ = asset.container().bytes.size();
  known_.emplace(std::pair(std::move(identity), std::string()), root_);
}

ExternalAssets::~ExternalAssets() = default;

const Result<ReferredFile>& ExternalAssets::file(AssetInTree& parent, std::uint32_t index) {
  const auto known = parent.opened_files_.find(index);
  if (known != parent.opened_files_.end()) return known->second;
  return parent.opened_files_.emplace(index, open(parent, index)).first->second;
}

Result<ReferredFile> ExternalAssets::open(AssetInTree& parent, std::uint32_t index) {
  const json::Document& document = parent.asset().document();
  const json::NodeId object = at(parent.files_, index);
  if (object == json::kNoNode) return Error{fmt::format("there is no file {}", index)};
  const json::NodeId uri = document.find(object, "uri");
  if (uri != json::kNoNode && document.is_string(uri)) {
    return open_uri(parent, index, document.string(uri));
  }
  if (!parent.bytes_) {
    parent.tables_ = std::make_unique<const Asset>(document);
    parent.bytes_ = std::make_unique<AssetBytes>(*parent.tables_, parent.asset().container(),
                                                 parent.asset().resolver());
  }
  auto bytes = parent.bytes_->view_of(object);
  if (!bytes) return bytes.error();
  return ReferredFile{*std::move(bytes), identity_in(parent, index), place_in(parent, index),
                      parent.asset().resolver().without_aliases(), parent.depth_ + 1};
}

Result<ReferredFile> ExternalAssets::open_uri(AssetInTree& parent, std::uint32_t index,
                                              const std::string& uri) {
  const auto alias = parent.aliases_.find(uri);
  if (alias != parent.aliases_.end()) return alias->second;
  const container::Resolver& resolver = parent.asset().resolver();
  const Uri reference = container::classify_uri(uri);
  if (reference.kind == UriKind::relative_path) {
    const std::string place = resolver.place_of(reference.path);
    const auto known = by_place_.find(place);
    if (known != by_place_.end()) return known->second;
    return by_place_.emplace(place, open_path(resolver, reference)).first->second;
  }
  auto bytes = container::fetch(resolver, uri);
  if (!bytes) return bytes.error();
  return ReferredFile{*std::move(bytes), identity_in(parent, index), place_in(parent, index),
                      resolver.without_aliases(), parent.depth_ + 1};
}

Result<ReferredFile> ExternalAssets::open_path(const container::Resolver& resolver,
                                               const Uri& uri) {
  // Another spelling is no alias.
  auto bytes = container::fetch(resolver.without_aliases(), uri.normalized);
  if (!bytes) return bytes.error();
  const std::string place = resolver.place_of(uri.path);
  return ReferredFile{*std::move(bytes), identity_of(resolver.state(uri.path), place),
                      folder_of(root_->asset().name()) + place, resolver.in_folder_of(uri.path), 0};
}

// Why a file is not opened as an asset: nested packages and aliases could make a small file endless
// work.
std::optional<Error> ExternalAssets::find_excess(const ReferredFile& file) {
  if (assets_.size() > kMost) {
    return Error{fmt::format("more than {} external assets are not opened", kMost)};
  }
  if (file.depth > kDeepest) {
    return Error{fmt::format("an asset inside more than {} others is not opened", kDeepest)};
  }
  if (file.depth == 0 && files_on_disk_.insert(file.identity).second) {
    bytes_on_disk_ += file.bytes.size();
  }
  const std::uint64_t more = saturating_add(opened_bytes_, file.bytes.size());
  if (more > saturating_add(kTimesOpened * bytes_on_disk_, kBytesMore)) {
    return Error{
        fmt::format("external assets of more than {} times the size of their files are "
                    "not opened",
                    kTimesOpened)};
  }
  opened_bytes_ = more;
  return std::nullopt;
}

AssetInTree::Aliases ExternalAssets::aliases_of(AssetInTree& parent, json::NodeId file) {
  AssetInTree::Aliases aliases;
  const json::Document& document = parent.asset().document();
  const json::NodeId list = document.find(file, "aliases");
  if (list == json::kNoNode || document.kind(list) != json::Kind::array) return aliases;
  for (const json::NodeId entry : document.elements(list)) {
    if (!document.is_object(entry)) continue;
    const json::NodeId alias = document.find(entry, "alias");
    const auto target = unsigned_member(document, entry, "file");
    if (alias == json::kNoNode || !document.is_string(alias) || !target) continue;
    if (*target >= parent.files_.size()) continue;
    const auto& contents = this->file(parent, static_cast<std::uint32_t>(*target));
    if (contents) aliases.emplace(document.string(alias), *contents);  // the first of equal ones
  }
  return aliases;
}

const Result<AssetInTree*>& ExternalAssets::asset(AssetInTree& parent, std::uint32_t file) {
  const auto known = parent.children_.find(file);
  if (known != parent.children_.end()) return known->second;
  return parent.children_.emplace(file, open_asset(parent, file)).first->second;
}

Result<AssetInTree*> ExternalAssets::open_asset(AssetInTree& parent, std::uint32_t file) {
  const auto& contents = this->file(parent, file);
  if (!contents) return contents.error();
  const json::NodeId object = parent.files_[file];
  AssetInTree::Aliases aliases = aliases_of(parent, object);
  std::pair whole(contents->identity, text_of(aliases));
  const auto known = known_.find(whole);
  if (known != known_.end()) return known->second;
  if (auto excess = find_excess(*contents)) return *std::move(excess);
  container::Resolver resolver = contents->resolver;
  for (const auto& [alias, target] : aliases) resolver.add_alias(alias, target.bytes);
  // A file that is opened again with other aliases is another asset.
  std::string name = contents->name;
  if (!names_.insert(name).second) name = place_in(parent, file);
  const std::string type = string_member(parent.asset().document(), object, "mimeType");
  container::Container opened = container::open_bytes(contents->bytes, name);
  if (opened.format == container::Format::unknown) {
    opened = container::open_bytes(contents->bytes, format_of(type));
  }
  auto asset =
      std::make_unique<const OpenedAsset>(std::move(name), std::move(opened), std::move(resolver));
  assets_.push_back(std::unique_ptr<AssetInTree>(
      new AssetInTree(*asset, contents->identity, std::move(aliases), contents->depth)));
  AssetInTree* const made = assets_.back().get();
  made->owned_ = std::move(asset);
  known_.emplace(std::move(whole), made);
  return made;
}

}  // namespace gltfx::model
