// SPDX-License-Identifier: Apache-2.0
#include "validate/rules/families.hpp"

#include <array>

namespace gltfx::validate {

std::span<const Family> families() {
  // The order is that in which link rules run: the specification's, bottom up.
  // clang-format off
  static const std::array all{
      glb_family(),
      json_family(),
      schema_family(),
      extension_family(),
      extension_use_family(),
      fallback_family(),
      identity_family(),
      resource_family(),
      image_data_family(),
      accessor_data_family(),
      draco_data_family(),
      animation_data_family(),
      skinning_data_family(),
      packed_data_family(),
      mesh_edges_family(),
      texture_channels_family(),
      texture_sharing_family(),
      ktx2_family(),
      texture_pixels_family(),
      budget_family(),
      image_based_light_family(),
      light_profile_family(),
      asset_root_family(),
      buffer_view_family(),
      accessor_values_family(),
      accessor_layout_family(),
      image_source_family(),
      material_family(),
      material_extensions_family(),
      material_lobes_family(),
      variants_family(),
      attribute_names_family(),
      attribute_formats_family(),
      mesh_family(),
      mesh_primitive_family(),
      primitive_material_family(),
      camera_family(),
      node_transform_family(),
      node_mesh_family(),
      quantization_family(),
      lights_punctual_family(),
      use_family(),
      skin_family(),
      animation_family(),
      animation_pointer_family(),
      animation_paths_family(),
      scene_family(),
      node_graph_family(),
      packed_geometry_family(),
      mesh_groups_family(),
      splats_family(),
      instancing_family(),
      lod_family(),
      single_root_family(),
      interactivity_family(),
      name_registries_family(),
      extension_accessors_family(),
      audio_family(),
      timed_accessors_family(),
      techniques_family(),
      mdl_family(),
      xmp_family(),
      suppression_family(),
      unused_objects_family(),  // behind all that find references
  };
  // clang-format on
  return all;
}

}  // namespace gltfx::validate
