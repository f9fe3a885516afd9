// SPDX-License-Identifier: Apache-2.0
#include "steps/step_data.hpp"

#include <utility>

namespace gltfx::steps {
namespace {

// Twice all bytes, and a minimum for small assets.
std::uint64_t readable_bytes(const model::ResourceData& resources) {
  std::uint64_t bytes = std::uint64_t{64} << 20U;
  for (const auto& buffer : resources.buffers) {
    if (buffer) bytes += 2 * buffer->size();
  }
  return bytes;
}

}  // namespace

StepData::StepData(const StepInput& of)
    : GeometryInput(of), input(of), budget(readable_bytes(resources)) {}

std::string StepData::open(std::uint32_t index, std::optional<model::AccessorData>& data) const {
  const model::Accessor& accessor = views.accessors[index];
  if (accessor.sparse != json::kNoNode) return "has a sparse accessor";
  if (document.find(accessor.node, "extensions") != json::kNoNode)
    return "has an accessor with an extension";
  const model::BufferView* view = views.view_of(accessor);
  if (!view) return "has an accessor without a buffer view";
  if (resources.decoded(*view)) return "is compressed; decode it first: --compress none";
  if (document.find(view->node, "extensions") != json::kNoNode)
    return "has a buffer view with an extension";
  if (model::is_matrix(accessor.format.type)) return "has an accessor with matrices";
  data = model::AccessorData::open(asset, views, resources, accessor, model::Malformed::unusable);
  if (!data) return "has data that cannot be read";
  if (!budget.take(checked_mul(data->count(), model::packed_stride(data->format())))) {
    data.reset();
    return "shares its bytes with too many other objects";
  }
  return {};
}

StepChanges::StepChanges(const StepData& data)
    : buffer(data.input.asset),
      additions(data.document),
      editor(data.document),
      contents(data.input.asset, data.graph, data.resources, buffer, additions, editor) {}

Result<change::Change> StepChanges::finish() {
  if (auto trouble = contents.store()) return *std::move(trouble);
  change::Change change;
  change.edits = editor.take();
  change.additions = std::move(additions);
  buffer.add_to(change);
  return change;
}

std::string packed_bytes(const model::AccessorData& data) {
  std::string bytes(model::packed_stride(data.format()) * data.count(), '\0');
  std::uint64_t next = 0;
  data.read(reinterpret_cast<std::byte*>(bytes.data()), 0, static_cast<std::size_t>(data.count()),
            next);
  return bytes;
}

}  // namespace gltfx::steps
