// SPDX-License-Identifier: Apache-2.0
/// Files with the sizes of products.
#pragma once

#include <gltfx/limit.hpp>

#include <memory>
#include <string>

#include "base/result.hpp"

namespace gltfx::tool {

/// A CSV with the columns file, size-x, size-y and size-z, in metres or with a unit, where an empty
/// field is any size; or the JSON of the Khronos glTF Asset Auditor, which has one product. A file
/// with a folder is taken from the folder of the list, one without anywhere. The Error names a
/// line.
Result<std::shared_ptr<const ProductList>> read_products(const std::string& path);

}  // namespace gltfx::tool
