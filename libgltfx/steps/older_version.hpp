// SPDX-License-Identifier: Apache-2.0
/// What glTF 2.1 allows and glTF 2.0 does not, in the form of glTF 2.0.
#pragma once

#include "json/edit.hpp"
#include "steps/step_data.hpp"

namespace gltfx::steps {

/// An asset on its way to glTF 2.0. Objects that cannot go there are refused in the row.
struct OlderVersion {
  StepData& data;
  StepChanges& changes;
  ConvertStep& row;
  bool other_objects = false;  ///< more changes than members that go: it does not mean the same

  void refuse(json::NodeId object, std::string reason) {
    row.refused.push_back({data.pointer(object), std::move(reason)});
  }
};

/// States glTF 2.0 as the version of an asset that has no members of later versions.
void restate_version(const json::Document& document, json::Editor& editor);

/// Names of attributes that begin neither as one of the specification nor with an underscore get
/// one.
void name_own_attributes(OlderVersion& asset);
/// 32-bit integers of attributes become floats that are equal.
void store_integers_as_floats(OlderVersion& asset);
/// Primitives beside others with morph targets get targets without an effect.
void add_still_targets(OlderVersion& asset);
/// Matrices of nodes whose weights are animated become translation, rotation and scale.
void split_matrices(OlderVersion& asset);

}  // namespace gltfx::steps
