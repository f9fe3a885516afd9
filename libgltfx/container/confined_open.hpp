// SPDX-License-Identifier: Apache-2.0
/// Opens a file below a folder and nowhere else, whatever "..", links and races try.
#pragma once

#include <cstdint>
#include <string>

#include "container/file.hpp"

namespace gltfx::container {

/// How the root is enforced. `automatic` asks the kernel (openat2 with RESOLVE_BENEATH) and does it
/// by hand where the kernel refuses; `by_hand` is for tests and old kernels. Both behave alike.
enum class Confinement : std::uint8_t { automatic, by_hand };

/// Opens `path` below the folder `root` (any descriptor of it, O_PATH will do).
///
/// Symbolic links are followed, at most 40; an absolute one only when it leads back into the root.
/// ".." above the root is `outside_root`, and so is anything a link finds or misses out there, so
/// that nothing can be learnt about files outside. Only regular files are opened, without blocking.
File open_beneath(int root, const std::string& path, Confinement confinement);

/// The way by hand: component after component, each through a descriptor of the folder above it.
File walk_beneath(int root, const std::string& path);

}  // namespace gltfx::container
