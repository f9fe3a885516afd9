// SPDX-License-Identifier: Apache-2.0
#include "prove/shared_causes.hpp"

#include <fmt/format.h>

#include "prove/column.hpp"
#include "prove/primitive_pair.hpp"

namespace gltfx::prove {
namespace {

using model::RootArray;

/// What a change is about in one asset.
struct DataAt {
  std::string key;     ///< equal for the same data; empty: it is no data
  std::string unread;  ///< pointer to the object that cannot be read; empty: all of it can
};

std::string element_pointer(const Side& side, RootArray list, std::uint32_t index) {
  return side.pointer(side.asset().elements(list)[index]);
}

// The buffer without bytes, the view that does not fit it, or else `otherwise`.
std::string unread_place(const Side& side, const std::optional<std::uint32_t>& view,
                         std::string otherwise) {
  if (!view) return otherwise;
  const model::BufferView& described = side.views().buffer_views[*view];
  const auto& buffers = side.resources().buffers;
  if (described.buffer && *described.buffer < buffers.size() && !buffers[*described.buffer]) {
    return element_pointer(side, RootArray::buffers, *described.buffer);
  }
  const std::uint64_t length = described.byte_length.value_or(0);
  const bool readable =
      length > 0 && side.resources().part(side.document(), described, 0, length).has_value();
  return readable ? otherwise : element_pointer(side, RootArray::buffer_views, *view);
}

class Causes {
 public:
  explicit Causes(const Comparison& all) : all_(all) {}

  /// The same for changes of one cause; empty: it is not shared. May place the change at its cause.
  std::string find(Change& change) const {
    const DataAt ours = data_at(all_.ours, change.old_pointer);
    const DataAt theirs = data_at(all_.theirs, change.new_pointer);
    const bool lost = !theirs.unread.empty();
    if (lost != !ours.unread.empty()) {
      place(lost ? change.old_pointer : change.new_pointer,
            lost ? change.new_pointer : change.old_pointer, lost ? theirs.unread : ours.unread,
            change);
      change.what = fmt::format("can be read in the {} asset only", lost ? "old" : "new");
      const bool any_buffer = has_buffers(all_.ours) && has_buffers(all_.theirs);
      return fmt::format("unread {} {}", lost,
                         !any_buffer ? ""
                         : lost      ? theirs.unread
                                     : ours.unread);
    }
    if (ours.key.empty() || theirs.key.empty()) return {};
    return fmt::format("{} {} {}", change.kind, ours.key, theirs.key);
  }

 private:
  static bool has_buffers(const Content& content) {
    return content.side().asset().count(RootArray::buffers) > 0;
  }

  static void place(std::optional<std::string>& readable, std::optional<std::string>& unread,
                    const std::string& cause, Change& change) {
    if (unread == cause) return;
    change.also.push_back(unread ? *unread : *readable);
    readable.reset();
    unread = cause;
    change.before.clear();
    change.after.clear();
    change.measure.reset();
    change.level = CompareLevel::differs;
  }

  DataAt data_at(const Content& content, const std::optional<std::string>& pointer) const {
    if (!pointer) return {};
    const Side& side = content.side();
    const graph::Place found = side.tree().find(*pointer);
    if (found.node == json::kNoNode) return {};
    const Link* link = side.link(found.node, found.element.value_or(0));
    const json::NodeId target = link == nullptr ? found.node : link->target;
    if (target == json::kNoNode || !side.document().is_object(target)) return {};
    const schema::TypeId type = side.type(target);
    if (type == content.types().accessor) return accessor_at(side, side.index(target));
    if (type == content.types().image) return image_at(side, side.index(target));
    if (type == content.types().primitive) return {storage_key(side, target), {}};
    return {};
  }

  static DataAt accessor_at(const Side& side, std::uint32_t accessor) {
    const std::string own = element_pointer(side, RootArray::accessors, accessor);
    if (Column::open(side, accessor)) return {own, {}};
    return {own, unread_place(side, side.views().accessors[accessor].buffer_view, own)};
  }

  // Each image is compared once; only what it is stored in may be shared.
  static DataAt image_at(const Side& side, std::uint32_t image) {
    if (side.resources().images[image].bytes) return {};
    const json::NodeId object = side.asset().elements(RootArray::images)[image];
    const auto view = side.asset().index(object, "bufferView", RootArray::buffer_views);
    return {{}, unread_place(side, view, side.pointer(object))};
  }

  const Comparison& all_;
};

}  // namespace

void merge_shared_causes(const Comparison& comparison) {
  const Causes causes(comparison);
  comparison.log.merge([&](Change& change) { return causes.find(change); });
}

}  // namespace gltfx::prove
