// SPDX-License-Identifier: Apache-2.0
/// @file
/// Files that become shorter while they are read.
#pragma once

namespace gltfx {

/// Large buffers are mapped, and reading a page that another program has cut off meanwhile raises
/// SIGBUS. The library installs no signal handler. To get a finding instead of a crash, a program
/// calls this function from its own handler, with the address of the fault (`si_addr`). If the
/// address is in a file that gltfx has mapped, the rest of the mapping becomes zeros, the read can
/// be repeated, and validation reports an IO_ERROR for the resource.
///
/// False when the address is not in such a file: the fault has another cause. Async-signal-safe and
/// thread-safe; keeps errno.
bool repair_mapping(const void* address) noexcept;

}  // namespace gltfx
