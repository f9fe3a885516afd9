// SPDX-License-Identifier: Apache-2.0
/// The ways in which an asset is stored.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "container/bytes.hpp"
#include "graph/graph.hpp"
#include "json/edit.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// Alignment of bytes that move to another buffer: the widest component of any extension.
inline constexpr std::uint64_t kAlignment = 8;
/// Alignment of vertex attributes (glTF 2.0 section 3.6.2.4).
inline constexpr std::uint64_t kVertexAlignment = 4;

/// The first multiple of an alignment that is not less than `size`.
constexpr std::uint64_t aligned(std::uint64_t size, std::uint64_t alignment = kAlignment) {
  return (size + alignment - 1) / alignment * alignment;
}

/// The first offset that is not less than `size` and equals `begin` modulo kAlignment.
constexpr std::uint64_t aligned_like(std::uint64_t begin, std::uint64_t size) {
  return size + (begin % kAlignment + kAlignment - size % kAlignment) % kAlignment;
}

/// One GLB with all buffers and images, or only in another version if the options say no storage.
Result<StepOutcome> pack(const StepInput& input);

/// JSON text, with files or data URIs according to the options.
Result<StepOutcome> store_as_text(const StepInput& input);

/// Paths that new files must not have.
std::set<std::string> taken_names(const StepInput& input);

/// Whether a file with new content can keep its name: the new asset goes alone to a folder other
/// than that of the old asset. In other folders, other assets may refer to files of that name.
bool keeps_file_names(const StepInput& input);

/// The name of the new asset without its ending, as a file name that is valid on any system.
std::string asset_stem(const StepInput& input);

/// A path without the ending of its file.
std::string stem_of(const std::string& path);

/// The stem of a path, inside the folder of the asset.
std::string stem_in_folder(const std::string& path);

/// "-0123abcd", from the content of a file: the same pieces get the same mark.
std::string content_mark(const std::vector<container::Bytes>& pieces);

/// Why references to `things` ("buffers") may be unknown, half a sentence; empty: all are known.
std::string find_doubt(const graph::Graph& graph, std::string_view things);

/// Number of bytes of a BIN chunk of `size` bytes that are data of its buffer: the declared ones,
/// or all if the chunk is longer than padding explains.
constexpr std::uint64_t chunk_data_length(std::uint64_t declared, std::uint64_t size) {
  return declared <= size && size - declared < 4 ? declared : size;
}

/// Blanks after a JSON text that goes into a chunk, if it ends in white space: that would count as
/// padding of the chunk, which may only have blanks, unless it is longer than any padding.
std::optional<json::Edit> blanks_after(std::string_view text);

/// "FORM, 2 buffers, 1 image".
std::string describe_moves(std::string_view form, std::uint64_t buffers, std::uint64_t images);

inline constexpr const char* kUnusedChunk = "no buffer has the BIN chunk as its data";

}  // namespace gltfx::steps
