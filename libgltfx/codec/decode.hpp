// SPDX-License-Identifier: Apache-2.0
/// What a decoder is, wherever it runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "codec/protocol.hpp"

namespace gltfx::codec {

/// Room for as many bytes that a decoder hands over, all 0; empty when there is none. Call once.
using Output = std::function<std::span<std::byte>(std::uint64_t size)>;

/// Decodes one payload. May throw std::bad_alloc, which becomes an answer.
using Decode = std::function<Answer(const Job&, std::span<const std::byte>, const Output&)>;

/// The same, with an answer for whatever is thrown.
Answer decode_safely(const Decode& decode, const Job& job, std::span<const std::byte> bytes,
                     const Output& output);

}  // namespace gltfx::codec
