// SPDX-License-Identifier: Apache-2.0
/// A step that changes an asset several times, each time what the change before made.
#pragma once

#include <optional>

#include "base/result.hpp"
#include "change/change.hpp"
#include "model/opened_asset.hpp"

namespace gltfx::steps {

/// Changes of text, and new files. Refers to the asset.
class Stages {
 public:
  explicit Stages(const model::OpenedAsset& before) : before_(before) {}

  /// As the changes so far made it.
  const model::OpenedAsset& asset() const { return now_ ? *now_ : before_; }
  /// Places and makes a change of asset(). An Error: half a sentence.
  std::optional<Error> add(change::Change change);
  /// All changes as one of the asset before.
  change::Change take() { return std::move(all_); }

 private:
  const model::OpenedAsset& before_;
  std::optional<model::OpenedAsset> now_;
  change::Change all_;
};

}  // namespace gltfx::steps
