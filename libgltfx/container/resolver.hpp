// SPDX-License-Identifier: Apache-2.0
/// Opens files that an asset names, and nothing outside the folder it is trusted with.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "container/bytes.hpp"

namespace gltfx::container {

/// Why a resource could not be opened.
enum class ResolveFault : std::uint8_t {
  none,
  not_found,
  outside_root,   ///< "..", an absolute path or a symbolic link leads out of the root
  not_regular,    ///< a folder, FIFO, socket or device
  no_permission,
  no_root,        ///< standard input without --root: external files are not looked up
  io_error,
  truncated,      ///< shorter than when it was opened
  too_large,
};

struct Resolved {
  ResolveFault fault = ResolveFault::none;
  Bytes bytes;           ///< mapped; valid when fault is none
  bool git_lfs_pointer = false;
  std::string problem;   ///< printable detail of the fault
};

/// How the root is enforced. `automatic` asks the kernel (openat2 with RESOLVE_BENEATH) and does it
/// by hand where the kernel refuses; `by_hand` is for tests and old kernels. Both behave alike.
enum class Confinement : std::uint8_t { automatic, by_hand };

/// Confined to `root`; relative references are resolved against `base`, which lies inside the root.
/// Safe to use from several threads.
class Resolver {
 public:
  /// No root: every look-up answers `no_root`.
  Resolver() = default;
  Resolver(std::filesystem::path root, std::filesystem::path base,
           Confinement confinement = Confinement::automatic);

  /// Opens `path` (percent-decoded, '/' separated). Symbolic links are followed while they stay
  /// inside the root; only regular files are opened, without blocking.
  Resolved open(std::string_view path) const;
  /// Whether open() would find a file, without reading it. Size in bytes in `size`.
  ResolveFault stat(std::string_view path, std::uint64_t& size) const;

 private:
  std::filesystem::path root_;
  std::filesystem::path base_;
  Confinement confinement_ = Confinement::automatic;
  bool has_root_ = false;
};

}  // namespace gltfx::container
