// SPDX-License-Identifier: Apache-2.0
/// Opens what holds a glTF asset: a .gltf or .glb file, bytes, or a stream that was read whole.
///
/// Nothing is read that nobody asks for: files are mapped, buffers and images stay on the disk
/// until a phase wants them, and nothing outside the asset's root is ever opened
/// (`container/resolver.hpp`).
#pragma once

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

/// What the bytes are. Their first bytes tell; only where these are nothing known (empty, neither
/// JSON nor GLB nor a pointer) a name that ends in ".glb" makes it a GLB with an error.
enum class Format : std::uint8_t {
  gltf,  ///< JSON text
  glb,   ///< binary container, version 2
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
};

/// One chunk of a GLB. Offsets are in the file; the data lies inside it.
struct Chunk {
  std::uint32_t type = 0;           ///< as the little-endian number that stands in the file
  std::uint64_t header_offset = 0;  ///< byte of the chunk's header
  std::uint64_t offset = 0;         ///< first byte of its data
  std::uint64_t length = 0;         ///< bytes of data that are really there
};

inline constexpr std::uint32_t kChunkJson = 0x4E4F534A;
inline constexpr std::uint32_t kChunkBin = 0x004E4942;

/// A container taken apart. Owns (or maps) the bytes; the JSON text is a copy, so that a file
/// changed by somebody else while it is read cannot change under the parser.
struct Container {
  Format format = Format::unknown;
  Bytes bytes;                         ///< the whole file
  SharedText json;                     ///< null when there is none
  std::uint64_t json_offset = 0;       ///< byte in the file where the JSON begins
  std::vector<Chunk> chunks;           ///< GLB only, in the order of the file
  std::optional<Chunk> bin;            ///< the BIN chunk that buffer 0 may refer to
  std::vector<ContainerError> errors;  ///< found before the JSON is read
  std::vector<ContainerError>
      late_errors;  ///< end-of-file errors: reported behind those of the JSON
  std::optional<std::uint32_t> glb_version;  ///< of a GLB header, also when it is not 2
  /// GLB: the file ends inside the header, a chunk header or a chunk. What the chunks hold is not
  /// to be judged then: resources that lie in them are missing because of the cut, not by mistake.
  bool cut_short = false;
  /// GLB: the file's last chunk is complete and has no data. (The Khronos validator reads no
  /// resources then and does not compare the lengths.)
  bool ends_in_empty_chunk = false;
  /// GLB with a known mistake of writers, of which `errors` names the cause alone: all that follows
  /// from reading it as it is. Its `bytes` are not set.
  std::shared_ptr<const Container> literal;
};

/// The container as it is, mistakes and what follows from them.
Container literal_reading(const Container& container);

struct OpenLimits {
  std::uint64_t max_bytes = UINT64_MAX;  ///< larger files are refused
};

/// Most chunks that are read of one GLB. The specification knows two; a file of nothing but chunk
/// headers must not become gigabytes of records. The rest gives one GLB_TOO_MANY_CHUNKS.
inline constexpr std::size_t kMaxChunks = 4096;

/// Opens and takes apart a regular file. An Error when it cannot be read at all: missing, no
/// permission, not a regular file, a folder, JSON text of 4 GiB or more.
Result<Container> open_file(const std::filesystem::path& path, const OpenLimits& limits = {});

/// The same for bytes that are already in memory, which the container keeps. `name` is looked at as
/// `Format` says and may be left out.
Container open_bytes(Bytes bytes, std::string_view name = {});
/// The same for bytes that are said to be `format`, one of gltf and glb.
Container open_bytes(Bytes bytes, Format format);

/// As open_file() of container.hpp; `path` is the name of the asset.
Result<Container> open_file(const File& file, const std::filesystem::path& path,
                            const OpenLimits& limits = {});

}  // namespace gltfx::container
