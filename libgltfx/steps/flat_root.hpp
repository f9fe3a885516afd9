// SPDX-License-Identifier: Apache-2.0
/// An asset that takes up the parts of others.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "change/name_list.hpp"
#include "graph/graph.hpp"
#include "json/edit.hpp"
#include "model/external_assets.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// Collects what is added to an asset. Keeps a reference to its graph.
class FlatRoot {
 public:
  explicit FlatRoot(const graph::Graph& graph);

  json::Editor& editor() { return editor_; }
  /// Adds the elements of a list of another asset, whose references are moved.
  void add_list(const json::Document& other, const std::string& key);
  /// Adds what an asset has once: names of extensions, its copyright, and members of extensions of
  /// its root that are not lists. An Error, half a sentence, if these contradict each other.
  std::optional<Error> add_asset(const json::Document& other);
  /// Makes the edits of all that was added, and removes the external assets and their files.
  std::optional<Error> finish(const model::AssetInTree& own, ConvertStep& row);

 private:
  using Members = std::vector<std::pair<std::string, std::string>>;  ///< names and JSON

  std::optional<Error> add_member(const std::string& extension, std::string_view name,
                                  std::string_view json);
  std::optional<Error> put_lists();
  void put_extensions();
  void put_copyright();
  void drop_files(const model::AssetInTree& own, ConvertStep& row);
  bool is_used_elsewhere(json::NodeId file) const;

  const graph::Graph& graph_;
  const json::Document& document_;
  json::Editor editor_;
  change::NameList used_, required_;
  std::map<std::string, std::vector<std::string>> lists_;  ///< new elements, by key
  std::map<std::string, Members> extensions_;              ///< new members, by extension
  std::string copyright_;
};

}  // namespace gltfx::steps
