// SPDX-License-Identifier: Apache-2.0
/// Writes the headers of a GLB, its chunks and the padding of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "container/bytes.hpp"

namespace gltfx::change {

/// Of the chunks in a GLB of version 2, and of their lengths.
inline constexpr std::uint64_t kAlignmentOf2 = 4;
/// Of the starts of chunks in a GLB of version 3.
inline constexpr std::uint64_t kAlignmentOf3 = 8;

constexpr std::uint64_t header_size(std::uint32_t version) { return version == 3 ? 16 : 12; }
constexpr std::uint64_t chunk_header_size(std::uint32_t version) { return version == 3 ? 16 : 8; }

/// The length that the header of a GLB of version 3 states.
std::uint64_t declared_length(std::string_view glb);

class GlbWriter {
 public:
  explicit GlbWriter(std::uint32_t version)
      : version_(version), pieces_(1), size_(header_size(version)) {}

  /// Bytes of another GLB of the same version.
  void put(container::Bytes bytes);
  /// A whole chunk. In version 2, padding completes its length, which is that of `data` otherwise.
  void chunk(std::uint32_t type, std::uint32_t encoding, std::vector<container::Bytes> data);
  /// The JSON chunk. In version 3, its length is a multiple of 8 or 4 if `old_length` is.
  void json(std::string_view text, std::uint64_t old_length);
  /// In version 3: zeros to where a chunk may start.
  void align();
  /// The file; its last `uncounted` bytes are not part of its length. Nothing: it is too long for
  /// its version. Ends the use of the writer.
  std::optional<std::vector<container::Bytes>> finish(std::uint64_t uncounted) &&;

 private:
  std::uint32_t version_;
  std::vector<container::Bytes> pieces_;  ///< the first is the header
  std::uint64_t size_;
};

}  // namespace gltfx::change
