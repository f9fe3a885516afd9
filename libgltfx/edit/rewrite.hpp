// SPDX-License-Identifier: Apache-2.0
/// The bytes of an asset with another JSON text.
#pragma once

#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/shared_text.hpp"
#include "container/container.hpp"
#include "edit/glb_rewrite.hpp"

namespace gltfx::edit {

/// The bytes of the container with another JSON text and a changed BIN chunk, as pieces one
/// behind the other; what stays is shown where it is, not copied. An Error when a GLB would be too
/// long. Precondition: `json` is not null, a GLB has no obstacle (find_glb_obstacle()), and `bin`
/// is empty for a text file.
Result<std::vector<container::Bytes>> rewrite(const container::Container& container,
                                              const SharedText& json, const BinChange& bin = {});

/// The container that these bytes make, under the name `path`. Where the BIN chunk stays nothing
/// but the text is made anew: `bytes` and the errors are the old ones.
Result<container::Container> rewritten(const container::Container& container,
                                       const SharedText& json, const BinChange& bin,
                                       const std::string& path);

}  // namespace gltfx::edit
