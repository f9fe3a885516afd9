// SPDX-License-Identifier: Apache-2.0
/// An asset that another one shows, as the parts that are copied into that one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "change/change.hpp"
#include "graph/graph.hpp"
#include "model/external_assets.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// A list of the root, or of an extension of the root, whose elements are referred to by position.
struct ChildList {
  std::string key;  ///< its pointer: "/nodes", "/extensions/NAME/lights"
  json::NodeId node = json::kNoNode;
  std::uint64_t size = 0;
  bool per_place = false;  ///< its elements lead to nodes, and so are copied for each place
};

/// Positions in the new asset, by list of the child: where the first element of each is.
using ListBases = std::vector<std::uint64_t>;

/// Names for the files of new bytes, which exist between steps only.
struct NewPaths {
  std::set<std::string> taken;
  std::uint64_t next = 0;
  std::set<const std::byte*> aliased = {};  ///< contents of aliases, each once
  std::uint64_t aliased_bytes = 0;          ///< of these
  std::uint64_t copied_bytes = 0;           ///< of all buffers and images with an alias
};

class FlatChild {
 public:
  FlatChild(model::AssetInTree& tree, const schema::Set& set);

  model::AssetInTree& tree() const { return tree_; }
  const model::OpenedAsset& asset() const { return tree_.asset(); }
  const graph::Graph& graph() const { return graph_; }
  const std::vector<ChildList>& lists() const { return lists_; }
  /// The nodes that show an external asset, with its index.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& shown() const { return shown_; }
  /// The nodes of the scene to show, by index.
  const std::vector<std::uint32_t>& roots() const { return roots_; }
  /// The object of a node.
  json::NodeId node(std::uint32_t index) const;

  /// Why its indices cannot change, half a sentence; nothing: they can.
  std::optional<std::string> find_obstacle() const;
  /// Plans the edits of its URIs; bytes without a file of their own become files of `change`.
  std::optional<Error> move_files(NewPaths& paths, change::Change& change);
  /// The losses of a copy: what only belongs to its own asset or scene.
  void list_losses(std::vector<ConvertLoss>& losses) const;
  /// Adds the edits of all references, and those of move_files(), for elements with these bases.
  void move_indices(const ListBases& bases, json::Editor& editor) const;

 private:
  void read_lists();
  void add_list(std::string key, json::NodeId node);
  void mark_per_place();
  void read_scene();
  std::optional<std::size_t> list_around(json::NodeId value) const;
  std::optional<Error> move_buffers(model::AssetBytes& bytes, NewPaths& paths,
                                    change::Change& change);
  std::optional<Error> move_uris(model::AssetBytes& bytes, NewPaths& paths);

  struct NewText {
    json::NodeId value;
    std::string json;
  };

  model::AssetInTree& tree_;
  const json::Document& document_;
  const model::Asset elements_;
  const graph::Graph graph_;
  std::vector<ChildList> lists_;
  std::map<json::NodeId, std::size_t> by_begin_;  ///< positions in lists_, by their first node
  std::vector<std::pair<std::uint32_t, std::uint32_t>> shown_;
  std::vector<std::uint32_t> roots_;
  std::vector<NewText> texts_;                                  ///< values to replace
  std::vector<std::pair<json::NodeId, std::string>> uris_;      ///< to add to buffers
  std::vector<std::pair<json::NodeId, json::NodeId>> removed_;  ///< objects and members
  std::set<json::NodeId> moved_uris_;  ///< values of buffers and images that are dealt with
};

/// Why references of a document lead nowhere, half a sentence; nothing: they all have a target.
std::optional<std::string> find_dangling_index(const graph::Graph& graph);

}  // namespace gltfx::steps
