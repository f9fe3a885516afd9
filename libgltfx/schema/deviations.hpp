// SPDX-License-Identifier: Apache-2.0
/// What the Khronos validator does differently from the specification in the walk over schemas.
/// rules/khronos/deviations.hpp has the rest.
#pragma once

namespace gltfx::schema {

/// All false: the specification is followed, with one finding for each cause. Members say what the
/// validator does, what the specification says, and the evidence.
struct Deviations {
  // --- What counts as present ---

  /// Khronos: a member whose value is invalid counts as absent, with the array around it, and so
  /// does a broken index. Rules that need the member are silent; rules that report its absence are
  /// not. Specification: silent. Seen: its source reads such members as null.
  bool broken_values_are_absent = false;

  /// Khronos: extensions have a meaning when it supports them and the asset declares them; the
  /// content of all others is skipped. Specification ("Specifying Extensions"): each extension
  /// defines its content. Seen: no findings on content after UNSUPPORTED_EXTENSION.
  bool unsupported_extensions_are_skipped = false;

  /// Khronos: null is of the wrong type, and a required member that is null is missing, too.
  /// Specification: null is of the wrong type. Seen: TYPE_MISMATCH with UNDEFINED_PROPERTY.
  bool null_counts_as_missing = false;

  /// Khronos: `"extras": null` counts as absent. Specification ("Properties Reference"): extras
  /// should be an object. Seen: no NON_OBJECT_EXTRAS for null.
  bool null_extras_are_allowed = false;

  /// Khronos: a value that is not an index in a map of indices (attributes) is INVALID_INDEX and
  /// stays in the map. Specification: a value of the wrong type. Seen: reports on attributes.
  bool invalid_indices_stay_in_maps = false;

  /// Khronos: a number beyond the range of a double is VALUE_NOT_IN_RANGE. Specification ("JSON
  /// Encoding"): leaves the range to JSON; elsewhere it is an error of the text. Seen: its source
  /// checks whether numbers are infinite.
  bool infinite_numbers_are_out_of_range = false;

  // --- What is reported ---

  /// Khronos: has none of the rules and limits that this program adds, also not under other codes.
  /// Specification: has most of them as requirements. Seen: its list of codes.
  bool no_additional_rules = false;

  /// Khronos: one finding for each element, pair or use invalid. Specification: silent; elsewhere
  /// the first of a kind has their number. Seen: reports with a finding for each vertex.
  bool each_finding_is_listed = false;

  /// Khronos: a member of a draft, or under a draft's name, is unexpected. Specification: has no
  /// such member; elsewhere the finding names the draft, or the present name of the member. Seen:
  /// UNEXPECTED_PROPERTY.
  bool draft_names_are_unexpected = false;

  /// Khronos: an index into an array of an extension that the root lacks is UNSATISFIED_DEPENDENCY
  /// of the object that has it. Specification: a broken reference. Seen: reports on
  /// KHR_lights_punctual and KHR_materials_variants.
  bool root_extension_is_a_dependency = false;

  /// Khronos: judges each name in extensionsUsed by itself, in order. Specification: silent;
  /// elsewhere it matters whether and where the extension is used. Seen: UNSUPPORTED_EXTENSION for
  /// all that it does not support.
  bool extension_names_are_judged_alone = false;

  /// Khronos: stops after an `asset` that is missing or whose version is not 2.x. Specification
  /// ("Asset"): such an asset is not glTF 2.0. Seen: reports that end there.
  bool other_versions_end_the_walk = false;

  /// Khronos: findings are in the order in which objects are read and then linked: those of a rule
  /// after its member, extensions of a primitive before the primitive, broken references in the
  /// order of linking. Specification: silent. Seen: its reports.
  bool reading_order = false;
};

/// All deviations.
inline constexpr Deviations kKhronosValidator{.broken_values_are_absent = true,
                                              .unsupported_extensions_are_skipped = true,
                                              .null_counts_as_missing = true,
                                              .null_extras_are_allowed = true,
                                              .invalid_indices_stay_in_maps = true,
                                              .infinite_numbers_are_out_of_range = true,
                                              .no_additional_rules = true,
                                              .each_finding_is_listed = true,
                                              .draft_names_are_unexpected = true,
                                              .root_extension_is_a_dependency = true,
                                              .extension_names_are_judged_alone = true,
                                              .other_versions_end_the_walk = true,
                                              .reading_order = true};

}  // namespace gltfx::schema
