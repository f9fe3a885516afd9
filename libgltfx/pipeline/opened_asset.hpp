// SPDX-License-Identifier: Apache-2.0
/// A file as far as every verb opens it that needs more than a verdict.
#pragma once

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

/// The Error is half a sentence: why there is no document. `root` as in ValidateOptions.
Result<OpenedAsset> open_asset(const std::string& path, const std::string& root);

}  // namespace gltfx
