// SPDX-License-Identifier: Apache-2.0
/// The life of a decoder program: what its main() calls.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "codec/protocol.hpp"
#include "codec/shared_memory.hpp"

namespace gltfx::codec {

/// Where a decoder writes what it hands over.
class Output {
 public:
  explicit Output(int fd) : fd_(fd) {}
  /// Room for `size` bytes, all 0; empty when there is none. Call once.
  std::span<std::byte> create(std::uint64_t size);

 private:
  int fd_;
  Mapping mapping_;
};

/// Decodes one payload. May throw std::bad_alloc, which becomes an answer.
using Decode = std::function<Answer(const Job&, std::span<const std::byte>, Output&)>;

/// Runs `prepare`, which loads and touches all that decoding will need; then forks a worker for
/// each time that the client asks for one, until the client closes its socket. A worker locks
/// itself in, greets, and serves jobs. Gives the exit code.
int serve(const std::function<void()>& prepare, const Decode& decode);

}  // namespace gltfx::codec
