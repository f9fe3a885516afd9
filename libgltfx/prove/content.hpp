// SPDX-License-Identifier: Apache-2.0
/// The objects of an asset, each as a set of values without order: what is compared of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "base/hash.hpp"
#include "model/node.hpp"
#include "prove/side.hpp"
#include "prove/storage.hpp"

namespace gltfx::prove {

inline constexpr std::uint32_t kNoItem = UINT32_MAX;

/// An object of a list whose elements are the targets of references.
struct ItemId {
  std::uint32_t list = kNoItem;
  std::uint32_t index = kNoItem;
  bool operator==(const ItemId&) const = default;
  explicit operator bool() const { return index != kNoItem; }
};

enum class LeafKind : std::uint8_t {
  value,
  present,  ///< the object of an extension
  name,
  extras,
  foreign,  ///< of an extension without a schema
  aside,    ///< counts where the other object has a leaf with that path, too
  surface,  ///< of a mesh: triangles, lines or points of one material
  joint,    ///< of a skin: a joint with its matrix
  channel,  ///< of an animation: a curve
  texels,   ///< of an image: its bytes
  place,    ///< of a node: its transform
};

/// A value of an object, or a reference with the rest of the value.
struct Leaf {
  Hash128 path;   ///< of the names and positions below the object
  Hash128 value;  ///< defaults of the schema have no leaf; of a reference what is not in `target`
  json::NodeId at = json::kNoNode;
  ItemId target;
  LeafKind kind = LeafKind::value;
};

/// An object with its leaves.
struct Item {
  json::NodeId node = json::kNoNode;
  std::uint32_t first = 0, last = 0;  ///< its leaves in Content::leaves()
  Hash128 label;                      ///< of its name; zeros: it has none
  Hash128 own;      ///< of its values without its name and without what it refers to
  Hash128 content;  ///< with what it refers to
};

/// A list that references point into: "/meshes", "/extensions/KHR_lights_punctual/lights".
struct ItemList {
  std::string pointer;
  std::vector<Item> items;
};

/// The triangles, lines or points of a primitive.
struct Surface {
  json::NodeId primitive = json::kNoNode;
  std::optional<std::uint32_t> material;
  Hash128 sum;    ///< as of hash_soup(); zeros: it is no object
  Hash128 order;  ///< as of hash_order(), where the material blends; else zeros
  std::uint64_t elements = 0;
  bool readable = false;
};

/// Reads each object of an asset once, and makes hashes that are equal for equal contents. The side
/// must outlive it.
class Content {
 public:
  explicit Content(const Side& side);
  Content(const Content&) = delete;
  Content& operator=(const Content&) = delete;

  const Side& side() const { return side_; }
  const Types& types() const { return types_; }
  /// As of storage_extensions().
  const std::set<std::string, std::less<>>& storage() const { return storage_; }
  const std::vector<ItemList>& lists() const { return lists_; }
  const Item& item(ItemId id) const { return lists_[id.list].items[id.index]; }
  const std::vector<Leaf>& leaves() const { return leaves_; }
  /// The leaves of the root object.
  const Item& root() const { return root_; }
  /// The list with that pointer, or kNoItem.
  std::uint32_t list(std::string_view pointer) const;
  bool is_list(json::NodeId array) const { return arrays_.contains(array); }
  /// The item that a value is, or nothing.
  ItemId find(json::NodeId value) const;
  /// The primitives of a mesh.
  const std::vector<Surface>& surfaces(std::uint32_t mesh) const { return surfaces_[mesh]; }
  /// Box of the positions of a mesh: least and greatest; empty: least above greatest.
  struct Box {
    model::Vector3 least, greatest;
    bool empty() const { return !(least[0] <= greatest[0]); }
    void add(const model::Vector3& point);
    void add(const Box& box);
    /// One of the eight corners.
    model::Vector3 corner(unsigned i) const;
    static Box nothing();
  };
  const Box& box(std::uint32_t mesh) const { return boxes_[mesh]; }
  /// Of the values of an accessor, in any format; `readable` says whether they can be read.
  Hash128 elements(std::uint32_t accessor, bool& readable) const;
  /// Of the bytes of a buffer view; zeros: they cannot be read.
  Hash128 bytes(std::uint32_t view) const;

 private:
  void find_lists();
  void add_list(std::string pointer, json::NodeId array);
  void read_items();
  void read_surfaces();
  void add_special(ItemId id);
  void add_surfaces(std::uint32_t mesh);
  void add_joints(json::NodeId skin);
  void add_channels(std::uint32_t animation);
  void add_image(std::uint32_t image);
  void add_place(std::uint32_t node);
  void label(Item& item) const;
  void sum_up();

  const Side& side_;
  const Types types_;
  const std::set<std::string, std::less<>> storage_;
  std::vector<ItemList> lists_;
  std::unordered_set<json::NodeId> arrays_;
  std::unordered_map<json::NodeId, ItemId> ids_;
  std::vector<Leaf> leaves_;
  Item root_;
  std::vector<std::vector<Surface>> surfaces_;
  std::vector<Box> boxes_;
  struct Elements {
    Hash128 hash;
    bool readable = false;
  };
  mutable std::unordered_map<std::uint32_t, Elements> elements_;
};

/// The number that stands for a joint of a skin in the influences of its vertices: made of the name
/// of the joint, and of its order among joints of that name.
std::vector<double> joint_names(const Content& content, std::uint32_t skin);

}  // namespace gltfx::prove
