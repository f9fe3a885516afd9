// SPDX-License-Identifier: Apache-2.0
/// Pictures of the report page that an earlier run has drawn, as a ResultCache keeps them.
#pragma once

#include <gltfx/bake.hpp>
#include <gltfx/page.hpp>
#include <gltfx/validate.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "container/resolver.hpp"
#include "model/opened_asset.hpp"
#include "pipeline/cached_verb.hpp"
#include "pipeline/open_asset.hpp"

namespace gltfx {

/// Of one asset. Calls in this order: look_up() before the asset is opened; look_up() with the
/// asset before its resources are read, unless they were recorded; recall(); where that has none,
/// keep().
class KeptPictures {
 public:
  /// Without `ValidateOptions::cache` there are none. `path` outlives it.
  KeptPictures(const std::string& path, const ValidateOptions& options, const BakeOptions& bake);
  void look_up();
  void look_up(model::OpenedAsset& asset);
  /// Fills in the pictures of the page. False when none are kept.
  bool recall(PageAsset& page) const;
  void keep(const PageAsset& page);

 private:
  AssetBounds bounds_;
  std::optional<CacheEntry> entry_;
  std::optional<std::string> known_;
  container::Resolver resolver_;
  std::shared_ptr<const container::LookupLog> lookups_;
  std::uint64_t chances_ = 0;
};

}  // namespace gltfx
