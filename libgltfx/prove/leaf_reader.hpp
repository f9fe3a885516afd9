// SPDX-License-Identifier: Apache-2.0
/// Takes an object apart into leaves, as its schema says.
#pragma once

#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "prove/content.hpp"

namespace gltfx::prove {

/// The hash of a JSON value: members in any order, numbers by value.
Hash128 hash_json(const json::Document& document, json::NodeId value);

/// Recursion is bounded by the depth of parsed JSON.
class LeafReader {
 public:
  LeafReader(const Content& content, std::vector<Leaf>& leaves);

  /// The leaves of an item, without those of lists, surfaces and curves.
  void read(json::NodeId object);
  /// The leaves of the root object.
  void read_root();
  /// The leaves of an object that is not an item and stands in no item's leaves, such as the target
  /// of a channel.
  void read_part(json::NodeId object) { read_object(object, {}); }

 private:
  using Names = std::set<std::string, std::less<>>;
  void read_object(json::NodeId object, const Hash128& path);
  void read_extensions(json::NodeId list, const Hash128& path);
  void read_codec_extras(json::NodeId extension, const Hash128& path);
  void read_member(schema::TypeId type, std::string_view name, json::NodeId value,
                   const Hash128& path);
  void read_value(json::NodeId value, const Hash128& path, LeafKind kind);
  void read_plain(json::NodeId value, const Hash128& path, LeafKind kind);
  void read_numbers(json::NodeId array, const Hash128& path);
  void read_texture(json::NodeId texture, const Hash128& path);
  void read_coded_mode(json::NodeId primitive, const Hash128& path);
  void read_contradictions(json::NodeId primitive, const Hash128& path);
  void read_broken_places(json::NodeId node, const Hash128& path);
  void read_broken_indices(json::NodeId object, std::string_view name, const Hash128& path);
  bool is_left_out(schema::TypeId type, std::string_view name, json::NodeId value) const;
  bool is_default(schema::TypeId type, std::string_view name, json::NodeId value);
  void add(json::NodeId at, const Hash128& path, const Hash128& value, LeafKind kind);
  /// A leaf for the index or pointer that stands there.
  bool add_link(json::NodeId at, std::uint64_t element, const Hash128& path);

  const Content& content_;
  const Side& side_;
  const json::Document& document_;
  const Types& types_;
  const Names& storage_;
  std::vector<Leaf>& leaves_;
  std::unordered_map<const schema::Property*, Hash128> defaults_;
};

}  // namespace gltfx::prove
