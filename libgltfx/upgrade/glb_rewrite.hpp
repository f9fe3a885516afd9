// SPDX-License-Identifier: Apache-2.0
/// A GLB with another JSON chunk and more in its BIN chunk (glTF 2.0 section 4.4).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "container/container.hpp"

namespace gltfx::upgrade {

/// What fault of a GLB leaves open where its chunks lie, or nothing: the file can be rewritten,
/// also when its lengths are wrong. A sentence.
std::optional<std::string> find_glb_obstacle(const container::Container& container);

/// The file with `json` in place of its JSON and `more` behind the data of its BIN chunk, which is
/// made when there is none: header and lengths follow, all else stays byte for byte, as does what
/// may follow the last chunk uncounted. An Error when the new file would be too long for its
/// header. Precondition: a GLB without obstacle.
Result<std::string> rewrite_glb(const container::Container& container, std::string_view json,
                                std::string_view more = {});

}  // namespace gltfx::upgrade
