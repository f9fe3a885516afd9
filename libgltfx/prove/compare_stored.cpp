// SPDX-License-Identifier: Apache-2.0
// Objects that store what others use: what else they say, and those that nothing uses.
#include <algorithm>
#include <set>
#include <span>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/text.hpp"
#include "model/buffer_chunk.hpp"
#include "model/fields.hpp"
#include "model/mesh.hpp"
#include "prove/compare_values.hpp"
#include "prove/hash_sum.hpp"
#include "prove/leaf_reader.hpp"

namespace gltfx::prove {
namespace {

using model::RootArray;
using MemberNames = std::span<const std::string_view>;

// What describes bytes and elements. Their values are compared by what uses them.
constexpr std::string_view kOfAccessors[] = {"bufferView", "byteOffset", "componentType",
                                             "normalized", "count",      "type",
                                             "max",        "min",        "sparse"};
constexpr std::string_view kOfViews[] = {"buffer", "byteOffset", "byteLength", "byteStride",
                                         "target"};
constexpr std::string_view kOfBuffers[] = {"uri", "byteLength"};
constexpr std::string_view kOfChannels[] = {"sampler", "target"};
constexpr std::string_view kOfCurves[] = {"input", "output", "interpolation"};

/// A value of an object that only stores data.
struct StoredValue {
  Hash128 hash;
  json::NodeId node = json::kNoNode;
  bool used = false;  ///< by what is compared elsewhere
};

class StoredValues {
 public:
  explicit StoredValues(const Content& content)
      : content_(content), side_(content.side()), document_(side_.document()) {
    find_unused_accessors();
  }

  /// Accessors that nothing refers to, as far as schemas tell.
  const std::vector<std::uint32_t>& unused_accessors() const { return unused_; }

  /// Sorted by hash. `with_unused`: also the elements of unused accessors.
  std::vector<StoredValue> read(bool with_unused) {
    if (with_unused) read_unused_accessors();
    read_list(RootArray::accessors, kOfAccessors);
    read_list(RootArray::buffer_views, kOfViews);
    read_buffers();
    read_short_buffers();
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

  // Which chunk has the bytes is a matter of the container, like a URI.
  void read_buffers() {
    const schema::Version version = schema::stated_version(document_);
    for (const json::NodeId buffer : side_.asset().elements(RootArray::buffers)) {
      if (buffer == json::kNoNode) continue;
      read_object(buffer, kOfBuffers, model::chunk_member(document_, buffer, version));
    }
  }

  // All but the members that other comparisons cover.
  void read_object(json::NodeId object, MemberNames known, json::NodeId chunk = json::kNoNode) {
    if (object == json::kNoNode || !document_.is_object(object)) return;
    for (const auto member : document_.members(object)) {
      const std::string_view name = document_.key(member.key_id);
      const bool is_known = std::find(known.begin(), known.end(), name) != known.end();
      if (is_known || member.value == chunk) continue;
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
    const json::NodeId object = member.value;
    const Hash128 label = hash_content(name);
    if (content_.storage().contains(name)) {
      const json::NodeId extras =
          document_.is_object(object) ? document_.find(object, "extras") : json::kNoNode;
      if (extras != json::kNoNode) add(hash_of_all(label, hash_json(document_, extras)), extras);
      return;
    }
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
      read_object(channel.object, kOfChannels);
      if (channel.target != json::kNoNode) {
        const json::NodeId extras = document_.find(channel.target, "extras");
        if (extras != json::kNoNode) add(hash_json(document_, extras), extras);
      }
      if (channel.sampler) used[*channel.sampler] = true;
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
      const model::AnimationSampler& sampler = animation.samplers[i];
      read_object(sampler.object, kOfCurves);
      if (sampler.object == json::kNoNode) continue;
      bool readable = false;
      values_.push_back(
          {hash_of_all(static_cast<int>(sampler.interpolation),
                       sampler.input ? content_.elements(*sampler.input, readable) : Hash128{},
                       sampler.output ? content_.elements(*sampler.output, readable) : Hash128{}),
           sampler.object, used[i]});
    }
  }

  void find_unused_accessors() {
    const auto& accessors = side_.asset().elements(RootArray::accessors);
    std::vector<bool> used(accessors.size());
    const json::NodeId list = document_.find(document_.root(), "accessors");
    for (const graph::IndexUse& use : side_.graph().indices()) {
      if (use.list == list && use.index < used.size()) used[use.index] = true;
    }
    for (std::uint32_t i = 0; i < used.size(); ++i) {
      if (!used[i] && accessors[i] != json::kNoNode) unused_.push_back(i);
    }
  }

  void read_unused_accessors() {
    for (const std::uint32_t accessor : unused_) {
      bool readable = false;
      add(hash_of_all('e', content_.elements(accessor, readable)),
          side_.asset().elements(RootArray::accessors)[accessor]);
    }
  }

  // Strict readers cannot read views that end beyond the stated length.
  void read_short_buffers() {
    const auto& buffers = side_.asset().elements(RootArray::buffers);
    std::vector<std::uint64_t> ends(buffers.size());
    for (const model::BufferView& view : side_.views().buffer_views) {
      if (!view.buffer || !view.byte_length) continue;
      std::uint64_t& end = ends[*view.buffer];
      end = std::max(end, saturating_add(view.byte_offset.value_or(0), *view.byte_length));
    }
    for (std::size_t i = 0; i < buffers.size(); ++i) {
      if (buffers[i] == json::kNoNode || ends[i] == 0) continue;
      const auto length = model::unsigned_member(document_, buffers[i], "byteLength");
      if (length && *length >= ends[i]) continue;
      const json::NodeId value = document_.find(buffers[i], "byteLength");
      const bool missing = value == json::kNoNode;
      add(hash_of_all('b', missing ? Hash128{} : hash_json(document_, value)),
          missing ? buffers[i] : value);
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
  std::vector<std::uint32_t> unused_;
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

/// The members that describe data, which no change tells: a row names the first that differs.
class Descriptions {
 public:
  explicit Descriptions(const Comparison& all) : all_(all) {}

  void run() {
    compare(RootArray::accessors, kOfAccessors);
    compare(RootArray::buffer_views, kOfViews);
    compare(RootArray::buffers, kOfBuffers);
    if (count_ == 0) return;
    const std::string more = count_ == 1 ? "" : fmt::format(" (and {} more)", count_ - 1);
    all_.log.note_storage(fmt::format("{}{} describes data differently", first_, more));
  }

 private:
  void compare(RootArray list, MemberNames names) {
    const auto& here = all_.ours.side().asset().elements(list);
    const auto& there = all_.theirs.side().asset().elements(list);
    if (here.size() != there.size()) {
      const auto& longer = here.size() > there.size() ? all_.ours : all_.theirs;
      const json::NodeId last = longer.side().asset().elements(list).back();
      if (last != json::kNoNode) note(longer.side().pointer(last));
      return;
    }
    for (std::size_t i = 0; i < here.size(); ++i) {
      if (here[i] != json::kNoNode && there[i] != json::kNoNode) compare(here[i], there[i], names);
    }
  }

  void compare(json::NodeId ours, json::NodeId theirs, MemberNames names) {
    const json::Document& here = all_.ours.side().document();
    const json::Document& there = all_.theirs.side().document();
    const auto compare_member = [&](std::string_view name) {
      const json::NodeId one = here.find(ours, name);
      const json::NodeId other = there.find(theirs, name);
      if (one == json::kNoNode && other == json::kNoNode) return;
      const bool both = one != json::kNoNode && other != json::kNoNode;
      if (both && hash_json(here, one) == hash_json(there, other)) return;
      note(one != json::kNoNode ? all_.ours.side().pointer(one)
                                : all_.theirs.side().pointer(other));
    };
    for (const std::string_view name : names) {
      if (name != "uri") compare_member(name);
    }
    compare_member("extensions");
  }

  void note(std::string place) {
    if (count_++ == 0) first_ = std::move(place);
  }

  const Comparison& all_;
  std::string first_;
  std::size_t count_ = 0;
};

// The list of accessors, views or buffers whose element has that name; nothing: it is none.
std::optional<RootArray> list_of_name(const Side& side, json::NodeId value) {
  const graph::Tree& tree = side.tree();
  const json::NodeId object = tree.parent(value);
  if (!tree.is_member(value) || tree.name(value) != "name" || tree.root_element(object) != object) {
    return std::nullopt;
  }
  for (const RootArray list : {RootArray::accessors, RootArray::buffer_views, RootArray::buffers}) {
    const auto& elements = side.asset().elements(list);
    const std::uint32_t at = side.index(object);
    if (at < elements.size() && elements[at] == object) return list;
  }
  return std::nullopt;
}

// Names go with the views and accessors that have them, as long as none was renamed.
void drop_names(const Side& side, std::vector<json::NodeId>& only, const Side& other,
                const std::vector<json::NodeId>& theirs) {
  std::set<RootArray> kept;
  for (const json::NodeId each : theirs) {
    if (const auto list = list_of_name(other, each)) kept.insert(*list);
  }
  std::erase_if(only, [&](json::NodeId each) {
    const auto list = list_of_name(side, each);
    return list && !kept.contains(*list) &&
           side.asset().elements(*list).size() > other.asset().elements(*list).size();
  });
}

// "name", or "a sampler that nothing uses".
std::string noun(const Side& side, json::NodeId value) {
  const graph::Tree& tree = side.tree();
  if (tree.is_member(value) && tree.name(value) == "byteLength") return "a view beyond byteLength";
  return tree.is_member(value) ? printable(std::string(tree.name(value)).substr(0, 80))
                               : std::string("a sampler that nothing uses");
}

}  // namespace

void compare_stored_objects(const Comparison& all) {
  StoredValues ours(all.ours);
  StoredValues theirs(all.theirs);
  // That there are fewer or more of them is storage.
  const bool with_unused = ours.unused_accessors().size() == theirs.unused_accessors().size();
  const std::vector<StoredValue> here = ours.read(with_unused);
  const std::vector<StoredValue> there = theirs.read(with_unused);
  std::vector<json::NodeId> gone = stored_only_in(here, there);
  std::vector<json::NodeId> come = stored_only_in(there, here);
  const std::size_t most = gone.size() + come.size();
  drop_names(all.ours.side(), gone, all.theirs.side(), come);
  drop_names(all.theirs.side(), come, all.ours.side(), gone);
  if (gone.size() + come.size() < most) all.log.note_storage("other names of what stores data");
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
    change.what = i < gone.size() && i < come.size()
                      ? fmt::format("{} -> {}", change.before, change.after)
                  : i < gone.size() ? fmt::format("{} was removed", noun(all.ours.side(), gone[i]))
                                    : fmt::format("{} was added", noun(all.theirs.side(), come[i]));
    all.log.add(std::move(change));
  }
  Descriptions(all).run();
}

}  // namespace gltfx::prove
