// SPDX-License-Identifier: Apache-2.0
/// A step of a conversion: a pure function of an asset. To add one, write a file with a function
/// that gives its StepDescription, and name it in `steps/steps.cpp`.
#pragma once

#include <gltfx/convert.hpp>

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "change/change.hpp"
#include "model/opened_asset.hpp"
#include "schema/set.hpp"

namespace gltfx::steps {

/// What a step works on. Refers to all but the file name.
struct StepInput {
  const model::OpenedAsset& asset;  ///< as the steps before left it
  const schema::Set& schemas;
  const ConvertOptions& options;  ///< `to` says how the asset is to be stored; nothing: as it is
  std::string file_name;          ///< of the new asset
};

/// What differs after a step in what the asset means; the rest is proven to be equal.
struct Freedom {
  bool vertex_order = false;  ///< of vertices and triangles
  bool keyframes = false;     ///< the curves stay
  bool unused = false;        ///< objects without a use may be gone
  bool texels = false;        ///< of images
};

/// The result of a step. The change need not be placed. The caller sets the name, `changes` and the
/// sizes in `row`.
struct StepOutcome {
  change::Change change = {};
  ConvertStep row = {};
  Freedom freedom = {};
};

/// What a step is, for who runs it and for who reads about it. Texts have static storage.
struct StepDescription {
  std::string_view name;
  std::string_view summary;  ///< what it does
  std::string_view keeps;    ///< what is as it was
  std::string_view loses;    ///< what is not, and its bound
  bool (*asked)(const ConvertOptions& options);
  /// An Error: the step is refused as a whole; half a sentence. What is not dealt with alone stands
  /// in the row.
  Result<StepOutcome> (*run)(const StepInput& input);
};

/// In the order in which they run. The bytes of all but the last are laid out (`steps/layout.hpp`)
/// before the last one, which says where they are stored.
std::vector<StepDescription> steps();

}  // namespace gltfx::steps
