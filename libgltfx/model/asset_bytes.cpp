// SPDX-License-Identifier: Apache-2.0
#include "model/asset_bytes.hpp"

#include "base/checked.hpp"
#include "container/uri.hpp"
#include "model/accessor.hpp"
#include "model/buffer_chunk.hpp"
#include "model/fields.hpp"

namespace gltfx::model {
namespace {

using container::Bytes;
using container::UriKind;
using schema::stated_version;

constexpr std::uint64_t kNoBuffer = UINT64_MAX;

// Whether the error does not depend on the asset: another run may succeed.
bool may_pass(container::ResolveError error) {
  using container::ResolveError;
  return error == ResolveError::no_permission || error == ResolveError::io_error ||
         error == ResolveError::truncated;
}

Storage storage_of(const std::string& uri) {
  if (uri.empty()) return Storage::nowhere;
  return container::classify_uri(uri).kind == UriKind::data ? Storage::data_uri : Storage::file;
}

}  // namespace

json::NodeId AssetBytes::element(RootArray array, std::uint64_t index) const {
  return index < asset_.count(array) ? asset_.elements(array)[index] : json::kNoNode;
}

Result<Bytes> AssetBytes::fetch(const std::string& uri) {
  container::ResolveError error = container::ResolveError::none;
  auto bytes = container::fetch(files_, uri, &error);
  if (trouble_.empty() && may_pass(error)) trouble_ = bytes.error().message;
  return bytes;
}

Result<Bytes> AssetBytes::buffer(std::uint64_t index) {
  const auto known = buffers_.find(index);
  if (known != buffers_.end()) return known->second;
  const json::NodeId object = element(RootArray::buffers, index);
  if (object == json::kNoNode) return Error{"the buffer does not exist"};
  const std::string uri = string_member(asset_.document(), object, "uri");
  if (!uri.empty()) {
    auto bytes = fetch(uri);
    if (bytes) buffers_.emplace(index, *bytes);
    return bytes;
  }
  const auto chunk = buffer_chunk(index);
  if (!chunk) return Error{"its buffer has no data"};
  return container_.bytes.part(chunk->offset, chunk->length);
}

std::uint64_t AssetBytes::buffer_of(json::NodeId image) const {
  const auto view = asset_.index(image, "bufferView", RootArray::buffer_views);
  if (!view) return kNoBuffer;
  const json::NodeId object = asset_.elements(RootArray::buffer_views)[*view];
  const auto buffer = asset_.index(object, "buffer", RootArray::buffers);
  return buffer ? *buffer : kNoBuffer;
}

Result<Bytes> AssetBytes::view_of(json::NodeId object) {
  const auto index = asset_.index(object, "bufferView", RootArray::buffer_views);
  if (!index) return Error{"it has neither a URI nor a buffer view"};
  const BufferView view =
      read_buffer_view(asset_, asset_.elements(RootArray::buffer_views)[*index]);
  if (!view.buffer || !view.byte_length) return Error{"its buffer view is invalid"};
  auto bytes = buffer(*view.buffer);
  if (!bytes) return bytes;
  const std::uint64_t offset = view.byte_offset.value_or(0);
  if (!fits(offset, *view.byte_length, bytes->size())) {
    return Error{"its buffer view exceeds the buffer"};
  }
  return bytes->part(offset, *view.byte_length);
}

Result<Bytes> AssetBytes::image(std::uint64_t index) {
  const json::NodeId object = element(RootArray::images, index);
  if (object == json::kNoNode) return Error{"the image does not exist"};
  const std::string uri = string_member(asset_.document(), object, "uri");
  return uri.empty() ? view_of(object) : fetch(uri);
}

Storage AssetBytes::image_storage(std::uint64_t index) const {
  const json::NodeId object = element(RootArray::images, index);
  if (object == json::kNoNode) return Storage::nowhere;
  const std::string uri = string_member(asset_.document(), object, "uri");
  if (!uri.empty()) return storage_of(uri);
  return buffer_of(object) == kNoBuffer ? Storage::nowhere : Storage::buffer_view;
}

Storage AssetBytes::buffer_storage(std::uint64_t index) const {
  const json::NodeId object = element(RootArray::buffers, index);
  if (object == json::kNoNode) return Storage::nowhere;
  const std::string uri = string_member(asset_.document(), object, "uri");
  if (!uri.empty()) return storage_of(uri);
  return buffer_chunk(index) ? Storage::bin_chunk : Storage::nowhere;
}

std::optional<container::Chunk> AssetBytes::buffer_chunk(std::uint64_t index) const {
  const json::NodeId object = element(RootArray::buffers, index);
  if (object == json::kNoNode) return std::nullopt;
  return chunk_of(container_, asset_.document(), object, index, stated_version(asset_.document()));
}

std::string AssetBytes::image_file_uri(std::uint64_t index) const {
  json::NodeId object = element(RootArray::images, index);
  if (object == json::kNoNode) return {};
  if (image_storage(index) == Storage::buffer_view) {
    object = element(RootArray::buffers, buffer_of(object));
  }
  std::string uri = string_member(asset_.document(), object, "uri");
  return storage_of(uri) == Storage::file ? uri : std::string();
}

}  // namespace gltfx::model
