// SPDX-License-Identifier: Apache-2.0
/// An asset from a JSON text, for tests of the model.
#pragma once

#include <string_view>

#include "json/parse.hpp"
#include "model/asset.hpp"

namespace gltfx::test {

/// Keeps the document that the asset refers to.
struct AssetText {
  explicit AssetText(std::string_view text)
      : document(json::parse(text).document), asset(document) {}
  AssetText(const AssetText&) = delete;
  AssetText& operator=(const AssetText&) = delete;

  json::Document document;
  model::Asset asset;
};

}  // namespace gltfx::test
