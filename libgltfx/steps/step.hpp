// SPDX-License-Identifier: Apache-2.0
/// A step of a conversion: a pure function of an asset. To add one, write a file with a function
/// that returns its StepDescription, and add the function to `steps/steps.cpp`.
#pragma once

#include <gltfx/convert.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "change/change.hpp"
#include "model/opened_asset.hpp"
#include "schema/set.hpp"
#include "target/repair.hpp"

namespace gltfx::steps {

class ImageEncodings;

/// Input of a step. Keeps references to everything but the file name.
struct StepInput {
  const model::OpenedAsset& asset;  ///< after the previous steps
  const schema::Set& schemas;
  const ConvertOptions& options;  ///< `to`: the storage of the result; nothing: unchanged
  std::string file_name;          ///< of the new asset
  /// Gets the buffers and images that the step cannot read, half sentences. They count as refused:
  /// nothing that was asked for is skipped because a file is missing or the system has an error.
  std::vector<ConvertNote>& unread;
  ImageEncodings& encodings;     ///< of the run
  target::Repairs repairs = {};  ///< what targets need
};

/// Differences in meaning that a step may make; everything else is proven to be equal.
struct Freedom {
  bool vertex_order = false;  ///< of vertices and triangles
  bool keyframes = false;     ///< the curves stay
  bool unused = false;        ///< objects without a use may be gone
  bool texels = false;        ///< of images
  bool image_names = false;   ///< images may have those of others
  /// Elements of streams may be plain: doubtful values, which may come from the encoder, are errors
  /// then.
  bool plain_elements = false;
  /// Any, because the step itself measures them: what it makes is what later steps must keep.
  bool own_proof = false;
  /// Numbers of vertices, what places them, and keyframes, within these bounds. No order may change
  /// with it.
  std::optional<LossBounds> loss = std::nullopt;
  bool unit_vectors = false;  ///< normals and tangents may get length 1
  bool new_objects = false;   ///< nodes or matrices in place of what means the same
  bool version = false;       ///< members that glTF 2.0 does not have may be gone

  /// Whether what follows is compared with the result of the step, and not with the old asset.
  bool moves_base() const { return own_proof || unit_vectors || new_objects; }

  Freedom& operator|=(const Freedom& other) {
    vertex_order |= other.vertex_order;
    keyframes |= other.keyframes;
    unused |= other.unused;
    texels |= other.texels;
    image_names |= other.image_names;
    plain_elements |= other.plain_elements;
    own_proof |= other.own_proof;
    if (other.loss) loss = other.loss;
    unit_vectors |= other.unit_vectors;
    new_objects |= other.new_objects;
    version |= other.version;
    return *this;
  }
};

/// Result of a step. The change need not be placed. The caller sets the name, `changes` and the
/// sizes in `row`.
struct StepOutcome {
  change::Change change = {};
  ConvertStep row = {};
  Freedom freedom = {};
  /// Why something was refused because of the system or the installation, not because of the asset,
  /// half a sentence; empty: nothing was.
  std::string trouble = {};
};

/// A step, described for the code that runs it and for readers. Texts have static storage.
struct StepDescription {
  std::string_view name;
  std::string_view summary;  ///< its effect
  std::string_view keeps;    ///< parts of the asset that do not change
  std::string_view loses;    ///< losses and their bounds
  bool (*asked)(const ConvertOptions& options);
  /// An Error, half a sentence, if the whole step is refused. Single objects that it skips are
  /// listed in the row.
  Result<StepOutcome> (*run)(const StepInput& input);
  /// Repairs that the step makes. It also runs if one of them is requested.
  std::vector<target::Repair> repairs = {};
  /// Whether it loses something within ConvertOptions::quantize: then the caller measures what it
  /// loses. Null: it does not.
  bool (*is_bounded)(const ConvertOptions& options) = nullptr;
};

/// Steps in the order in which they run. The last one decides where bytes are stored; those of all
/// other steps are laid out (`steps/layout.hpp`) before it runs.
std::vector<StepDescription> steps();

}  // namespace gltfx::steps
