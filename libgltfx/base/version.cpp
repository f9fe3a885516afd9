// SPDX-License-Identifier: Apache-2.0
#include <gltfx/version.hpp>

namespace gltfx {

std::string_view version() { return GLTFX_VERSION; }

}  // namespace gltfx
