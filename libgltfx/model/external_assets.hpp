// SPDX-License-Identifier: Apache-2.0
/// The assets that an asset refers to (glTF 2.1, "External assets"), and its other files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/file_state.hpp"
#include "base/result.hpp"
#include "container/resolver.hpp"
#include "model/asset.hpp"
#include "model/asset_bytes.hpp"
#include "model/opened_asset.hpp"

namespace gltfx::model {

/// The contents of an element of `files`.
struct ReferredFile {
  container::Bytes bytes;
  /// Of a file in a buffer view or a data URI, its place in the asset that holds it. A file has one
  /// identity, whatever its URI or alias.
  FileIdentity identity;
  std::string name;              ///< for reports: a path, or "parent.gltf#/files/0"
  container::Resolver resolver;  ///< of the references in it
  std::size_t depth = 0;         ///< 0: a file of its own; 1: inside one; and so on
};

/// An asset, and where its references lead. `identity` is that of its file.
class AssetInTree {
 public:
  const OpenedAsset& asset() const { return *asset_; }
  const FileIdentity& identity() const { return identity_; }
  /// The elements of `files` and `externalAssets` that are objects; json::kNoNode for others.
  const std::vector<json::NodeId>& files() const { return files_; }
  const std::vector<json::NodeId>& external_assets() const { return external_assets_; }
  /// The element of `files` that an element of `externalAssets` names; nothing: out of range.
  std::optional<std::uint32_t> file_of(std::uint32_t external_asset) const;
  /// The aliases that it was opened with, and their files.
  std::string aliases() const;

 private:
  friend class ExternalAssets;
  using Aliases = std::map<std::string, ReferredFile, std::less<>>;
  AssetInTree(const OpenedAsset& asset, FileIdentity identity, Aliases aliases, std::size_t depth);

  std::unique_ptr<const OpenedAsset> owned_;  ///< null: the first asset
  const OpenedAsset* asset_;
  FileIdentity identity_;
  Aliases aliases_;
  std::size_t depth_;  ///< ReferredFile::depth
  std::vector<json::NodeId> files_, external_assets_;
  std::unique_ptr<const Asset> tables_;
  std::unique_ptr<AssetBytes> bytes_;
  std::map<std::uint32_t, Result<ReferredFile>> opened_files_;
  std::map<std::uint32_t, Result<AssetInTree*>> children_;  ///< by file
};

/// Opens the assets below an asset at first use, each once for each set of aliases. References that
/// it returns stay valid. A cycle is not refused: callers compare the identities of the assets
/// above. Not thread-safe.
class ExternalAssets {
 public:
  /// More are not opened.
  static constexpr std::size_t kMost = 10'000;
  /// An asset that lies in that many others, one inside the next, is not opened.
  static constexpr std::size_t kDeepest = 64;
  /// An asset whose aliases differ is opened again, and views may overlap. What is opened has at
  /// most so many times the bytes of the files on the disk, and this many bytes more.
  static constexpr std::uint64_t kTimesOpened = 16, kBytesMore = std::uint64_t{64} << 20U;

  /// Keeps a reference to the asset.
  explicit ExternalAssets(const OpenedAsset& asset);
  ~ExternalAssets();

  AssetInTree& root() { return *root_; }
  /// The contents of an element of `files`, or a sentence about why there are none, with or without
  /// its full stop. Files are read inside the root of the first asset only.
  const Result<ReferredFile>& file(AssetInTree& parent, std::uint32_t index);
  /// The asset in an element of `files`; whether it has a text is not checked.
  const Result<AssetInTree*>& asset(AssetInTree& parent, std::uint32_t file);
  /// The assets that were opened, the first one included.
  std::size_t count() const { return assets_.size(); }

 private:
  Result<ReferredFile> open(AssetInTree& parent, std::uint32_t index);
  Result<ReferredFile> open_uri(AssetInTree& parent, std::uint32_t index, const std::string& uri);
  Result<ReferredFile> open_path(const container::Resolver& resolver, const container::Uri& uri);
  AssetInTree::Aliases aliases_of(AssetInTree& parent, json::NodeId file);
  Result<AssetInTree*> open_asset(AssetInTree& parent, std::uint32_t file);
  std::optional<Error> find_excess(const ReferredFile& file);

  std::vector<std::unique_ptr<AssetInTree>> assets_;
  AssetInTree* root_;
  /// By identity and aliases.
  std::map<std::pair<FileIdentity, std::string>, AssetInTree*> known_;
  std::map<std::string, Result<ReferredFile>> by_place_;  ///< files of their own, as place_of()
  std::set<FileIdentity> files_on_disk_;
  std::set<std::string, std::less<>> names_;
  std::uint64_t opened_bytes_ = 0, bytes_on_disk_ = 0;
};

}  // namespace gltfx::model
