// SPDX-License-Identifier: Apache-2.0
#include "interop/decoded_data.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <tiny_gltf.h>

#include "base/checked.hpp"
#include "interop/bounds.hpp"
#include "interop/decoded_buffer.hpp"
#include "model/meshopt_view.hpp"

namespace gltfx::interop {
namespace {

using model::RootArray;

// Limit of expanded accessors: they may be mostly zeros that take no bytes in the file.
constexpr std::uint64_t kExpandedBytes = std::uint64_t{1} << 30U;

void forget(std::vector<std::string>& names, std::string_view name) {
  names.erase(std::remove(names.begin(), names.end(), name), names.end());
}

class Placement {
 public:
  Placement(const model::GeometrySource& source, tinygltf::Model& model, Notes& notes)
      : source_(source), model_(model), notes_(notes), buffer_(model) {}

  void run(bool expand_sparse) {
    place_streams();
    place_meshes();
    if (!notes_.error().empty()) return;
    restate_all_bounds();
    if (expand_sparse) expand_accessors();
    for (const std::string_view name :
         {model::kDracoExtension, model::kMeshoptExtensions[0], model::kMeshoptExtensions[1]}) {
      forget(model_.extensionsUsed, name);
      forget(model_.extensionsRequired, name);
    }
    check_buffers();
  }

 private:
  std::size_t index_of(const tinygltf::Accessor& accessor) const {
    return static_cast<std::size_t>(&accessor - model_.accessors.data());
  }

  // Decodes buffer views of meshoptimizer.
  void place_streams() {
    const auto& views = source_.views.buffer_views;
    for (std::size_t i = 0; i < views.size() && i < model_.bufferViews.size(); ++i) {
      const auto stream = model::read_meshopt_view(source_.asset, views[i].node);
      if (stream) place_stream(i, *stream);
    }
    for (tinygltf::Buffer& buffer : model_.buffers) {
      for (const std::string_view name : model::kMeshoptExtensions) {
        buffer.extensions.erase(std::string(name));
      }
    }
  }

  void place_stream(std::size_t index, const model::MeshoptView& stream) {
    tinygltf::BufferView& view = model_.bufferViews[index];
    const Path root;
    const Path list(root, "bufferViews");
    const Path path(list, index);
    // Without elements there is a plain copy, or a problem that the check of buffers finds.
    if (const auto* decoded = source_.resources.decoded(source_.views.buffer_views[index])) {
      if (decoded->bytes.size() < view.byteLength) {
        notes_.fail(fmt::format("{} holds fewer bytes than it declares", path.pointer()));
        return;
      }
      buffer_.show(view, decoded->bytes.view().first(view.byteLength));
      decoded_views_.insert(static_cast<int>(index));
    }
    view.extensions.erase(std::string(stream.extension));
    const Path extensions(path, "extensions");
    notes_.changed(Path(extensions, stream.extension), "is decoded");
  }

  // Decodes Draco primitives.
  void place_meshes() {
    const auto& meshes = source_.views.meshes;
    for (std::size_t m = 0; m < meshes.size() && m < model_.meshes.size(); ++m) {
      const auto& primitives = meshes[m].primitives;
      for (std::size_t p = 0; p < primitives.size() && p < model_.meshes[m].primitives.size();
           ++p) {
        place_primitive(primitives[p], model_.meshes[m].primitives[p],
                        fmt::format("/meshes/{}/primitives/{}", m, p));
      }
    }
  }

  void place_primitive(const model::Primitive& from, tinygltf::Primitive& to,
                       const std::string& pointer) {
    const auto reference = model::read_draco(source_.asset, from);
    if (!reference) return;
    if (!has_plain_copy(from, to, *reference)) {
      const codec::DracoMesh* mesh = source_.draco.mesh(reference->buffer_view);
      if (mesh == nullptr) {
        notes_.fail(fmt::format("the compressed geometry of {} cannot be decoded here", pointer));
        return;
      }
      place_attributes(from, *reference, *mesh, pointer);
      place_indices(*mesh, to);
    }
    to.extensions.erase(std::string(model::kDracoExtension));
    notes_.changed(pointer + "/extensions/" + std::string(model::kDracoExtension), "is decoded");
  }

  bool has_plain_copy(const model::Primitive& from, const tinygltf::Primitive& to,
                      const model::DracoReference& reference) const {
    const auto plain = [&](int accessor) {
      return accessor >= 0 &&
             model_.accessors[static_cast<std::size_t>(accessor)].bufferView >= 0 &&
             placed_.count(accessor) == 0;
    };
    return plain(to.indices) &&
           std::all_of(from.attributes.begin(), from.attributes.end(), [&](const auto& attribute) {
             return !attribute.accessor || plain(static_cast<int>(*attribute.accessor)) ||
                    !model::draco_id(source_.asset, reference, attribute.name);
           });
  }

  void place_attributes(const model::Primitive& from, const model::DracoReference& reference,
                        const codec::DracoMesh& mesh, const std::string& pointer) {
    for (const model::Attribute& attribute : from.attributes) {
      const auto id = model::draco_id(source_.asset, reference, attribute.name);
      if (!id || !attribute.accessor) continue;
      const codec::DracoAttribute* values = model::find_attribute(mesh, *id);
      if (values == nullptr || mesh.points == 0) {
        notes_.fail(
            fmt::format("{} has no {} in its compressed geometry", pointer, attribute.name));
        return;
      }
      if (!placed_.insert(static_cast<int>(*attribute.accessor)).second) continue;
      tinygltf::Accessor& accessor = model_.accessors[*attribute.accessor];
      const PackedElements elements{values->values, values->values.size() / mesh.points};
      show(accessor, buffer_.add_view(elements, TINYGLTF_TARGET_ARRAY_BUFFER), mesh.points);
    }
  }

  // Encoders may add and drop vertices: the decoded count is used.
  void show(tinygltf::Accessor& accessor, int view, std::size_t count) {
    if (accessor.count != count) {
      const std::string pointer = fmt::format("/accessors/{}/count", index_of(accessor));
      notes_.changed(pointer, fmt::format("is {}, as in the compressed geometry", count));
    }
    accessor.bufferView = view;
    accessor.byteOffset = 0;
    accessor.count = count;
    decoded_views_.insert(view);
  }

  // Compression rounds, and some encoders state the bounds of the original values.
  void restate_all_bounds() {
    for (tinygltf::Accessor& accessor : model_.accessors) {
      if (decoded_views_.count(accessor.bufferView) == 0) continue;
      if (!restate_bounds(model_, accessor)) continue;
      const std::string pointer = fmt::format("/accessors/{}", index_of(accessor));
      notes_.changed(pointer, "has the bounds of what was decoded");
    }
  }

  void place_indices(const codec::DracoMesh& mesh, tinygltf::Primitive& to) {
    // The decoder gives separate triangles for any encoded mode.
    to.mode = TINYGLTF_MODE_TRIANGLES;
    if (to.indices < 0) {
      tinygltf::Accessor accessor;
      accessor.type = TINYGLTF_TYPE_SCALAR;
      accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
      to.indices = static_cast<int>(model_.accessors.size());
      model_.accessors.push_back(std::move(accessor));
    }
    if (!placed_.insert(to.indices).second) return;
    tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(to.indices)];
    // The greatest index of each type has a special meaning.
    if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && mesh.points < 256) {
      show_indices<std::uint8_t>(accessor, mesh);
    } else if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT &&
               mesh.points < 65536) {
      accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
      show_indices<std::uint16_t>(accessor, mesh);
    } else {
      accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
      show_indices<std::uint32_t>(accessor, mesh);
    }
  }

  template <class T>
  void show_indices(tinygltf::Accessor& accessor, const codec::DracoMesh& mesh) {
    std::vector<T> narrow;
    narrow.reserve(mesh.indices.size());
    for (const std::uint32_t index : mesh.indices) narrow.push_back(static_cast<T>(index));
    const PackedElements elements{std::as_bytes(std::span(narrow)), sizeof(T)};
    show(accessor, buffer_.add_view(elements, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER), narrow.size());
  }

  void expand_accessors() {
    model::MemoryBudget budget(kExpandedBytes);
    for (std::uint32_t i = 0; i < source_.views.accessors.size(); ++i) {
      if (!model_.accessors[i].sparse.isSparse) continue;
      const bool vertex =
          source_.views.usage.accessor(i).kind == model::AccessorUse::vertex_attribute;
      const bool expanded = expand(i, vertex ? TINYGLTF_TARGET_ARRAY_BUFFER : 0, budget);
      const std::string pointer = fmt::format("/accessors/{}/sparse", i);
      notes_.changed(pointer,
                     expanded ? "is written out in full" : "stays sparse: it is too large");
    }
  }

  bool expand(std::size_t index, int target, model::MemoryBudget& budget) {
    const auto data =
        model::AccessorData::open(source_.asset, source_.views, source_.resources,
                                  source_.views.accessors[index], model::Malformed::unusable);
    if (!data) return false;
    const std::size_t packed = data->components() * component_size(data->format().component);
    // Columns of some matrices are padded, which is not visible here any more.
    if (packed != model::element_size(data->format()) ||
        !budget.take(checked_mul(data->count(), packed))) {
      return false;
    }
    const auto count = static_cast<std::size_t>(data->count());
    std::vector<std::byte> elements(count * packed);
    std::uint64_t next = 0;
    data->read(elements.data(), 0, count, next);
    tinygltf::Accessor& accessor = model_.accessors[index];
    accessor.bufferView = buffer_.add_view({elements, packed}, target);
    accessor.byteOffset = 0;
    accessor.sparse.isSparse = false;
    return true;
  }

  // A buffer without bytes is useless, and tinygltf does not write one.
  void check_buffers() {
    for (std::size_t i = 0; i < model_.buffers.size(); ++i) {
      if (!model_.buffers[i].data.empty()) continue;
      const auto shows = [&](const tinygltf::BufferView& view) {
        return view.buffer == static_cast<int>(i);
      };
      const std::string pointer = fmt::format("/buffers/{}", i);
      if (std::any_of(model_.bufferViews.begin(), model_.bufferViews.end(), shows)) {
        notes_.fail(fmt::format("{} has no bytes", pointer));
        return;
      }
      notes_.lost(pointer + "/byteLength", "is 1: nothing is in it, nor in any file");
      model_.buffers[i].data.assign(1, 0);
    }
  }

  const model::GeometrySource& source_;
  tinygltf::Model& model_;
  Notes& notes_;
  DecodedBuffer buffer_;
  std::set<int> placed_;         // accessors of decoded geometry
  std::set<int> decoded_views_;  // buffer views of decoded bytes
};

}  // namespace

void place_decoded(const model::GeometrySource& source, bool expand_sparse, tinygltf::Model& model,
                   Notes& notes) {
  Placement(source, model, notes).run(expand_sparse);
}

}  // namespace gltfx::interop
