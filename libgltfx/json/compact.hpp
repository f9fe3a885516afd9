// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace gltfx::json {

/// A text without the spaces, tabs and line breaks between its tokens (RFC 8259, section 2).
/// Precondition: the text is valid JSON.
std::string compact(std::string_view text);

}  // namespace gltfx::json
