// SPDX-License-Identifier: Apache-2.0
/// Parses a GLB of version 2 (glTF 2.0 section 4.4), whose errors are named as the Khronos
/// validator does, or of version 3 (the draft of glTF 2.1).
#pragma once

#include <optional>

#include "container/container.hpp"
#include "container/file.hpp"

namespace gltfx::container {

/// Fills chunks, JSON, errors and version of `container`; the file's bytes are the caller's. Never
/// allocates by a length in the file before it is checked against the file's size. Returns why the
/// source could not be read, if so.
std::optional<Copied> read_glb(const Source& source, Container& container);

/// The rest of a file whose header says version 3.
std::optional<Copied> read_glb_3(const Source& source, Container& container);

}  // namespace gltfx::container
