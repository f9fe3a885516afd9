// SPDX-License-Identifier: Apache-2.0
/// The ways in which an asset is stored.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "graph/graph.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// Of what is moved to another buffer: the size of the widest component that an extension has.
inline constexpr std::uint64_t kAlignment = 8;

/// One GLB with all buffers and images.
Result<StepOutcome> pack(const StepInput& input);

/// JSON text, with files or data URIs according to the options.
Result<StepOutcome> store_as_text(const StepInput& input);

/// Why references to `things` ("buffers") may be unknown, half a sentence; empty: all are known.
std::string find_doubt(const graph::Graph& graph, std::string_view things);

/// Number of bytes of a BIN chunk of `size` bytes that are data of its buffer: the declared ones,
/// or all if the chunk is longer than padding explains.
constexpr std::uint64_t chunk_data_length(std::uint64_t declared, std::uint64_t size) {
  return declared <= size && size - declared < 4 ? declared : size;
}

/// "FORM, 2 buffers, 1 image".
std::string describe_moves(std::string_view form, std::uint64_t buffers, std::uint64_t images);

inline constexpr const char* kUnusedChunk = "no buffer has the BIN chunk as its data";

}  // namespace gltfx::steps
