// SPDX-License-Identifier: Apache-2.0
#include "rules/khronos/deviations.hpp"

namespace gltfx::validate {
namespace {

constexpr Deviations kNoDeviations;

constexpr Deviations all_deviations() {
  Deviations khronos{schema::kKhronosValidator};
  khronos.consequences_are_reported = true;
  khronos.unknown_formats_are_checked = true;
  khronos.missing_integers_are_minus_one = true;
  khronos.sets_with_gaps_are_empty = true;
  khronos.severity_follows_code = true;
  khronos.syntax_errors_end_the_report = true;
  khronos.data_of_short_files_is_skipped = true;
  khronos.mistakes_of_glbs_are_not_named = true;
  khronos.pointers_keep_stray_steps = true;
  khronos.minor_versions_are_unknown = true;
  khronos.refused_files_have_no_code = true;
  khronos.uris_are_repaired = true;
  khronos.data_uris_are_external = true;
  khronos.lfs_pointers_are_data = true;
  khronos.mistyped_data_uris_are_dropped = true;
  khronos.short_data_uris_are_kept = true;
  khronos.few_image_formats = true;
  khronos.extended_images_are_skipped = true;
  khronos.few_image_features = true;
  khronos.formats_count_by_components = true;
  khronos.animation_outputs_count_twice = true;
  khronos.weights_of_reported_joints_are_left_out = true;
  khronos.primitives_are_read_in_step = true;
  khronos.common_root_starts_anew = true;
  khronos.one_skinned_primitive_is_enough = true;
  khronos.matrices_compare_by_norm = true;
  khronos.incomplete_animations_are_unlinked = true;
  khronos.targets_compare_as_written = true;
  khronos.animation_pointers_are_not_followed = true;
  khronos.texture_transforms_are_disregarded = true;
  khronos.fewer_materials_need_tangents = true;
  khronos.fewer_uses_count = true;
  return khronos;
}
constexpr Deviations kAllDeviations = all_deviations();

}  // namespace

const Deviations& deviations_of(Profile profile) {
  return profile == Profile::khronos ? kAllDeviations : kNoDeviations;
}

}  // namespace gltfx::validate
