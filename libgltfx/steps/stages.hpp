// SPDX-License-Identifier: Apache-2.0
/// Several changes, each based on the result of the previous one.
#pragma once

#include <memory>
#include <optional>

#include "base/result.hpp"
#include "change/change.hpp"
#include "model/opened_asset.hpp"

namespace gltfx::steps {

/// Combines changes into one change of an asset. Keeps a reference to the asset.
class Stages {
 public:
  explicit Stages(const model::OpenedAsset& before) : before_(before) {}

  /// The asset after all changes that were applied.
  const model::OpenedAsset& asset() const { return now_ ? *now_ : before_; }
  /// Keeps that asset for as long as the pointer; null: it is the original one.
  std::shared_ptr<const model::OpenedAsset> share() const { return now_; }
  /// Adds a change of asset(), which is the same until apply(). Returns an Error (half a sentence)
  /// if there is no room for it. Precondition: all changes before are applied.
  std::optional<Error> add(change::Change change);
  /// Applies the last change, if it is not yet applied, to asset(). Returns an Error (half a
  /// sentence) if that fails.
  std::optional<Error> apply();
  /// Whether the last change is not yet applied.
  bool is_open() const { return last_.has_value(); }

  /// All changes, combined into one change of the original asset.
  const change::Change& all() const { return all_; }
  change::Change& all() { return all_; }

 private:
  const model::OpenedAsset& before_;
  std::shared_ptr<const model::OpenedAsset> now_;
  std::optional<change::Change> last_;
  change::Change all_;
};

}  // namespace gltfx::steps
