// SPDX-License-Identifier: Apache-2.0
// Objects that store what others use: what else they say, and those that nothing uses.
#include <algorithm>
#include <initializer_list>

#include <fmt/format.h>

#include "model/mesh.hpp"
#include "prove/compare_values.hpp"
#include "prove/hash_sum.hpp"
#include "prove/leaf_reader.hpp"

namespace gltfx::prove {
namespace {

using model::RootArray;
using MemberNames = std::initializer_list<std::string_view>;

/// A value of an object that only stores data.
struct StoredValue {
  Hash128 hash;
  json::NodeId node = json::kNoNode;
  bool used = false;  ///< by what is compared elsewhere
};

class StoredValues {
 public:
  explicit StoredValues(const Content& content)
      : content_(content), side_(content.side()), document_(side_.document()) {}

  /// Sorted by hash.
  std::vector<StoredValue> read() {
    read_list(RootArray::accessors, {"bufferView", "byteOffset", "componentType", "normalized",
                                     "count", "type", "max", "min", "sparse"});
    read_list(RootArray::buffer_views,
              {"buffer", "byteOffset", "byteLength", "byteStride", "target"});
    read_list(RootArray::buffers, {"uri", "byteLength"});
    for (const model::Animation& animation : side_.views().animations) read_animation(animation);
    read_unused_samplers();
    std::stable_sort(
        values_.begin(), values_.end(),
        [](const StoredValue& a, const StoredValue& b) { return hash_less(a.hash, b.hash); });
    return std::move(values_);
  }

 private:
  void add(const Hash128& hash, json::NodeId at) { values_.push_back({hash, at, false}); }

  void read_list(RootArray list, MemberNames known) {
    for (const json::NodeId object : side_.asset().elements(list)) read_object(object, known);
  }

  // All but the members that other comparisons cover.
  void read_object(json::NodeId object, MemberNames known) {
    if (object == json::kNoNode || !document_.is_object(object)) return;
    for (const auto member : document_.members(object)) {
      const std::string_view name = document_.key(member.key_id);
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      if (name == "extensions" && document_.is_object(member.value)) {
        for (const auto each : document_.members(member.value)) read_extension(each);
      } else {
        add(hash_of_all(hash_content(name), hash_json(document_, member.value)), member.value);
      }
    }
  }

  template <class Member>
  void read_extension(const Member& member) {
    const std::string_view name = document_.key(member.key_id);
    if (content_.storage().contains(name)) return;
    const json::NodeId object = member.value;
    const Hash128 label = hash_content(name);
    if (!document_.is_object(object) || side_.graph().type(object) == schema::kNone) {
      return add(hash_of_all(label, hash_json(document_, object)), object);
    }
    std::vector<Leaf> leaves;
    LeafReader(content_, leaves).read_part(object);
    for (const Leaf& leaf : leaves) {
      const Hash128 target = leaf.target ? content_.item(leaf.target).content : Hash128{};
      add(hash_of_all(label, leaf.path, leaf.value, target), leaf.at);
    }
  }

  void read_animation(const model::Animation& animation) {
    std::vector<bool> used(animation.samplers.size());
    for (const auto& channel : animation.channels) {
      read_object(channel.object, {"sampler", "target"});
      if (channel.target != json::kNoNode) {
        const json::NodeId extras = document_.find(channel.target, "extras");
        if (extras != json::kNoNode) add(hash_json(document_, extras), extras);
      }
      if (channel.sampler) used[*channel.sampler] = true;
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
      const model::AnimationSampler& sampler = animation.samplers[i];
      read_object(sampler.object, {"input", "output", "interpolation"});
      if (sampler.object == json::kNoNode) continue;
      bool readable = false;
      values_.push_back(
          {hash_of_all(static_cast<int>(sampler.interpolation),
                       sampler.input ? content_.elements(*sampler.input, readable) : Hash128{},
                       sampler.output ? content_.elements(*sampler.output, readable) : Hash128{}),
           sampler.object, used[i]});
    }
  }

  // Those of textures are compared with them.
  void read_unused_samplers() {
    const auto& samplers = side_.asset().elements(RootArray::samplers);
    std::vector<bool> used(samplers.size());
    for (const json::NodeId texture : side_.asset().elements(RootArray::textures)) {
      if (texture == json::kNoNode) continue;
      const auto sampler = side_.asset().index(texture, "sampler", RootArray::samplers);
      if (sampler) used[*sampler] = true;
    }
    for (std::size_t i = 0; i < samplers.size(); ++i) {
      if (samplers[i] == json::kNoNode) continue;
      values_.push_back(
          {hash_of_all('u', hash_json(document_, samplers[i])), samplers[i], used[i]});
    }
  }

  const Content& content_;
  const Side& side_;
  const json::Document& document_;
  std::vector<StoredValue> values_;
};

// In the order of the text.
std::vector<json::NodeId> stored_only_in(const std::vector<StoredValue>& these,
                                         const std::vector<StoredValue>& those) {
  std::vector<json::NodeId> only;
  std::size_t k = 0;
  for (const StoredValue& each : these) {
    while (k < those.size() && hash_less(those[k].hash, each.hash)) ++k;
    if (k < those.size() && those[k].hash == each.hash) {
      ++k;
    } else if (!each.used) {
      only.push_back(each.node);
    }
  }
  std::sort(only.begin(), only.end());
  return only;
}

}  // namespace

void compare_stored_objects(const Comparison& all) {
  const std::vector<StoredValue> here = StoredValues(all.ours).read();
  const std::vector<StoredValue> there = StoredValues(all.theirs).read();
  const std::vector<json::NodeId> gone = stored_only_in(here, there);
  const std::vector<json::NodeId> come = stored_only_in(there, here);
  const auto at = [](const Side& side, const std::vector<json::NodeId>& nodes, std::size_t i) {
    return i < nodes.size() ? std::optional(side.pointer(nodes[i])) : std::nullopt;
  };
  for (std::size_t i = 0; i < std::max(gone.size(), come.size()); ++i) {
    Change change;
    change.kind = "stored.name";
    change.old_pointer = at(all.ours.side(), gone, i);
    change.new_pointer = at(all.theirs.side(), come, i);
    if (i < gone.size()) change.before = short_value(all.ours.side().document(), gone[i]);
    if (i < come.size()) change.after = short_value(all.theirs.side().document(), come[i]);
    change.what = fmt::format("{} -> {}", change.before.empty() ? "none" : change.before,
                              change.after.empty() ? "none" : change.after);
    all.log.add(std::move(change));
  }
}

}  // namespace gltfx::prove
