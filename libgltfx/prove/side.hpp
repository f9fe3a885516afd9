// SPDX-License-Identifier: Apache-2.0
/// One of the two compared assets, with all data that the comparison uses.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "graph/graph.hpp"
#include "model/accessor_data.hpp"
#include "model/draco.hpp"
#include "model/geometry.hpp"
#include "model/opened_asset.hpp"
#include "model/resource_data.hpp"
#include "prove/storage.hpp"
#include "schema/set.hpp"

namespace gltfx::prove {

/// A value of `before` and one of `after`.
struct Pair {
  json::NodeId ours = json::kNoNode;
  json::NodeId theirs = json::kNoNode;
};

/// Payloads that were compared, by all that the outcome depends on: what many objects share is
/// compared once.
class Compared {
 public:
  /// Whether it is new.
  bool add(std::string key) { return keys_.insert(std::move(key)).second; }

 private:
  std::unordered_set<std::string> keys_;
};

/// A number or string that refers to a value, or is a JSON pointer.
struct Link {
  json::NodeId at = json::kNoNode;
  std::uint64_t element = 0;                    ///< for a number in a number_array
  json::NodeId target = json::kNoNode;          ///< kNoNode: no target
  const graph::PointerText* pointer = nullptr;  ///< null: an index
};

/// What is opened of an asset.
enum class Scope : std::uint8_t {
  without_images,  ///< all but images
  all,
};

/// Opens what the asset refers to. Neither copied nor moved: its parts refer to each other. Not
/// thread-safe.
class Side {
 public:
  /// Precondition: the text has a root object.
  Side(const model::OpenedAsset& opened, const schema::Set& set, Scope scope, unsigned jobs);
  Side(const Side&) = delete;
  Side& operator=(const Side&) = delete;

  const json::Document& document() const { return opened_.document(); }
  const model::Asset& asset() const { return asset_; }
  const model::Views& views() const { return opened_.views(); }
  const model::ResourceData& resources() const { return loaded_.data; }
  const graph::Tree& tree() const { return graph_.tree(); }
  const model::GeometrySource& source() const { return source_; }

  const graph::Graph& graph() const { return graph_; }
  /// The reference that stands there, or null.
  const Link* link(json::NodeId value, std::uint64_t element = 0) const;
  /// The schema type of an object, under its original name; kNone: no schema describes it.
  schema::TypeId type(json::NodeId object) const;
  /// Whether elements of an array are the targets of references, so that their order has no
  /// meaning.
  bool is_table(json::NodeId array) const { return tables_.count(array) != 0; }

  /// Whether elements that take no bytes, such as zeros below a sparse accessor, may be read: a few
  /// million for the asset, however many accessors have them.
  bool affords_implied(std::uint64_t count) const;
  /// The stored elements of an accessor; nothing when they cannot be read.
  std::optional<model::AccessorData> open(std::uint32_t accessor) const;
  std::string pointer(json::NodeId value) const { return tree().pointer(value); }
  /// The position of an element of a root array.
  std::uint32_t index(json::NodeId element) const { return tree().position(element); }

 private:
  const model::OpenedAsset& opened_;
  const model::Asset asset_;
  const graph::Graph graph_;
  model::LoadedResources loaded_;
  model::DracoMeshes draco_;
  const model::GeometrySource source_;
  std::vector<Link> links_;  ///< by place
  std::unordered_set<json::NodeId> tables_;
  mutable std::uint64_t implied_left_ = std::uint64_t{1} << 22U;
};

}  // namespace gltfx::prove
