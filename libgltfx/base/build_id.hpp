// SPDX-License-Identifier: Apache-2.0
/// What tells one build of a program from another.
#pragma once

#include <string>

namespace gltfx {

/// The bytes that the linker gave the running program as its name (the ELF note NT_GNU_BUILD_ID);
/// empty where it gave none.
const std::string& build_id();

}  // namespace gltfx
