// SPDX-License-Identifier: Apache-2.0
/// Hashes and compares the bytes that objects refer to.
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

/// The content of images, buffer views and accessors. Reads at most a multiple of the size of the
/// asset, however often objects share bytes; content beyond that limit has no hash. Keeps
/// references to all arguments.
class DedupContent {
 public:
  DedupContent(const StepInput& input, const graph::Graph& graph, const model::Asset& elements);

  /// The hash of the image with this index; nothing if its bytes cannot be read, which is added to
  /// StepInput::unread.
  std::optional<std::string> hash_of_image(std::uint64_t index);
  bool same_images(std::uint64_t one, std::uint64_t other);

  /// The hash of all bytes that a view refers to, directly and through its extensions.
  std::optional<std::string> hash_of_view(json::NodeId view);
  bool same_views(json::NodeId one, json::NodeId other);
  /// Whether the byte ranges of all views are known.
  bool knows_views() const { return users_known_; }
  /// The objects in an element of a root array that refer to bytes: the element and objects of its
  /// extensions.
  const std::vector<change::BufferUser>& buffer_users(json::NodeId element) const;

  /// The hash of all elements, after sparse replacement; nothing if they cannot be read.
  std::optional<std::string> hash_of_accessor(std::uint32_t index);
  bool same_accessors(std::uint32_t one, std::uint32_t other);
  /// Whether an accessor consists only of elements in a view, in a known format, and optional
  /// sparse replacements. Not if the view has a stream and a plain copy with different bytes.
  bool has_elements(std::uint32_t accessor) const;

  /// Whether content was skipped because too many bytes are shared.
  bool is_exhausted() const { return exhausted_; }

 private:
  bool take(std::optional<std::uint64_t> bytes);
  std::optional<std::string> hash_of(const container::Bytes& bytes, std::string place);
  std::optional<container::Bytes> bytes_of(const change::BufferUser& user);
  bool has_place_of_its_own(json::NodeId view, const change::BufferUser& user) const;
  std::optional<model::AccessorData> open(std::uint32_t accessor) const;

  const StepInput& input_;
  const model::Asset& elements_;
  const json::Document& document_;
  model::AssetBytes bytes_;
  const model::ResourceData resources_;
  model::MemoryBudget budget_;
  bool exhausted_ = false;
  bool users_known_ = false;
  std::unordered_map<json::NodeId, std::vector<change::BufferUser>> users_;  ///< by element
  const std::vector<change::BufferUser> no_users_;
  std::map<std::string, std::string> hashes_;  ///< by place
  /// By view, sparse object, offset, count and format.
  std::map<
      std::tuple<std::uint32_t, json::NodeId, std::uint64_t, std::uint64_t, unsigned, unsigned>,
      std::string>
      accessor_hashes_;
};

}  // namespace gltfx::steps
