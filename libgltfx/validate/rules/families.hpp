// SPDX-License-Identifier: Apache-2.0
/// One function a file of this folder.
#pragma once

#include "validate/context.hpp"

namespace gltfx::validate {

// What phases 1 to 3 find by themselves: only the tables.
const Family& glb_family();
const Family& json_family();
const Family& schema_family();
const Family& extension_family();
const Family& extension_use_family();
const Family& fallback_family();
const Family& identity_family();
const Family& resource_family();

}  // namespace gltfx::validate
