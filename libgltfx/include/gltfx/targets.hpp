// SPDX-License-Identifier: Apache-2.0
/// @file
/// Support for features of glTF in engines: measured data from `schema/targets`, which the library
/// embeds. docs/targets.md says how it is measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

/// What a version does with an asset that has a feature. `refused`: it loads nothing. `ignored`: it
/// loads the asset as if the feature were not there. `read`: it builds the objects that the feature
/// requires. `drawn`: it draws the picture that the feature requires.
enum class TargetOutcome : std::uint8_t { refused, ignored, read, drawn };

/// "refused", "ignored", "read", "drawn".
std::string_view target_outcome_name(TargetOutcome outcome);

/// One measured version.
struct TargetVersion {
  std::string version;   ///< "0.187.0"
  std::string released;  ///< "2026-03-01"; may be empty
};

/// The outcome of each measured version from one to another.
struct TargetRange {
  std::size_t first = 0, last = 0;              ///< positions in Target::versions, both inclusive
  TargetOutcome outcome = TargetOutcome::read;  ///< of all of them
};

/// Outcomes of one feature, by how an asset has it. Versions outside the ranges were not measured.
struct TargetFeature {
  std::vector<TargetRange> used;      ///< the feature is there; an extension is not required
  std::vector<TargetRange> required;  ///< an extension is required, with nothing to fall back to
  std::vector<TargetRange> required_with_fallback;  ///< required, with something to fall back to
};

/// One engine. Owns its text.
struct Target {
  std::string name;                     ///< as users name it: "three"
  std::string title;                    ///< as messages name it: "three.js"
  std::string source;                   ///< "npm:three"
  std::string set_up;                   ///< how a program must set it up; may be empty
  std::string method;                   ///< how it was measured; may be empty
  std::vector<std::string> decoders;    ///< extensions whose decoders the program registers
  std::vector<TargetVersion> versions;  ///< oldest first, at least one
  std::map<std::string, TargetFeature, std::less<>> features;  ///< by the name of the feature
};

/// What is lost if a feature is ignored: part of the picture or animation, data only, or nothing.
enum class FeatureEffect : std::uint8_t { picture, data, none };

/// A feature of assets, such as an extension or a form of accessors. Owns its text.
struct Feature {
  std::string title;  ///< noun phrase: "instanced meshes"
  std::string lost;   ///< clause: "all instances but one are missing"
  std::string help;   ///< imperative: what an author can do; may be empty
  FeatureEffect effect = FeatureEffect::picture;  ///< the kind of loss
};

/// A measured version of a target.
struct TargetChoice {
  std::shared_ptr<const Target> target;  ///< never null
  std::size_t version = 0;               ///< position in target->versions

  /// "three.js 0.187.0".
  std::string label() const;
};

/// The range that contains a version, or null if it was not measured.
const TargetRange* outcome_of(const std::vector<TargetRange>& ranges, std::size_t version);

/// The built-in targets, sorted by name. Read once; static storage.
const std::vector<std::shared_ptr<const Target>>& builtin_targets();

/// The features that targets are measured by, by name. Read once; static storage.
const std::map<std::string, Feature, std::less<>>& target_features();

}  // namespace gltfx
