// SPDX-License-Identifier: Apache-2.0
/// Takes a GLB apart (glTF 2.0 section 4.4) and names its errors as the Khronos validator does.
#pragma once

#include <optional>

#include "container/container.hpp"
#include "container/file.hpp"

namespace gltfx::container {

/// Fills chunks, JSON, errors and version of `container`; the file's bytes are the caller's. Never
/// allocates by a length that stands in the file before it was checked against what is there.
/// The return value tells why the source could not be read, if so.
std::optional<Copied> read_glb(const Source& source, Container& container);

}  // namespace gltfx::container
