// SPDX-License-Identifier: Apache-2.0
/// Whether a text is UTF-8, and where not.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/span.hpp"

namespace gltfx::json {

/// One vectorised pass over the text.
bool is_utf8(std::string_view text);

/// The bytes of the first sequence that is not UTF-8: the lead and the tails that follow it, as
/// far as it announces them. Precondition: there is one.
Span first_invalid_utf8(std::string_view text);

}  // namespace gltfx::json
