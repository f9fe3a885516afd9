// SPDX-License-Identifier: Apache-2.0
#include "steps/shrink_views.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "steps/json_edits.hpp"
#include "steps/storage.hpp"
#include "steps/view_pool.hpp"

namespace gltfx::steps {
namespace {

/// The bytes of an accessor that stays in its view.
struct KeptBytes {
  std::uint64_t begin, end;
  std::uint32_t accessor;
};

// Readers take whole strides of interleaved elements, also of the last one, if there are as many
// bytes.
std::uint64_t end_of_stride(const model::BufferView& view, const model::Accessor& accessor,
                            std::uint64_t end) {
  const std::uint64_t whole =
      accessor.byte_offset.value_or(0) + *accessor.count * view.byte_stride.value_or(0);
  return std::max(end, std::min(whole, *view.byte_length));
}

// Sorted by offset. Nothing: the view does not change.
std::optional<std::vector<KeptBytes>> kept_bytes(const GeometryInput& input, std::uint32_t view,
                                                 const std::set<std::uint32_t>& gone) {
  const auto accessors = input.accessors_of(input.views.buffer_views[view].node);
  if (!accessors) return std::nullopt;
  std::vector<KeptBytes> kept;
  for (const std::uint32_t each : *accessors) {
    if (gone.contains(each)) continue;
    const model::Accessor& accessor = input.views.accessors[each];
    const auto end = input.end_in_view(accessor);
    if (!end) return std::nullopt;
    const std::uint64_t begin = accessor.byte_offset.value_or(0);
    kept.push_back({begin, end_of_stride(input.views.buffer_views[view], accessor, *end), each});
  }
  if (kept.empty()) return std::nullopt;
  std::sort(kept.begin(), kept.end(), [](const KeptBytes& a, const KeptBytes& b) {
    return std::pair(a.begin, a.accessor) < std::pair(b.begin, b.accessor);
  });
  return kept;
}

void shrink(const GeometryInput& input, std::uint32_t index, const std::vector<KeptBytes>& kept,
            NewBuffer& buffer, json::Editor& editor) {
  const json::Document& document = input.asset.document();
  const model::BufferView& view = input.views.buffer_views[index];
  const auto old = input.resources.part(document, view, 0, *view.byte_length);
  if (!old) return;
  std::string bytes;
  std::uint64_t copied = 0;    // offset in the old view
  std::uint64_t distance = 0;  // by which the bytes before `copied` moved
  std::vector<std::pair<std::uint32_t, std::uint64_t>> places;
  for (const KeptBytes& each : kept) {
    if (each.begin >= copied) {
      // Multiples of the stride stay such.
      const std::uint64_t stride = view.byte_stride.value_or(1);
      const std::uint64_t unit =
          each.begin % stride == 0 ? std::lcm(kAlignment, stride) : kAlignment;
      distance = (each.begin - bytes.size()) / unit * unit;
      bytes.resize(each.begin - distance);
      copied = each.begin;
    }
    if (each.end > copied) bytes += old->text().substr(copied, each.end - copied);
    copied = std::max(copied, each.end);
    places.emplace_back(each.accessor, each.begin - distance);
  }
  if (bytes.size() >= *view.byte_length) return;
  for (const auto& [accessor, begin] : places) {
    if (begin == input.views.accessors[accessor].byte_offset.value_or(0)) continue;
    set_number(document, editor, input.views.accessors[accessor].node, "byteOffset", begin);
  }
  set_number(document, editor, view.node, "byteLength", bytes.size());
  set_number(document, editor, view.node, "buffer", buffer.index());
  set_number(document, editor, view.node, "byteOffset", buffer.add(std::move(bytes)));
}

}  // namespace

void shrink_views(const GeometryInput& input, const std::set<std::uint32_t>& gone,
                  NewBuffer& buffer, json::Editor& editor) {
  std::set<std::uint32_t> views;
  for (const std::uint32_t each : gone) {
    const auto& view = input.views.accessors[each].buffer_view;
    if (view) views.insert(*view);
  }
  const std::set<std::uint64_t> meant = unknown_integers(input.graph);
  for (const std::uint32_t view : views) {
    if (meant.contains(view)) continue;
    const auto kept = kept_bytes(input, view, gone);
    if (kept) shrink(input, view, *kept, buffer, editor);
  }
}

}  // namespace gltfx::steps
