// SPDX-License-Identifier: Apache-2.0
/// The bytes of an asset with edits made.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "container/container.hpp"
#include "edit/glb_rewrite.hpp"
#include "json/edit.hpp"

namespace gltfx::edit {

/// The bytes of the container with edits of its JSON text and a changed BIN chunk, as pieces one
/// behind the other; what stays is shown where it is, not copied. An Error when a GLB would be too
/// long. Precondition: there is a text, a GLB has no obstacle (find_glb_obstacle()), and `bin` is
/// empty for a text file.
Result<std::vector<container::Bytes>> rewrite(const container::Container& container,
                                              std::span<const json::Edit> edits,
                                              const BinChange& bin = {});

/// The container that these bytes make, under the name `path`. Where the BIN chunk stays nothing
/// but the text is made anew: `bytes` and the errors are the old ones.
Result<container::Container> rewritten(const container::Container& container,
                                       std::span<const json::Edit> edits, const BinChange& bin,
                                       const std::string& path);

}  // namespace gltfx::edit
