// SPDX-License-Identifier: Apache-2.0
/// The bytes of buffers and images, opened once and shared by all readers.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/origin.hpp"
#include "container/bytes.hpp"
#include "container/container.hpp"
#include "container/opened_files.hpp"
#include "image/header.hpp"
#include "image/ktx2.hpp"
#include "model/accessor.hpp"
#include "model/views.hpp"

namespace gltfx::model {

/// The data of one image.
struct ImageData {
  std::optional<container::Bytes> bytes;  ///< the encoded image
  std::optional<image::Format> format;    ///< by its first bytes
  std::optional<image::Header> header;    ///< if it could be read
  /// The header of a KTX2 image, sound or not; null: another format. On the heap, because most
  /// images have none.
  std::shared_ptr<const image::Ktx2> ktx2;
};

/// The decoded elements of a compressed buffer view.
struct DecodedView {
  container::Bytes bytes;
  bool rounded = false;  ///< a filter rounded the values
};

/// Owns or maps the bytes. Read-only once filled; any number of threads may read it.
struct ResourceData {
  Origin origin;  ///< of all bytes
  /// By index, at least as many bytes as declared. Absent: missing, too short, or not to be read;
  /// the reason has been reported.
  std::vector<std::optional<container::Bytes>> buffers;
  std::vector<ImageData> images;  ///< by index
  /// By the node of the buffer view: data that replaces the bytes of the buffer.
  std::unordered_map<json::NodeId, DecodedView> decoded_views;
  /// Likewise, of those with a plain copy of other bytes, which is read in their place.
  std::unordered_map<json::NodeId, DecodedView> unread_views;

  /// The bytes [offset, offset + length) of a buffer view with their owner, or nothing when they
  /// are not inside the view and inside the bytes of its buffer, or of the decoded data. Accepts
  /// any numbers.
  std::optional<container::Bytes> part(const json::Document& document, const BufferView& view,
                                       std::uint64_t offset, std::uint64_t length) const;

  /// The bytes of all buffers.
  std::uint64_t buffer_bytes() const;

  /// The decoded data of a buffer view, or null.
  const DecodedView* decoded(const BufferView& view) const;
};

/// The member `byteOffset` of `object`, which was read as `byte_offset`: 0 when it is absent,
/// nothing when it is malformed.
std::optional<std::uint64_t> start_of(const json::Document& document, json::NodeId object,
                                      const std::optional<std::uint64_t>& byte_offset);

/// Data that could not be loaded.
struct MissingData {
  enum class Kind : std::uint8_t { buffer, buffer_view, image };
  Kind kind = Kind::buffer;
  std::size_t index = 0;
  std::string why;  ///< follows the name of the object: "is shorter than its byteLength"

  /// "Buffer 0 is shorter than its byteLength."
  std::string sentence() const;
};

struct LoadedResources {
  ResourceData data;
  std::vector<MissingData> missing;
};

/// Opens or decodes all buffers and images, maps files, reads headers of images, and decodes
/// meshoptimizer streams of buffer views, on up to `jobs` threads. Nothing outside of the
/// resolver's root is opened. With `images`, by index, other images are left out.
LoadedResources load_resources(const container::Container& container, container::OpenedFiles& files,
                               const Asset& asset, const Views& views, unsigned jobs,
                               const std::vector<bool>* images = nullptr);

}  // namespace gltfx::model
