// SPDX-License-Identifier: Apache-2.0
#include "model/draco.hpp"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <utility>

#include "base/parallel.hpp"
#include "model/fields.hpp"

namespace gltfx::model {
namespace {

// Payloads that exceed a limit cost seconds each: at most two are tried per file.
constexpr int kMostCostly = 2;
// Limit of decoded bytes of one file: a few million triangles, and more for larger payloads.
constexpr std::uint64_t kFreeResultBytes = std::uint64_t{128} << 20U;
constexpr std::uint64_t kResultBytesPerByte = 128;

std::uint64_t size_of(const codec::DracoMesh& mesh) {
  std::uint64_t size = mesh.indices.size_bytes();
  for (const codec::DracoAttribute& attribute : mesh.attributes) size += attribute.values.size();
  return size;
}

ComponentType component_of(codec::Component component) {
  static constexpr ComponentType kTypes[] = {
      ComponentType::int8,  ComponentType::uint8,  ComponentType::int16,   ComponentType::uint16,
      ComponentType::int32, ComponentType::uint32, ComponentType::float32, ComponentType::none};
  return kTypes[static_cast<std::size_t>(component)];
}

ElementType element_of(std::uint32_t components) {
  static constexpr ElementType kTypes[] = {ElementType::none, ElementType::scalar,
                                           ElementType::vec2, ElementType::vec3, ElementType::vec4};
  return components < std::size(kTypes) ? kTypes[components] : ElementType::none;
}

DracoMeshes::Decoded decoded(codec::DracoResult&& result) {
  if (auto* mesh = std::get_if<codec::DracoMesh>(&result)) return std::move(*mesh);
  return std::get<codec::DecodeError>(std::move(result));
}

}  // namespace

std::optional<DracoReference> read_draco(const Asset& asset, const Primitive& primitive) {
  if (primitive.node == json::kNoNode) return std::nullopt;
  const json::NodeId object = extension_object(asset.document(), primitive.node, kDracoExtension);
  if (object == json::kNoNode) return std::nullopt;
  const auto view = asset.index(object, "bufferView", RootArray::buffer_views);
  return view ? std::optional(DracoReference{object, *view}) : std::nullopt;
}

std::optional<std::uint64_t> draco_id(const Asset& asset, const DracoReference& reference,
                                      std::string_view attribute) {
  const json::Document& document = asset.document();
  return unsigned_member(document, object_member(document, reference.object, "attributes"),
                         attribute);
}

Format format_of(const codec::DracoAttribute& attribute, bool normalized) {
  return {element_of(attribute.components), component_of(attribute.component), normalized};
}

const codec::DracoAttribute* find_attribute(const codec::DracoMesh& mesh, std::uint64_t id) {
  const auto found = std::find_if(mesh.attributes.begin(), mesh.attributes.end(),
                                  [&](const codec::DracoAttribute& each) { return each.id == id; });
  return found == mesh.attributes.end() ? nullptr : &*found;
}

void DracoMeshes::add(const Asset& asset, const Views& views, const ResourceData& resources,
                      std::uint32_t buffer_view) {
  const BufferView& view = views.buffer_views[buffer_view];
  if (!view.byte_length) return;
  const auto [at, fresh] = positions_.try_emplace(buffer_view, payloads_.size());
  if (!fresh) return;
  auto bytes = resources.part(asset.document(), view, 0, *view.byte_length);
  payloads_.push_back(
      {bytes ? *std::move(bytes) : container::Bytes(), resources.origin, NotLookedAt{}});
}

void DracoMeshes::add_all(const Asset& asset, const Views& views, const ResourceData& resources) {
  if (asset.document().key_id(kDracoExtension) == json::kNoKey) return;
  for (const Mesh& mesh : views.meshes) {
    for (const Primitive& primitive : mesh.primitives) {
      const auto reference = read_draco(asset, primitive);
      if (reference) add(asset, views, resources, reference->buffer_view);
    }
  }
}

void DracoMeshes::decode(codec::Client& client, unsigned jobs) {
  std::atomic<bool> stopped = false;
  std::uint64_t left = kFreeResultBytes;
  for (const Payload& payload : payloads_) left += payload.bytes.size() * kResultBytesPerByte;
  int costly = 0;
  parallel_ordered(
      payloads_.size(), jobs,
      [&](std::size_t i) {
        if (stopped || payloads_[i].bytes.empty()) return;
        Payload& payload = payloads_[i];
        payload.decoded = decoded(client.decode_draco(payload.bytes.view(), payload.origin));
      },
      [&](std::size_t i) {
        Decoded& decoded = payloads_[i].decoded;
        if (stopped) decoded = NotLookedAt{};
        const auto* error = std::get_if<codec::DecodeError>(&decoded);
        const auto* mesh = std::get_if<codec::DracoMesh>(&decoded);
        if (error != nullptr && codec::is_costly(*error) && ++costly == kMostCostly) stopped = true;
        if (mesh == nullptr) return;
        const std::uint64_t size = size_of(*mesh);
        if (size > left) {
          decoded = NotLookedAt{};
          stopped = true;
        } else {
          left -= size;
        }
      });
}

const DracoMeshes::Decoded* DracoMeshes::find(std::uint32_t buffer_view) const {
  const auto found = positions_.find(buffer_view);
  if (found == positions_.end() || payloads_[found->second].bytes.empty()) return nullptr;
  return &payloads_[found->second].decoded;
}

const codec::DracoMesh* DracoMeshes::mesh(std::uint32_t buffer_view) const {
  const Decoded* decoded = find(buffer_view);
  return decoded == nullptr ? nullptr : std::get_if<codec::DracoMesh>(decoded);
}

}  // namespace gltfx::model
