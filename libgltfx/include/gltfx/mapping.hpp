// SPDX-License-Identifier: Apache-2.0
/// @file
/// Files that become shorter while they are read.
#pragma once

namespace gltfx {

/// Large buffers are mapped, and reading a page that another program has cut off meanwhile raises
/// SIGBUS. The library installs no signal handler. To get a finding instead of its end, a program
/// calls this from its own, with the address of the fault (`si_addr`): when it lies in a file that
/// gltfx has mapped, the rest of the mapping becomes zeros, the read can be repeated, and
/// validation reports an IO_ERROR for the resource.
///
/// False when the address is none of ours: then the fault has another cause. Async-signal-safe and
/// thread-safe; keeps errno.
bool repair_mapping(const void* address) noexcept;

}  // namespace gltfx
