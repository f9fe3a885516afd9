// SPDX-License-Identifier: Apache-2.0
/// Texts that live as long as the process.
#pragma once

#include <string_view>

namespace gltfx {

/// The same text, of static storage. Each different text takes memory for good: for the few names
/// that a user gives, such as codes of rules. Thread-safe.
std::string_view interned(std::string_view text);

}  // namespace gltfx
