// SPDX-License-Identifier: Apache-2.0
// The rules that run after the check of the text, in their order: findings of one phase are
// reported in this order. validator.cpp has the phases.
#include "base/fork.hpp"
#include "rules/context.hpp"
#include "rules/payload/phases.hpp"
#include "rules/shows/shows.hpp"

namespace gltfx::validate {

const RuleGroup &accessor_layout_rules(), &accessor_timed_rules(), &accessor_values_rules(),
    &agi_names_rules(), &animation_paths_rules(), &animation_pointer_rules(), &animation_rules(),
    &asset_root_rules(), &attribute_check_rules(), &attribute_names_rules(), &audio_rules(),
    &bound_names_rules(), &bounding_volume_rules(), &buffer_view_rules(), &buffers_rules(),
    &camera_rules(), &container_rules(), &default_scene_rules(), &element_values_rules(),
    &extension_accessors_rules(), &extension_use_rules(), &fallback_rules(),
    &gaussian_splatting_rules(), &image_source_rules(), &images_rules(), &influences_rules(),
    &instancing_rules(), &interactivity_rules(), &keyframe_fix_rules(), &lights_image_based_rules(),
    &lights_punctual_rules(), &lod_rules(), &material_extensions_rules(), &material_lobes_rules(),
    &material_rules(), &materials_mdl_rules(), &materials_mtoon_rules(), &mesh_groups_rules(),
    &mesh_primitive_rules(), &mesh_quantization_rules(), &mesh_rules(), &missing_files_rules(),
    &node_constraint_rules(), &node_graph_rules(), &node_mesh_rules(), &node_transform_rules(),
    &nonvisual_geometry_rules(), &packed_geometry_rules(), &physics_rules(), &resource_rules(),
    &scene_rules(), &schema_fix_rules(), &shape_mesh_rules(), &single_root_rules(), &skin_rules(),
    &sparse_rules(), &spring_bone_rules(), &structural_metadata_rules(), &techniques_webgl_rules(),
    &text_rules(), &unused_objects_rules(), &uri_form_rules(), &value_fix_rules(),
    &view_use_rules(), &vrm_avatar_rules(), &vrm_expressions_rules(), &vrm_humanoid_pose_rules(),
    &vrm_humanoid_rules(), &wrong_side_rules(), &xmp_rules();

namespace {

// Phases 3 and 4: rules about objects run in this order for each object, rules about references
// between objects once.
constexpr const RuleGroup& (*kRuleGroups[])() = {
    // Only fixes: the phases themselves find the problems.
    container_rules,
    text_rules,
    schema_fix_rules,
    value_fix_rules,
    uri_form_rules,
    missing_files_rules,
    buffers_rules,
    images_rules,
    view_use_rules,
    attribute_check_rules,
    element_values_rules,
    sparse_rules,
    influences_rules,
    bound_names_rules,
    bounding_volume_rules,
    default_scene_rules,
    keyframe_fix_rules,
    wrong_side_rules,
    // Lists of extensions: other findings depend on the declarations.
    extension_use_rules,
    fallback_rules,
    // Objects of glTF, each after its parts, with the extensions on it.
    resource_rules,
    asset_root_rules,
    buffer_view_rules,
    accessor_values_rules,
    accessor_layout_rules,
    image_source_rules,
    material_rules,
    material_extensions_rules,
    material_lobes_rules,
    attribute_names_rules,
    mesh_rules,
    mesh_primitive_rules,
    camera_rules,
    node_transform_rules,
    lights_image_based_rules,
    node_mesh_rules,
    mesh_quantization_rules,
    lights_punctual_rules,
    // Skins and animations, then scenes, which refer to all objects.
    skin_rules,
    animation_rules,
    animation_pointer_rules,
    animation_paths_rules,
    scene_rules,
    node_graph_rules,
    shape_mesh_rules,
    // Extensions.
    packed_geometry_rules,
    mesh_groups_rules,
    gaussian_splatting_rules,
    instancing_rules,
    lod_rules,
    single_root_rules,
    interactivity_rules,
    agi_names_rules,
    extension_accessors_rules,
    audio_rules,
    accessor_timed_rules,
    vrm_humanoid_rules,
    techniques_webgl_rules,
    vrm_humanoid_pose_rules,
    materials_mdl_rules,
    spring_bone_rules,
    xmp_rules,
    node_constraint_rules,
    structural_metadata_rules,
    vrm_expressions_rules,
    vrm_avatar_rules,
    materials_mtoon_rules,
    // Unused objects: after all rules about possible users.
    unused_objects_rules,
    // Extensions that no other rule depends on.
    physics_rules,
    nonvisual_geometry_rules,
};

// Phases 5 to 7, after the bytes of buffers, images and compressed views.
constexpr DataRule kDataRules[] = {
    // Elements of accessors.
    {decode_geometry},
    {check_sparse_indices},
    {check_elements},
    {check_influences},
    // Triangles and their edges.
    {check_edge_visibility, true},
    {check_outlines, true},
    {check_manifolds, true},
    {check_volumes, true},
    {check_shape_surfaces, true},
    // Meaning of elements for an extension.
    {check_expression_weights},
    {check_metadata, true},
    // Headers of images, and pixels as far as requested.
    {check_textures},
    {check_texture_slots, true},
    {check_image_based_lights},
    {check_thumbnails},
    // Other files, and the scene as a whole.
    {check_light_profiles},
    {check_scene_extent, true},
};

// What an asset without errors shows.
constexpr DataRule kShownRules[] = {
    {check_nothing_visible}, {check_variants},         {check_far_positions},
    {check_stray_vertices},  {check_geometry},         {check_rest_pose},
    {check_morph_reach},     {check_keyframes},        {check_clips},
    {check_bound_names},     {check_material_values},  {check_vertex_colors},
    {check_light_intensity}, {check_texture_contents}, {check_texture_coordinates},
    {check_shown_alpha},     {check_bounding_volumes}, {check_waste_bytes},
    {check_waste_objects},
};

}  // namespace

std::span<const RuleGroup> rule_groups() {
  static constinit MadeOnce<std::vector<RuleGroup>> all;
  return all.get([] {
    std::vector<RuleGroup> made;
    for (const auto group : kRuleGroups) made.push_back(group());
    return made;
  });
}

std::span<const DataRule> data_rules() { return kDataRules; }
std::span<const DataRule> shown_rules() { return kShownRules; }

}  // namespace gltfx::validate
