// SPDX-License-Identifier: Apache-2.0
/// Bytes that are put together: parts of an old file and new ones between them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/file_draft.hpp"
#include "container/bytes.hpp"

namespace gltfx::container {

/// All of them in one text.
std::string join(const std::vector<Bytes>& pieces);

/// Writes one behind the other. Of a mapped file a few megabytes are resident at a time. Nothing
/// when all is written, else why it is not.
std::optional<Error> write_pieces(FileDraft& draft, const std::vector<Bytes>& pieces);

/// Whether the bytes are the same; as careful with memory.
bool same_bytes(const Bytes& one, const Bytes& other);

}  // namespace gltfx::container
