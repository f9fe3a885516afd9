// SPDX-License-Identifier: Apache-2.0
// tools/npm/pack fills in the version, and writes constants.cjs with the same values.
export const packageVersion = "0.0.0";
export const khronosExtensions = [
  "EXT_texture_webp",
  "KHR_animation_pointer",
  "KHR_lights_punctual",
  "KHR_materials_anisotropy",
  "KHR_materials_clearcoat",
  "KHR_materials_dispersion",
  "KHR_materials_emissive_strength",
  "KHR_materials_ior",
  "KHR_materials_iridescence",
  "KHR_materials_pbrSpecularGlossiness",
  "KHR_materials_sheen",
  "KHR_materials_specular",
  "KHR_materials_transmission",
  "KHR_materials_unlit",
  "KHR_materials_variants",
  "KHR_materials_volume",
  "KHR_mesh_quantization",
  "KHR_node_visibility",
  "KHR_texture_transform",
];
