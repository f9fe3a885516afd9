// SPDX-License-Identifier: Apache-2.0
/// A GLB with another JSON chunk (glTF 2.0 section 4.4).
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

/// The file with `json` in place of its JSON: header and lengths follow, all other chunks stay byte
/// for byte, as does what may follow the last one uncounted. An Error when the new file would be
/// too long for its header. Precondition: a GLB without obstacle.
Result<std::string> rewrite_glb(const container::Container& container, std::string_view json);

}  // namespace gltfx::upgrade
