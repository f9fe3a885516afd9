// SPDX-License-Identifier: Apache-2.0
/// The buffer of a model for decoded bytes. For files that include <tiny_gltf.h>.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace gltfx::interop {

/// Packed elements.
struct PackedElements {
  std::span<const std::byte> bytes;
  std::size_t element_size = 1;
};

class DecodedBuffer {
 public:
  explicit DecodedBuffer(tinygltf::Model& model) : model_(model) {}

  /// Copies bytes to a boundary that suits every component type, and points the view to them.
  void show(tinygltf::BufferView& view, std::span<const std::byte> bytes) {
    view.buffer = index();
    view.byteOffset = room_for(bytes.size());
    view.byteLength = bytes.size();
    std::memcpy(data().data() + view.byteOffset, bytes.data(), bytes.size());
  }

  /// Adds a view with elements: each vertex begins at a multiple of four bytes, as the
  /// specification requires (section 3.6.2.4). Returns its index.
  int add_view(const PackedElements& elements, int target) {
    tinygltf::BufferView view;
    view.target = target;
    const std::size_t size = elements.element_size;
    const std::size_t stride = (size + 3) / 4 * 4;
    if (target != TINYGLTF_TARGET_ARRAY_BUFFER || stride == size) {
      show(view, elements.bytes);
    } else {
      show_padded(view, elements, stride);
    }
    model_.bufferViews.push_back(std::move(view));
    return static_cast<int>(model_.bufferViews.size() - 1);
  }

 private:
  void show_padded(tinygltf::BufferView& view, const PackedElements& elements, std::size_t stride) {
    const std::size_t count = elements.bytes.size() / elements.element_size;
    view.buffer = index();
    view.byteStride = stride;
    view.byteLength = count * stride;
    view.byteOffset = room_for(view.byteLength);
    unsigned char* to = data().data() + view.byteOffset;
    for (std::size_t i = 0; i < count; ++i) {
      std::memcpy(to + i * stride, elements.bytes.data() + i * elements.element_size,
                  elements.element_size);
    }
  }

  std::vector<unsigned char>& data() {
    return model_.buffers[static_cast<std::size_t>(index_)].data;
  }

  std::size_t room_for(std::size_t size) {
    const std::size_t begin = (data().size() + 3) / 4 * 4;
    data().resize(begin + size);
    return begin;
  }

  int index() {
    for (std::size_t i = 0; index_ < 0 && i < model_.buffers.size(); ++i) {
      if (model_.buffers[i].data.empty()) index_ = static_cast<int>(i);
    }
    if (index_ < 0) {
      index_ = static_cast<int>(model_.buffers.size());
      model_.buffers.emplace_back();
    }
    return index_;
  }

  tinygltf::Model& model_;
  int index_ = -1;
};

}  // namespace gltfx::interop
