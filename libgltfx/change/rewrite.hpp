// SPDX-License-Identifier: Apache-2.0
/// The bytes of an asset with another JSON text, among them a GLB with another JSON chunk and more
/// in its BIN chunk (glTF 2.0 section 4.4).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "base/shared_text.hpp"
#include "change/change.hpp"
#include "container/container.hpp"

namespace gltfx::change {

/// What error of a GLB leaves open where its chunks lie, or nothing: the file can be rewritten,
/// also when its lengths are wrong. A sentence.
std::optional<std::string> find_glb_obstacle(const container::Container& container);

/// The file with `json` in place of its JSON and a changed BIN chunk: header and lengths follow,
/// all else stays byte for byte, as does what may follow the last chunk uncounted. An Error when
/// the new file would be too long for its header. Precondition: a GLB without obstacle. The pieces,
/// in order, are the file; what stays is shown where it is, not copied.
Result<std::vector<container::Bytes>> rewrite_glb(const container::Container& container,
                                                  std::string_view json, const BinChange& bin = {});

/// A GLB of that JSON and, unless it is empty, that BIN chunk.
Result<std::vector<container::Bytes>> make_glb(std::string_view json, std::string bin);

/// As rewrite_glb(), but nothing of the container stays that it must not have: each chunk has a
/// length that is a multiple of 4, and zeros behind the last chunk go.
Result<std::vector<container::Bytes>> rewrite_sound(const container::Container& container,
                                                    std::string_view json,
                                                    const BinChange& bin = {});

/// The file of a container whose `json` may have been changed, as pieces one behind the other; what
/// stays is shown where it is, not copied. An Error when a GLB would be too long. Precondition: it
/// has JSON, and a GLB has no obstacle (find_glb_obstacle()).
Result<std::vector<container::Bytes>> rewrite(const container::Container& container);

}  // namespace gltfx::change
