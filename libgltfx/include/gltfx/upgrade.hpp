// SPDX-License-Identifier: Apache-2.0
/// @file
/// Options and report of an upgrade. The calls are in <gltfx/pipeline.hpp>.
#pragma once

#include <gltfx/edited_file.hpp>
#include <gltfx/targets.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

/// Outcome of the upgrade of one object.
enum class UpgradeOutcome : std::uint8_t {
  safe,          ///< the same picture by the specifications, and no conflict in the file
  unsafe,        ///< something is lost: done on request only
  needs_image,   ///< a channel of an image must move, but the image cannot be read: left alone
  impossible,    ///< an error or another extension prevents it: the object is left alone
  on_request,    ///< done only when requested by name, which it was not
  no_successor,  ///< no extension replaces it
};
/// "safe", "unsafe", "needs an image", "not possible", "on request", "no successor".
std::string_view upgrade_outcome_name(UpgradeOutcome outcome);

/// One object of a legacy extension, or one value that a version of glTF has in another form. Owns
/// its text.
struct UpgradeAction {
  std::string pointer;     ///< of the object in the old document (RFC 6901)
  std::string from, to;    ///< names of the extensions
  std::string generation;  ///< the generation that it was read as; empty when there is only one
  std::string decision;    ///< why that generation; empty when there is only one
  UpgradeOutcome outcome = UpgradeOutcome::safe;  ///< outcome
  bool lossy = false;              ///< something is lost as a part of what was requested by name
  bool removed = false;            ///< it has no effect: it is deleted without a successor
  bool done = false;               ///< part of the new document
  std::vector<std::string> notes;  ///< losses, repairs and conflicts; sentences without full stop

  /// Whether it was requested: it is done, or left to do.
  bool is_due() const {
    return outcome != UpgradeOutcome::on_request && outcome != UpgradeOutcome::no_successor;
  }
};

/// An object without references after an upgrade.
struct UpgradeOrphan {
  std::string pointer;      ///< in the old document
  std::uint64_t bytes = 0;  ///< of an image: those of its file or buffer view
  bool removed = false;     ///< not part of the new document
};

/// Options of an upgrade.
struct UpgradeOptions : EditOptions {
  /// "auto", or the name of a generation: every legacy object is read as that generation.
  std::string generation = "auto";
  /// Names of legacy extensions, and of successors, to which the upgrade is limited. Both empty:
  /// all legacy extensions except those that are upgraded on request by their schema.
  std::vector<std::string> only, to;
  /// "2.1": the version of the asset becomes that, and legacy extensions stay. Empty: they are
  /// upgraded.
  std::string gltf;
  /// Index of refraction of upgraded specular-glossiness materials: 0 is exact, 1000 is for readers
  /// that do not support 0.
  double ior = 0;
  bool unsafe = false;  ///< do lossy upgrades, too
  /// A file with an upgrade that is lossy or impossible is an error and is not written.
  bool strict = false;
  /// Put colour and factor of diffuse transmission into one image, if that changes no texel that is
  /// used.
  bool pack = false;
  /// Remove textures, images and buffer views that are without references after this upgrade.
  bool prune = false;
  /// Draw the asset before and after; a file whose picture changes beyond noise, or one of whose
  /// vertices changes at all, is not written.
  bool verify = false;
  /// Engines that the asset is for: a plan notes which of them ignore a successor.
  std::vector<TargetChoice> targets;
  unsigned jobs = 1;  ///< threads for these pictures, which do not depend on it; 0: one a core
};

/// Legacy objects in one file and their outcome. Owns its text.
struct UpgradeReport : EditOutcome {
  std::vector<UpgradeAction> actions;  ///< in the order of the document; empty: nothing legacy
  std::vector<std::string>
      new_files;  ///< paths from the asset's folder, as the new document refers to them
  std::vector<UpgradeOrphan> orphans;  ///< by root array, in its order
  /// Warnings of `gltfx validate` on the new document that the old one does not have, one per code:
  /// "CODE at /pointer: message".
  std::vector<std::string> new_warnings;
  /// Extensions whose last object was removed, so that the lists no longer name them.
  std::vector<std::string> names_removed;
  bool verified = false;     ///< the picture before and after is the same, and all vertices
  std::string not_verified;  ///< what could not be compared, without full stop; else empty
  std::string orphans_kept;  ///< why they stay although `prune` is set, without full stop

  /// Number of requested upgrades of legacy objects.
  std::uint64_t due() const;
  /// Number of those that are not done.
  std::uint64_t left() const;
};

}  // namespace gltfx
