// SPDX-License-Identifier: Apache-2.0
/// Bytes that objects lead to, hashed and compared.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "change/buffer_layout.hpp"
#include "graph/graph.hpp"
#include "model/accessor_data.hpp"
#include "model/asset_bytes.hpp"
#include "model/memory_budget.hpp"
#include "model/resource_data.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// The content of images, buffer views and accessors. Reads no more than a multiple of what the
/// asset has, however often objects share it; what is beyond that has no hash. Refers to all
/// arguments.
class DedupContent {
 public:
  DedupContent(const StepInput& input, const graph::Graph& graph, const model::Asset& elements);

  /// By index. Nothing: the bytes cannot be read.
  std::optional<std::string> hash_of_image(std::uint64_t index);
  bool same_images(std::uint64_t one, std::uint64_t other);

  /// All bytes that a view names, also by extensions on it.
  std::optional<std::string> hash_of_view(json::NodeId view);
  bool same_views(json::NodeId one, json::NodeId other);
  /// Whether it is known which bytes views name.
  bool knows_views() const { return users_known_; }
  /// What names bytes in an element of a root array: the element, and objects of extensions on it.
  const std::vector<change::BufferUser>& buffer_users(json::NodeId element) const;

  /// Of the elements, replaced ones included. Nothing: they cannot be read.
  std::optional<std::string> hash_of_accessor(std::uint32_t index);
  bool same_accessors(std::uint32_t one, std::uint32_t other);
  /// Whether an accessor is no more than elements in a view, of a format that is known, and what
  /// replaces them.
  bool has_elements(std::uint32_t accessor) const;

  /// Whether something was not read because too much is shared.
  bool is_exhausted() const { return exhausted_; }

 private:
  bool take(std::optional<std::uint64_t> bytes);
  std::optional<std::string> hash_of(const container::Bytes& bytes, std::string place);
  std::optional<container::Bytes> bytes_of(const change::BufferUser& user);
  bool has_place_of_its_own(json::NodeId view, const change::BufferUser& user) const;
  std::optional<model::AccessorData> open(std::uint32_t accessor) const;

  const model::Asset& elements_;
  const json::Document& document_;
  const model::Views& views_;
  model::AssetBytes bytes_;
  const model::ResourceData resources_;
  model::MemoryBudget budget_;
  bool exhausted_ = false;
  bool users_known_ = false;
  std::unordered_map<json::NodeId, std::vector<change::BufferUser>> users_;  ///< by element
  const std::vector<change::BufferUser> no_users_;
  std::map<std::string, std::string> hashes_;  ///< by place
  /// By view, what replaces elements, offset, count and format.
  std::map<
      std::tuple<std::uint32_t, json::NodeId, std::uint64_t, std::uint64_t, unsigned, unsigned>,
      std::string>
      accessor_hashes_;
};

}  // namespace gltfx::steps
