// SPDX-License-Identifier: Apache-2.0
/// Several changes within one step, each based on the result of the previous one.
#pragma once

#include <optional>

#include "base/result.hpp"
#include "change/change.hpp"
#include "model/opened_asset.hpp"

namespace gltfx::steps {

/// Collects changes of text and new files. Keeps a reference to the asset.
class Stages {
 public:
  explicit Stages(const model::OpenedAsset& before) : before_(before) {}

  /// The asset after all changes so far.
  const model::OpenedAsset& asset() const { return now_ ? *now_ : before_; }
  /// Places a change and applies it to asset(). Returns an Error (half a sentence) if that fails.
  std::optional<Error> add(change::Change change);
  /// All changes, combined into one change of the original asset.
  change::Change take() { return std::move(all_); }

 private:
  const model::OpenedAsset& before_;
  std::optional<model::OpenedAsset> now_;
  change::Change all_;
};

}  // namespace gltfx::steps
