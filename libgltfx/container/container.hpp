// SPDX-License-Identifier: Apache-2.0
/// Opens a container of a glTF asset: a .gltf or .glb file, bytes, or a stream that was read whole.
///
/// Nothing is read before it is needed: files are mapped, buffers and images stay on the disk until
/// a phase uses them, and nothing outside the asset's root is ever opened
/// (`container/resolver.hpp`).
#pragma once

#include <gltfx/diagnostic.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/code.hpp"
#include "base/result.hpp"
#include "base/shared_text.hpp"
#include "base/span.hpp"
#include "container/bytes.hpp"
#include "container/file.hpp"

namespace gltfx::container {

/// The format of the bytes. The first bytes decide; if they are not recognised (empty, or neither
/// JSON nor GLB nor a pointer), a name that ends in ".glb" makes it a GLB with an error.
enum class Format : std::uint8_t {
  gltf,  ///< JSON text
  glb,   ///< binary container
  git_lfs_pointer,
  empty,
  unknown,
};

/// An error of the container. `code` is a rule's code (Khronos names for GLB errors).
struct ContainerError {
  Code code;
  std::uint64_t offset = 0;  ///< byte in the file
  std::string message;
  std::string help;
  std::optional<Severity> severity = {};  ///< instead of that of the code
};

/// One chunk of a GLB. Offsets are in the file; the data is inside it.
struct Chunk {
  std::uint32_t type = 0;           ///< the little-endian number in the file
  std::uint32_t encoding = 0;       ///< 0: the data is not encoded; always 0 before version 3
  std::uint64_t header_offset = 0;  ///< byte of the chunk's header
  std::uint64_t offset = 0;         ///< first byte of its data
  std::uint64_t length = 0;         ///< bytes of data that exist in the file
};

inline constexpr std::uint32_t kChunkJson = 0x4E4F534A;
inline constexpr std::uint32_t kChunkBin = 0x004E4942;

/// A parsed container. Owns (or maps) the bytes; the JSON text is a copy, so that it cannot change
/// during parsing when another program writes the file.
struct Container {
  Format format = Format::unknown;
  Bytes bytes;                    ///< the whole file
  SharedText json;                ///< null when there is none
  std::uint64_t json_offset = 0;  ///< byte in the file where the JSON begins
  std::vector<Chunk> chunks;      ///< GLB only, in the order of the file
  /// The BIN chunk that buffer 0 may refer to without an index: that of version 2, or chunk 1 of
  /// version 3 if chunk 0 is JSON.
  std::optional<Chunk> bin;
  std::vector<ContainerError> errors;  ///< found before the JSON is read
  std::vector<ContainerError>
      late_errors;  ///< end-of-file errors: reported after those of the JSON
  std::optional<std::uint32_t> glb_version;  ///< of a GLB header, also when it is unknown
  /// GLB: the file ends inside the header, a chunk header or a chunk. The contents of the chunks
  /// are not judged then: resources in them are missing because of the truncation.
  bool cut_short = false;
  /// GLB: the file's last chunk is complete and has no data. (The Khronos validator reads no
  /// resources then and does not compare the lengths.)
  bool ends_in_empty_chunk = false;
  /// GLB with a known mistake of writers, for which `errors` has the cause only: the literal
  /// reading with all resulting errors. Its `bytes` are not set. Of a GLB of version 3: what
  /// readers of version 2 see.
  std::shared_ptr<const Container> literal;
};

/// The literal reading of the container, with all errors.
Container literal_reading(const Container& container);

struct OpenLimits {
  std::uint64_t max_bytes = UINT64_MAX;  ///< larger files are refused
};

/// Maximum number of chunks that are read. Version 2 of GLB defines two, version 3 any number; a
/// file of chunk headers only must not become gigabytes of records. The rest gives one
/// GLB_TOO_MANY_CHUNKS.
inline constexpr std::size_t kMaxChunks = 4096;
inline constexpr std::size_t kMaxChunksOfVersion3 = std::size_t{1} << 20U;

/// Opens and parses a regular file. An Error when it cannot be read at all: missing, no permission,
/// not a regular file, a folder, JSON text of 4 GiB or more.
Result<Container> open_file(const std::filesystem::path& path, const OpenLimits& limits = {});

/// The same for bytes that are already in memory, which the container keeps. `name` is used as
/// `Format` says and may be empty.
Container open_bytes(Bytes bytes, std::string_view name = {});
/// The same for bytes of a given `format`, gltf or glb.
Container open_bytes(Bytes bytes, Format format);

/// As open_file() of container.hpp; `path` is the name of the asset.
Result<Container> open_file(const File& file, const std::filesystem::path& path,
                            const OpenLimits& limits = {});

}  // namespace gltfx::container
