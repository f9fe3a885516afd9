// SPDX-License-Identifier: Apache-2.0
/// Identifies a build of a program.
#pragma once

#include <string>

namespace gltfx {

/// The build id that the linker wrote into the running program (the ELF note NT_GNU_BUILD_ID);
/// empty if there is none.
const std::string& build_id();

}  // namespace gltfx
