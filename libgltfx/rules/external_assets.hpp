// SPDX-License-Identifier: Apache-2.0
/// The external assets below an asset (glTF 2.1): which of them refer to each other in a cycle, and
/// the reports on them.
#pragma once

#include <gltfx/report.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/file_state.hpp"
#include "model/external_assets.hpp"

namespace gltfx::validate {

/// An element of `externalAssets` whose file exists.
struct ExternalLink {
  std::uint32_t index = 0;    ///< of the element
  std::uint32_t file = 0;     ///< its element of `files`
  std::string name;           ///< of the asset in messages
  std::uint64_t errors = 0;   ///< of the asset
  std::string not_opened;     ///< the limit that it exceeds; usually empty
  std::string closed_circle;  ///< the files of the cycle into which it leads; usually empty
};

/// The external assets of one asset, for its report.
struct ExternalLinks {
  std::vector<ExternalLink> links;
  /// Positions in `files` and in `aliases` of those that no URI of the referred file equals.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> unused_aliases;
};

/// Opens and validates all assets below an asset, each once, those without external assets first.
/// Not recursive; ExternalAssets has limits.
class ExternalTree {
 public:
  using Validate = std::function<FileReport(const model::AssetInTree&, const ExternalLinks&)>;
  ExternalTree(const model::OpenedAsset& named, Validate validate);

  /// Those of the named asset.
  const ExternalLinks& links() const { return nodes_.at(&assets_.root()).links; }
  /// On all others, in the order in which the named asset leads to them.
  std::vector<FileReport> take_reports();

 private:
  struct Node {
    model::AssetInTree* asset = nullptr;
    ExternalLinks links{};
    std::vector<Node*> leads_to{};  ///< by link; null: nowhere, or into a cycle
    std::size_t next = 0;           ///< the link to follow
    bool done = false;
    std::string circle{};
    FileReport report{};
    /// Of its text, at first use.
    std::shared_ptr<const std::set<std::string, std::less<>>> uris{};
  };

  void enter(model::AssetInTree& asset);
  void follow(Node& node);
  void leave();
  void find_unused_aliases(Node& node);
  std::string circle_from(std::size_t place) const;
  /// From the folder of the named asset on, wherever that lies.
  std::string name_of(const model::AssetInTree& asset) const;

  mutable model::ExternalAssets assets_;
  Validate validate_;
  std::map<const model::AssetInTree*, Node> nodes_;
  std::vector<Node*> met_;
  std::vector<Node*> path_;
  std::map<FileIdentity, std::size_t> places_;  ///< in the path
};

}  // namespace gltfx::validate
