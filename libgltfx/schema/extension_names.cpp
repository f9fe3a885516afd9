// SPDX-License-Identifier: Apache-2.0
#include "schema/extension_names.hpp"

#include <algorithm>
#include <vector>

#include "base/text.hpp"

namespace gltfx::schema {
namespace {

// From the Khronos registry, its open proposals and the lists of vendors.
constexpr std::string_view kWithoutSchema[]{
    "BENTLEY_materials_line_style",
    "EXT_mesh_bmesh",
    "EXT_primitive_voxels",
    "EXT_implicit_ellipsoid_region",
    "EXT_texture_procedurals_mx_1_39",
    "EXT_texture_video",
    "FB_ngon_encoding",
    "GOOGLE_backgrounds",
    "GOOGLE_camera_settings",
    "GOOGLE_tilt_brush_material",
    "KHR_accessor_float16",
    "KHR_audio_graph",
    "KHR_binary_glTF",
    "KHR_environment_map",
    "KHR_gaussian_splatting_compression_spz",
    "KHR_gaussian_splatting_compression_spz_2",
    "KHR_lights_environment",
    "KHR_materials_common",
    "KHR_quantized_geometry",
    "MOZ_hubs_components",
    "MOZ_lightmap",
    "MSFT_audio_emitter",
    "NEEDLE_components",
    "NEEDLE_lightmaps",
    "NEEDLE_persistent_assets",
    "NEEDLE_progressive",
    "OMI_audio_emitter",
    "OMI_link",
    "OMI_personality",
    "WEB3D_quantized_attributes",
};

}  // namespace

bool is_known_without_schema(std::string_view name) {
  return std::find(std::begin(kWithoutSchema), std::end(kWithoutSchema), name) !=
         std::end(kWithoutSchema);
}

bool may_add_values(const Set& set, std::string_view name) {
  if (set.find_extension(name) != kNone) return false;
  if (!is_known_without_schema(name)) return misspelt_extension(set, name).empty();
  // A type of components, and media types of images.
  return name == "KHR_accessor_float16" || name == "EXT_texture_video";
}

std::string_view misspelt_extension(const Set& set, std::string_view name) {
  if (set.find_extension(name) != kNone || is_known_without_schema(name)) return {};
  std::vector<std::string_view> known(std::begin(kWithoutSchema), std::end(kWithoutSchema));
  for (const Extension& extension : set.extensions()) known.push_back(extension.name);
  return nearest(name, known);
}

}  // namespace gltfx::schema
