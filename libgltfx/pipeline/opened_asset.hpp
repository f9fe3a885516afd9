// SPDX-License-Identifier: Apache-2.0
/// A file as far as every verb opens it that needs more than a verdict.
#pragma once

#include <optional>
#include <string>

#include "base/result.hpp"
#include "container/container.hpp"
#include "container/resolver.hpp"
#include "json/parse.hpp"

namespace gltfx {

struct OpenedAsset {
  container::Container container;
  container::Resolver resolver;
  json::Parsed parsed;  ///< the document has a root
};

/// Why the container has no text of a document, as half a sentence; nothing when it has one.
std::optional<Error> find_text_obstacle(const container::Container& container);
/// Why nothing can be made of the parsed text, as half a sentence; nothing when something can.
std::optional<Error> find_document_obstacle(const json::Parsed& parsed);

/// The Error is half a sentence: why there is no document. `root` as in ValidateOptions.
Result<OpenedAsset> open_asset(const std::string& path, const std::string& root);

}  // namespace gltfx
