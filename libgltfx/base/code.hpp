// SPDX-License-Identifier: Apache-2.0
/// Codes of rules. What raises findings includes base/codes.hpp, which the build writes.
#pragma once

#include <cstdint>
#include <string_view>

namespace gltfx {

/// The code of a rule: one value a page of schema/rules/.
enum class Code : std::uint16_t;

/// Name of the code, static storage: "NODE_EMPTY".
std::string_view code_name(Code code);

}  // namespace gltfx
