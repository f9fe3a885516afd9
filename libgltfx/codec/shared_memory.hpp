// SPDX-License-Identifier: Apache-2.0
/// Memory shared by two processes, and a way to take it over so that the other process cannot
/// change it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "base/unique_fd.hpp"

namespace gltfx::codec {

/// Empty shared memory: a memfd or, if the system refuses that, a file without a name in the folder
/// for temporary files. If both fail, no descriptor.
UniqueFd create_memory();

/// A mapping with one owner.
class Mapping {
 public:
  enum class Access : std::uint8_t { read, write };

  Mapping() = default;
  /// Maps the first `size` bytes; empty if that fails, or if `size` is 0. With write access, the
  /// memory of the descriptor gets this length.
  Mapping(int fd, std::uint64_t size, Access access);
  Mapping(Mapping&& other) noexcept;
  Mapping& operator=(Mapping&& other) noexcept;
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
  ~Mapping();

  std::span<std::byte> bytes() const { return bytes_; }

 private:
  std::span<std::byte> bytes_;
};

/// Writes `bytes` into empty shared memory. False if memory is missing.
bool fill_memory(int fd, std::span<const std::byte> bytes);

/// The first bytes of memory that another process has filled.
struct Taken {
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> owner;
};
/// Takes over `size` bytes so that they can no longer change or be truncated: sealed and mapped or,
/// if sealing fails, copied. Nothing if there are fewer bytes.
std::optional<Taken> take_memory(int fd, std::uint64_t size);

}  // namespace gltfx::codec
