// SPDX-License-Identifier: Apache-2.0
/// The page without its data, which the build combines from page/.
#pragma once

#include <string_view>

namespace gltfx::report {

std::string_view page_begin();  ///< up to the block of data
std::string_view page_end();    ///< after the block of data

}  // namespace gltfx::report
