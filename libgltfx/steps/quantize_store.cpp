// SPDX-License-Identifier: Apache-2.0
#include "steps/quantize_store.hpp"

#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "steps/accessor_bounds.hpp"
#include "steps/json_edits.hpp"
#include "steps/shrink_views.hpp"
#include "steps/storage.hpp"
#include "steps/view_pool.hpp"

namespace gltfx::steps {

using model::Accessor;

void FormatChanges::set(std::uint32_t accessor, unsigned kind, IntegerElements elements) {
  set_[accessor] = {kind, std::move(elements)};
}

void FormatChanges::set_plain(std::uint32_t accessor, std::string bytes) {
  set_[accessor] = {std::nullopt, {data_.views.accessors[accessor].format, std::move(bytes)}};
}

std::int64_t FormatChanges::gain(std::uint64_t nodes) const {
  constexpr std::uint64_t kAssetText = 60;
  constexpr std::uint64_t kAccessorText = 20;
  constexpr std::uint64_t kNodeText = 70;
  std::uint64_t before = 0;
  std::uint64_t after = kAssetText + kNodeText * nodes;
  for (const auto& [index, change] : set_) {
    if (!change.kind) continue;
    const Accessor& accessor = data_.views.accessors[index];
    const std::uint64_t size = model::packed_stride(change.elements.format);
    before += *accessor.count * model::packed_stride(accessor.format);
    after += kAccessorText + *accessor.count * aligned(size, kVertexAlignment);
  }
  return static_cast<std::int64_t>(before) - static_cast<std::int64_t>(after);
}

std::uint64_t FormatChanges::add_floats(model::ElementType type, std::string bytes) {
  const std::uint64_t size = model::packed_stride({type, model::ComponentType::float32, false});
  const std::size_t length = bytes.size();
  const std::uint64_t offset = changes_.buffer.add(std::move(bytes));
  const std::uint64_t view = changes_.additions.add_element(
      "bufferViews",
      view_json({changes_.buffer.index(), offset, length, 0, model::ViewTarget::none}));
  return changes_.additions.add_element(
      "accessors", fmt::format(R"({{"bufferView":{},"componentType":5126,"count":{},)"
                               R"("type":"{}"}})",
                               view, length / size, model::element_type_name(type)));
}

std::map<std::uint32_t, FormatChanges::Stored> FormatChanges::add_views(ViewPool& pool) {
  using Key = std::tuple<unsigned, model::ElementType, model::ComponentType>;
  std::map<Key, std::vector<std::uint32_t>> by_format;
  std::map<std::uint32_t, Stored> stored;
  for (const auto& [accessor, change] : set_) {
    const model::Format& format = change.elements.format;
    if (change.kind) by_format[{*change.kind, format.type, format.component}].push_back(accessor);
  }
  for (const auto& [key, accessors] : by_format) {
    const std::uint64_t size = model::packed_stride(set_.at(accessors.front()).elements.format);
    const std::uint64_t stride = aligned(size, kVertexAlignment);
    std::string bytes;
    for (const std::uint32_t accessor : accessors) {
      stored[accessor].offset = bytes.size();
      const std::string& packed = set_.at(accessor).elements.bytes;
      for (std::size_t at = 0; at < packed.size(); at += size) {
        bytes.append(packed, at, size).append(stride - size, '\0');
      }
    }
    const std::uint64_t view = pool.add(container::Bytes::from_string(std::move(bytes)), stride,
                                        model::ViewTarget::vertices);
    for (const std::uint32_t accessor : accessors) stored[accessor].view = view;
  }
  for (const auto& [accessor, change] : set_) {
    if (change.kind) continue;
    stored[accessor].view =
        pool.add(container::Bytes::from_string(change.elements.bytes), 0, model::ViewTarget::none);
  }
  return stored;
}

void FormatChanges::store(StepOutcome& outcome) {
  ViewPool pool(data_, changes_.buffer, changes_.additions, changes_.editor);
  std::set<std::uint32_t> gone;
  std::set<json::NodeId> edited;
  std::map<std::uint32_t, std::size_t> lost;  // users, by view
  for (const auto& [index, change] : set_) {
    const Accessor& accessor = data_.views.accessors[index];
    gone.insert(index);
    edited.insert(data_.document.find(accessor.node, "bufferView"));
    ++lost[*accessor.buffer_view];
  }
  for (const auto& [view, users] : lost) {
    if (data_.graph.users(data_.views.buffer_views[view].node).size() == users) pool.free(view);
  }
  const std::map<std::uint32_t, Stored> stored = add_views(pool);
  pool.settle(edited, outcome);
  shrink_views(data_, gone, changes_.buffer, changes_.editor);
  for (const auto& [index, change] : set_) {
    const Stored& at = stored.at(index);
    declare(index, change, pool.position(at.view), at.offset);
  }
}

void FormatChanges::declare(std::uint32_t index, const Change& change, std::uint64_t view,
                            std::uint64_t offset) {
  const json::Document& document = data_.document;
  json::Editor& editor = changes_.editor;
  Accessor now = data_.views.accessors[index];
  set_number(document, editor, now.node, "bufferView", view);
  if (offset == 0) {
    remove_member(document, editor, now.node, "byteOffset");
  } else {
    set_number(document, editor, now.node, "byteOffset", offset);
  }
  const model::Format& format = change.elements.format;
  if (format.component != now.format.component) {
    set_number(document, editor, now.node, "componentType",
               static_cast<unsigned>(format.component));
  }
  if (format.normalized != now.format.normalized) {
    const json::NodeId old = document.find(now.node, "normalized");
    if (old == json::kNoNode) {
      editor.append_member(now.node, "normalized", "true");
    } else {
      editor.replace(now.node, old, format.normalized ? "true" : "false");
    }
  }
  now.format = format;
  mend_bounds(document, editor, now, change.elements.bytes);
}

}  // namespace gltfx::steps
