// SPDX-License-Identifier: Apache-2.0
/// Which system calls a decoder may make.
#pragma once

namespace gltfx::codec {

/// Lets all threads of the process make only the calls that memory, one socket and the end of the
/// process need; others fail with EPERM. Precondition: no_new_privs. False when the system has no
/// such filters or the processor is none that this knows.
bool filter_syscalls();

}  // namespace gltfx::codec
