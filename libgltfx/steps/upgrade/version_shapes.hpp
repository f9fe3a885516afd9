// SPDX-License-Identifier: Apache-2.0
/// The shapes of an extension as the shapes of glTF 2.1.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "json/document.hpp"
#include "schema/set.hpp"

namespace gltfx::upgrade {

/// The shapes of the extension in the form of glTF 2.1, as JSON; nothing: the document has none. An
/// Error, half a sentence, says why they cannot move.
std::optional<Result<std::vector<std::string>>> shapes_of_extension(const json::Document& document,
                                                                    const schema::Set& set);

}  // namespace gltfx::upgrade
