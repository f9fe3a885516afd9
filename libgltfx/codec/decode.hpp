// SPDX-License-Identifier: Apache-2.0
/// The interface of a decoder, in a worker or in this process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "codec/protocol.hpp"

namespace gltfx::codec {

/// Allocates the output of a decoder, all 0; empty on failure. Call once.
using Output = std::function<std::span<std::byte>(std::uint64_t size)>;

/// Decodes one payload. May throw std::bad_alloc, which becomes an error answer.
using Decode = std::function<Answer(const Job&, std::span<const std::byte>, const Output&)>;

/// The same; exceptions become error answers.
Answer decode_safely(const Decode& decode, const Job& job, std::span<const std::byte> bytes,
                     const Output& output);

/// Writes a file that an encoder has made to the output; an error without memory for it.
Answer hand_over(std::span<const std::byte> file, const Output& output);

}  // namespace gltfx::codec
