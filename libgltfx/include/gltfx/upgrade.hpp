// SPDX-License-Identifier: Apache-2.0
/// @file
/// What an upgrade can be asked for, and what it says of each legacy object. The calls are in
/// <gltfx/pipeline.hpp>.
#pragma once

#include <gltfx/edited_file.hpp>
#include <gltfx/targets.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

/// What an upgrade of one object comes to.
enum class UpgradeFate : std::uint8_t {
  safe,    ///< the same picture by the published texts, and nothing in the file speaks against it
  unsafe,  ///< something is lost: done when asked for
  needs_image,   ///< a channel of an image has to be moved, which cannot be read: left alone
  impossible,    ///< an error or another extension stands against it: the object is left alone
  on_request,    ///< done only when it is asked for by name, which it was not
  no_successor,  ///< there is nothing it could become
};
/// "safe", "unsafe", "needs an image", "not possible", "on request", "no successor".
std::string_view upgrade_fate_name(UpgradeFate fate);

/// One object of a legacy extension. Owns its text.
struct UpgradeAction {
  std::string pointer;     ///< of the object in the old document (RFC 6901)
  std::string from, to;    ///< names of the extensions
  std::string generation;  ///< as which generation it was read; empty when there is only one
  std::string decision;    ///< why as that one; empty when there is only one
  UpgradeFate fate = UpgradeFate::safe;  ///< what it comes to
  bool lossy = false;              ///< something is lost that goes with what was asked for by name
  bool removed = false;            ///< it has no effect, so it goes and nothing takes its place
  bool done = false;               ///< part of the new document
  std::vector<std::string> notes;  ///< what is lost, repaired or in the way; sentences without stop

  /// Whether it is part of what was asked for: it is done, or left to do.
  bool is_due() const {
    return fate != UpgradeFate::on_request && fate != UpgradeFate::no_successor;
  }
};

/// An object that nothing refers to any more because of an upgrade.
struct UpgradeOrphan {
  std::string pointer;      ///< in the old document
  std::uint64_t bytes = 0;  ///< of an image: those of its file or buffer view
  bool removed = false;     ///< not part of the new document
};

/// What an upgrade is asked for.
struct UpgradeOptions : EditOptions {
  /// "auto", or the name of a generation: every legacy object is read as that one.
  std::string generation = "auto";
  /// Names of legacy extensions, and of successors, to which the upgrade is limited. Both empty:
  /// all legacy extensions but those whose schema says that they are upgraded on request.
  std::vector<std::string> only, to;
  /// What takes the place of the index of refraction of specular-glossiness materials: 0 is exact,
  /// 1000 for readers that do not know 0.
  double ior = 0;
  bool unsafe = false;  ///< do what loses something, too
  /// A file in which something cannot be done without loss is an error and is not written.
  bool strict = false;
  /// Put colour and factor of diffuse transmission into one image, where that changes no texel that
  /// is used.
  bool pack = false;
  /// Take out textures, images and buffer views that nothing refers to any more because of this
  /// upgrade.
  bool prune = false;
  /// Draw the asset before and after; a file whose picture changes beyond noise is not written.
  bool verify = false;
  /// Engines that the asset is for: a plan notes which of them ignore a successor.
  std::vector<TargetChoice> targets;
  unsigned jobs = 1;  ///< threads for these pictures, which do not depend on it; 0: one a core
};

/// What was found in one file, and what became of it. Owns its text.
struct UpgradeReport : EditOutcome {
  std::vector<UpgradeAction> actions;  ///< in the order of the document; empty: nothing legacy
  std::vector<std::string> new_files;  ///< that the new document refers to, from its folder
  std::vector<UpgradeOrphan> orphans;  ///< by root array, in its order
  /// Warnings of `gltfx validate` that the new document has and the old one has not, one a code:
  /// "CODE at /pointer: message".
  std::vector<std::string> new_warnings;
  /// Extensions whose last object was one of them, so that the lists name them no more.
  std::vector<std::string> names_removed;
  bool verified = false;     ///< the picture before and after is the same
  std::string not_verified;  ///< why there is none to compare, without stop; else empty
  std::string orphans_kept;  ///< why they stay although they were to go, without stop

  /// Legacy objects that are part of what was asked for.
  std::uint64_t due() const;
  /// Those of them that stay as they are.
  std::uint64_t left() const;
};

}  // namespace gltfx
