// SPDX-License-Identifier: Apache-2.0
// The rules behind the text, in the order in which they run: two findings of one phase are reported
// in this order. validator.cpp has the phases.
#include "base/fork.hpp"
#include "rules/context.hpp"
#include "rules/payload/phases.hpp"

namespace gltfx::validate {

const Family &accessor_layout_family(), &accessor_values_family(), &animation_family(),
    &animation_paths_family(), &animation_pointer_family(), &asset_root_family(),
    &attribute_check_family(), &attribute_names_family(), &audio_family(), &avatar_family(),
    &bodies_family(), &buffer_view_family(), &buffers_family(), &camera_family(),
    &container_family(), &element_values_family(), &expressions_family(),
    &extension_accessors_family(), &extension_use_family(), &fallback_family(), &humanoid_family(),
    &humanoid_pose_family(), &image_source_family(), &images_family(), &influences_family(),
    &instancing_family(), &interactivity_family(), &lights_image_based_family(),
    &lights_punctual_family(), &lod_family(), &material_family(), &material_extensions_family(),
    &material_lobes_family(), &mdl_family(), &mesh_family(), &mesh_groups_family(),
    &mesh_primitive_family(), &missing_files_family(), &name_registries_family(),
    &node_constraint_family(), &node_graph_family(), &node_mesh_family(), &node_transform_family(),
    &nonvisual_family(), &packed_geometry_family(), &quantization_family(), &resource_family(),
    &scene_family(), &schema_fixes_family(), &single_root_family(), &skin_family(),
    &sparse_family(), &splats_family(), &spring_bone_family(), &structural_metadata_family(),
    &techniques_family(), &text_family(), &timed_accessors_family(), &toon_family(),
    &unused_objects_family(), &uri_form_family(), &value_fixes_family(), &view_use_family(),
    &xmp_family();

namespace {

// Phases 3 and 4: rules about objects run in this order for each object, those about how objects
// refer to each other once.
constexpr const Family& (*kFamilies[])() = {
    // Fixes alone: what they fix is found by the phases themselves.
    container_family,
    text_family,
    schema_fixes_family,
    value_fixes_family,
    uri_form_family,
    missing_files_family,
    buffers_family,
    images_family,
    view_use_family,
    attribute_check_family,
    element_values_family,
    sparse_family,
    influences_family,
    // Lists of extensions: what else is said depends on what is declared.
    extension_use_family,
    fallback_family,
    // Objects of glTF, each behind what it is made of, with the extensions on it.
    resource_family,
    asset_root_family,
    buffer_view_family,
    accessor_values_family,
    accessor_layout_family,
    image_source_family,
    material_family,
    material_extensions_family,
    material_lobes_family,
    attribute_names_family,
    mesh_family,
    mesh_primitive_family,
    camera_family,
    node_transform_family,
    lights_image_based_family,
    node_mesh_family,
    quantization_family,
    lights_punctual_family,
    // Skins and animations, then scenes, which show it all.
    skin_family,
    animation_family,
    animation_pointer_family,
    animation_paths_family,
    scene_family,
    node_graph_family,
    // Extensions.
    packed_geometry_family,
    mesh_groups_family,
    splats_family,
    instancing_family,
    lod_family,
    single_root_family,
    interactivity_family,
    name_registries_family,
    extension_accessors_family,
    audio_family,
    timed_accessors_family,
    humanoid_family,
    techniques_family,
    humanoid_pose_family,
    mdl_family,
    spring_bone_family,
    xmp_family,
    node_constraint_family,
    structural_metadata_family,
    expressions_family,
    avatar_family,
    toon_family,
    // What nothing uses: behind all that may use it.
    unused_objects_family,
    // Extensions of which nothing else depends.
    bodies_family,
    nonvisual_family,
};

// Phases 5 to 7, behind the bytes of buffers, images and compressed views.
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
    // What elements mean to an extension.
    {check_expression_weights},
    {check_metadata, true},
    // Headers of images, and pixels as far as they are asked for.
    {check_textures},
    {check_texture_slots, true},
    {check_image_based_lights},
    {check_thumbnails},
    // Other files, and the scene as a whole.
    {check_light_profiles},
    {check_scene_extent, true},
};

}  // namespace

std::span<const Family> families() {
  static constinit MadeOnce<std::vector<Family>> all;
  return all.get([] {
    std::vector<Family> made;
    for (const auto family : kFamilies) made.push_back(family());
    return made;
  });
}

std::span<const DataRule> data_rules() { return kDataRules; }

}  // namespace gltfx::validate
