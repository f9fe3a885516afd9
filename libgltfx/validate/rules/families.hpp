// SPDX-License-Identifier: Apache-2.0
/// One function a file of this folder.
#pragma once

#include "validate/context.hpp"

namespace gltfx::validate {

// What phases 1 to 3 find by themselves: only the tables.
const Family& glb_family();
const Family& json_family();
const Family& schema_family();
const Family& extension_family();
const Family& extension_use_family();
const Family& fallback_family();
const Family& identity_family();
const Family& resource_family();
const Family& image_data_family();
const Family& accessor_data_family();
const Family& draco_data_family();
const Family& animation_data_family();
const Family& skinning_data_family();
const Family& packed_data_family();
const Family& mesh_edges_family();
const Family& texture_channels_family();
const Family& texture_sharing_family();
const Family& ktx2_family();
const Family& texture_pixels_family();
const Family& budget_family();
const Family& image_based_light_family();
const Family& light_profile_family();

// Objects and how they refer to each other.
const Family& asset_root_family();
const Family& buffer_view_family();
const Family& accessor_values_family();
const Family& accessor_layout_family();
const Family& image_source_family();
const Family& material_family();
const Family& material_extensions_family();
const Family& material_lobes_family();
const Family& lights_punctual_family();
const Family& variants_family();
const Family& attribute_names_family();
const Family& attribute_formats_family();
const Family& mesh_family();
const Family& mesh_primitive_family();
const Family& primitive_material_family();
const Family& use_family();
const Family& unused_objects_family();

// Cameras, the scene graph, skins, animations.
const Family& camera_family();
const Family& node_transform_family();
const Family& node_mesh_family();
const Family& quantization_family();
const Family& skin_family();
const Family& animation_family();
const Family& animation_pointer_family();
const Family& animation_paths_family();
const Family& scene_family();
const Family& node_graph_family();

// What one extension or another asks of the whole graph.
const Family& packed_geometry_family();
const Family& mesh_groups_family();
const Family& splats_family();
const Family& instancing_family();
const Family& lod_family();
const Family& single_root_family();
const Family& interactivity_family();
const Family& name_registries_family();
const Family& extension_accessors_family();
const Family& audio_family();
const Family& timed_accessors_family();
const Family& techniques_family();
const Family& mdl_family();
const Family& xmp_family();
const Family& suppression_family();

}  // namespace gltfx::validate
