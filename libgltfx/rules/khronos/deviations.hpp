// SPDX-License-Identifier: Apache-2.0
/// Differences of the Khronos validator from the specification, by name. A rule tests the deviation
/// that it is about, never the profile.
///
/// All of it is known from reports of version 2.0.0-dev.3.11 on its own test assets and on
/// variations of them. Members state the evidence in these reports or in the source.
#pragma once

#include <gltfx/validate.hpp>

#include "schema/deviations.hpp"

namespace gltfx::validate {

/// All false: the specification is followed, with one finding for each cause.
struct Deviations : schema::Deviations {
  // --- Consequences of an error ---

  /// Khronos: reports consequences of an error that is reported already. Specification: silent;
  /// elsewhere there is one finding for each cause. Seen: pairs of codes for one mistake.
  bool consequences_are_reported = false;

  /// Khronos: an accessor of unknown type or component type is invalid for every use. Specification
  /// ("Accessor Data Types"): there is no such accessor. Seen: codes ..._INVALID_FORMAT with
  /// VALUE_NOT_IN_LIST.
  bool unknown_formats_are_checked = false;

  /// Khronos: an integer that is missing or broken is compared as -1. Specification: silent. Seen:
  /// its source, where -1 means unset.
  bool missing_integers_are_minus_one = false;

  /// Khronos: sets of an attribute with a gap in their numbers count as none. Specification
  /// ("Meshes"): forbids the gap. Seen: MESH_PRIMITIVE_TOO_FEW_TEXCOORDS and
  /// MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH with MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY.
  bool sets_with_gaps_are_empty = false;

  // --- The report ---

  /// Khronos: one severity for each code. Specification: silent; elsewhere cases of one code differ
  /// in severity. Seen: its list of codes.
  bool severity_follows_code = false;

  /// Khronos: errors of JSON syntax and a byte order mark are INVALID_JSON, and the first error of
  /// syntax ends the report; duplicate names are not reported. Specification ("JSON Encoding"):
  /// names should be unique. Seen: INVALID_JSON alone.
  bool syntax_errors_end_the_report = false;

  /// Khronos: neither reads nor counts data of a GLB that is truncated or ends in an empty chunk.
  /// Specification: silent. Seen: reports without `info`.
  bool data_of_short_files_is_skipped = false;

  /// Khronos: reports consequences of chunk types 0 and 1, of padding that is not counted, and of
  /// bytes that were changed as text. Specification ("Chunks"): silent; elsewhere the cause is
  /// reported. Seen: several codes for one mistake.
  bool mistakes_of_glbs_are_not_named = false;

  /// Khronos: the pointer to a channel without sampler is prepended to later pointers.
  /// Specification: silent. Seen: pointers such as /animations/0/channels/0/samplers/1.
  bool pointers_keep_stray_steps = false;

  /// Khronos: 2.0 is the only minor version. Specification ("Versioning"): readers load later ones.
  /// Seen: UNKNOWN_ASSET_MINOR_VERSION for the draft of 2.1.
  bool minor_versions_are_unknown = false;

  // --- Resources and images ---

  /// Khronos: files that may not be opened have no codes of their own: they are IO_ERROR or
  /// NON_RELATIVE_URI. Specification ("URIs"): leaves to readers what they open. Seen: its list
  /// of codes.
  bool refused_files_have_no_code = false;

  /// Khronos: repairs a URI if possible and opens the result: '\\' becomes '/', a '%' without
  /// digits "%25". Data URIs need neither padding nor the correct alphabet. Specification ("URIs"):
  /// RFC 3986. Seen: INVALID_URI for schemes, hosts and ports alone.
  bool uris_are_repaired = false;

  /// Khronos: data URIs of a GLB count as external files. Specification ("GLB-stored Buffer"):
  /// mentions external resources. Seen: URI_GLB with DATA_URI_GLB.
  bool data_uris_are_external = false;

  /// Khronos: the text of a Git-LFS pointer is the data. Specification: silent. Seen: its list of
  /// codes.
  bool lfs_pointers_are_data = false;

  /// Khronos: drops the data of a data URI of the wrong media type, and calls that of an image
  /// invalid. Specification ("Images"): readers go by the first bytes. Seen: INVALID_URI.
  bool mistyped_data_uris_are_dropped = false;

  /// Khronos: keeps the content of a data URI, regardless of the declared length of the buffer.
  /// Specification ("Buffers and Buffer Views"): the bytes must exist. Seen: findings on such data.
  bool short_data_uris_are_kept = false;

  /// Khronos: reads the headers of JPEG, PNG and WebP, as far as `info` needs them. Specification
  /// ("Images"): more formats come with extensions. Seen: IMAGE_UNRECOGNIZED_FORMAT for other
  /// formats, and nothing on headers that readers dispute.
  bool few_image_formats = false;

  /// Khronos: skips an image with an extension that is not supported. Specification: silent. Seen:
  /// images without media type in `info`.
  bool extended_images_are_skipped = false;

  /// Khronos: reports colour spaces, pixels that are not square and animated WebP, but neither
  /// colour profiles nor EXIF metadata. Specification ("Images"): all of these are ignored. Seen:
  /// IMAGE_FEATURES_UNSUPPORTED.
  bool few_image_features = false;

  // --- Accessors and data ---

  /// Khronos: any type of four components is accepted where the specification requires VEC4. Seen:
  /// findings on elements of MAT2.
  bool formats_count_by_components = false;

  /// Khronos: the output of an animation is two uses of its buffer view. Specification: silent.
  /// Seen: BUFFER_VIEW_TARGET_OVERRIDE twice.
  bool animation_outputs_count_twice = false;

  /// Khronos: the sum of weights excludes those whose joints are reported. Specification ("Skinned
  /// Mesh Attributes"): all weights have a sum of 1. Seen: sums in messages.
  bool weights_of_reported_joints_are_left_out = false;

  /// Khronos: primitives with joints are read in step, each up to the first value that cannot be
  /// read. Specification: silent. Seen: findings that alternate between primitives.
  bool primitives_are_read_in_step = false;

  // --- Nodes, skins and animations ---

  /// Khronos: restarts the search for the common root after each joint that has none with the
  /// previous joints. Specification ("Joint Hierarchy"): all joints have one. Seen: its source.
  bool common_root_starts_anew = false;

  /// Khronos: a node may have a skin if any primitive of its mesh has joints. Specification
  /// ("Node"): all primitives have them. Seen: no findings on meshes with one primitive without
  /// joints.
  bool one_skinned_primitive_is_enough = false;

  /// Khronos: a matrix must keep its norm after decomposition and composition. Specification
  /// ("Transformations"): matrices cannot shear. Seen: sheared matrices without findings.
  bool matrices_compare_by_norm = false;

  /// Khronos: an animation without channels or samplers is not linked. Specification: requires
  /// both. Seen: its targets are unused.
  bool incomplete_animations_are_unlinked = false;

  /// Khronos: targets of channels are equal if they are written alike. Specification
  /// ("Animations"): refers to nodes and properties. Seen: ANIMATION_DUPLICATE_TARGETS for broken
  /// targets.
  bool targets_compare_as_written = false;

  /// Khronos: pointers of KHR_animation_pointer are not followed. Specification: the extension
  /// defines valid targets. Seen: INCOMPLETE_EXTENSION_SUPPORT.
  bool animation_pointers_are_not_followed = false;

  // --- Materials and uses ---

  /// Khronos: compares the texture coordinates of textures in one tangent space regardless of
  /// KHR_texture_transform. Specification: the extension overrides them. Seen: findings on
  /// textures that are transformed.
  bool texture_transforms_are_disregarded = false;

  /// Khronos: tangents are unused when only the material of a variant or a direction of anisotropy
  /// needs them. Specification: silent. Seen: UNUSED_MESH_TANGENT.
  bool fewer_materials_need_tangents = false;

  /// Khronos: a skeleton does not use its root, an accessor whose size cannot be computed does not
  /// use its view, and a node does not use the weights of a mesh without primitives. Specification:
  /// silent. Seen: UNUSED_OBJECT and UNUSED_MESH_WEIGHTS.
  bool fewer_uses_count = false;
};

/// All deviations for the profile of the Khronos validator, none for any other. Static storage.
const Deviations& deviations_of(Profile profile);

}  // namespace gltfx::validate
