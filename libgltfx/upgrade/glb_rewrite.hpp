// SPDX-License-Identifier: Apache-2.0
/// A GLB with another JSON chunk (glTF 2.0 section 4.4).
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"
#include "container/container.hpp"

namespace gltfx::upgrade {

/// The file with `json` in place of its JSON: header and lengths follow, all other chunks stay byte
/// for byte. An Error when the new file would be too long for its header. Precondition: a GLB that
/// was read without faults.
Result<std::string> rewrite_glb(const container::Container& container, std::string_view json);

}  // namespace gltfx::upgrade
