// SPDX-License-Identifier: Apache-2.0
/// The bytes of an asset with a new JSON text, for a GLB with a new JSON chunk and changes of its
/// BIN chunks (glTF 2.0 section 4.4, and the draft of glTF 2.1).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "base/shared_text.hpp"
#include "change/change.hpp"
#include "container/container.hpp"

namespace gltfx::change {

/// The error of a GLB, one sentence, that makes the places of its chunks uncertain; or nothing: the
/// file can be rewritten, also with wrong lengths.
std::optional<std::string> find_glb_obstacle(const container::Container& container);

/// The JSON of a GLB without the padding of its chunk, whose length is a multiple of `alignment`: a
/// new chunk gets its own.
std::string_view without_padding(std::string_view json, std::size_t alignment = 4);

/// The file with `json` in place of its JSON and changed BIN chunks: header and lengths are
/// updated, all other bytes stay, also uncounted bytes after the last chunk. An Error when the new
/// file would be too long for its header. Precondition: a GLB without obstacle. The pieces, in
/// order, are the file; unchanged parts are not copied.
Result<std::vector<container::Bytes>> rewrite_glb(const container::Container& container,
                                                  std::string_view json,
                                                  const BinChanges& bins = {});

/// A GLB of that JSON and, unless there are no pieces, a BIN chunk of them.
Result<std::vector<container::Bytes>> make_glb(std::string_view json,
                                               std::vector<container::Bytes> bin,
                                               std::uint32_t version = 2);

/// As rewrite_glb(), but fixes the container: chunks and the bytes between them get the lengths
/// that the version requires, and bytes after the last chunk are removed.
Result<std::vector<container::Bytes>> rewrite_sound(const container::Container& container,
                                                    std::string_view json,
                                                    const BinChanges& bins = {});

/// The GLB in another version, with `bins` as Change::glb_version says. Chunks of other types
/// follow in their order.
Result<std::vector<container::Bytes>> convert_glb(const container::Container& container,
                                                  std::string_view json, const BinChanges& bins,
                                                  std::uint32_t version);
/// Whether convert_glb() copies a chunk: it is neither the JSON of the asset nor a BIN chunk that
/// is replaced, and the version can hold it.
bool is_copied(const container::Container& container, const container::Chunk& chunk,
               std::uint32_t version);

/// The file of a container whose `json` may have been changed, as consecutive pieces; unchanged
/// parts are not copied. An Error when a GLB would be too long. Precondition: it has JSON, and a
/// GLB has no obstacle (find_glb_obstacle()).
Result<std::vector<container::Bytes>> rewrite(const container::Container& container);

}  // namespace gltfx::change
