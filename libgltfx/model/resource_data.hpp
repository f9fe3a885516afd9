// SPDX-License-Identifier: Apache-2.0
/// The bytes of buffers and images, opened once and kept for everything that reads data.
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

/// What is known of one image.
struct ImageData {
  std::optional<container::Bytes> bytes;  ///< the encoded image
  std::optional<image::Format> format;    ///< by its first bytes
  std::optional<image::Header> header;    ///< where it could be read
  /// Of a KTX2 image, sound or not; null: another format. Apart, since most images have none.
  std::shared_ptr<const image::Ktx2> ktx2;
};

/// The elements of a buffer view that came compressed.
struct DecodedView {
  container::Bytes bytes;
  bool rounded = false;  ///< went through a filter, which keeps no more bits than asked for
};

/// Owns or maps the bytes. Read-only once filled; any number of threads may read it.
struct ResourceData {
  Origin origin;  ///< of all of it
  /// By index, at least as many bytes as declared. Nothing: not there, too short, or not to be
  /// looked at; whoever filled this has said why.
  std::vector<std::optional<container::Bytes>> buffers;
  std::vector<ImageData> images;  ///< by index
  /// By the node of the buffer view, those that have nothing else: where there is one, it holds
  /// what the view has, and not the buffer.
  std::unordered_map<json::NodeId, DecodedView> decoded_views;

  /// The bytes [offset, offset + length) of a buffer view with their owner, or nothing when they do
  /// not lie inside the view and inside what is there of its buffer, or of what was decoded. Takes
  /// any numbers.
  std::optional<container::Bytes> part(const json::Document& document, const BufferView& view,
                                       std::uint64_t offset, std::uint64_t length) const;

  /// What was decoded for a buffer view, or null.
  const DecodedView* decoded(const BufferView& view) const;
};

/// The member `byteOffset` of `object`, which was read as `byte_offset`: 0 when it is absent,
/// nothing when it is malformed.
std::optional<std::uint64_t> start_of(const json::Document& document, json::NodeId object,
                                      const std::optional<std::uint64_t>& byte_offset);

struct LoadedResources {
  ResourceData data;
  std::vector<std::string> notes;  ///< what is missing and why, a sentence each
};

/// Opens or decodes all buffers and images, maps files, reads headers of images, and decodes buffer
/// views that come as streams of meshoptimizer, on up to `jobs` threads. Nothing outside of the
/// resolver's root is opened. With `images`, by index, others than those are left out.
LoadedResources load_resources(const container::Container& container, container::OpenedFiles& files,
                               const Asset& asset, const Views& views, unsigned jobs,
                               const std::vector<bool>* images = nullptr);

}  // namespace gltfx::model
