// SPDX-License-Identifier: Apache-2.0
/// The group `shows`: valid assets that do not show what they are meant to. Its rules run after all
/// others, and only on an asset without errors, which explain more.
#pragma once

#include <string_view>

#include "rules/payload/phases.hpp"
#include "rules/shows/placed_scene.hpp"

namespace gltfx::validate {

/// What findings of NOTHING_VISIBLE begin with; the reason follows.
inline constexpr std::string_view kNothingIsVisible = "Nothing is visible: ";

/// Scenes in which nothing can be seen, and files that leave the choice of a scene to viewers.
/// Stops at the first triangle, line or point that can be seen.
void check_nothing_visible(DataPhase& phase);
/// Meshes so far from their origin that positions are rounded visibly. Reads bounds only.
void check_far_positions(DataPhase& phase);
/// A few vertices far away from all others. Reads all positions only where a sample is suspicious.
void check_stray_vertices(DataPhase& phase);
/// What the scene draws, and where: the four rules below. Reads bounds, few triangles of each
/// primitive, and all of those that are suspicious.
void check_geometry(DataPhase& phase);
/// Triangles wound against their normals, and closed surfaces that face inward.
void check_wrong_sides(DataPhase& phase, PlacedScene& scene);
/// Lengths in other units than meters, parts far away from all others, and the origin outside.
void check_placement(DataPhase& phase, const PlacedScene& scene);
/// The same triangles twice in one place, and flat surfaces in one plane.
void check_coincidence(DataPhase& phase, PlacedScene& scene);
/// Scenes of which all cameras see backs only. Stops at the first front.
void check_camera_backs(DataPhase& phase, const PlacedScene& scene);
/// Skins whose inverse bind matrices do not fit the rest pose, so that meshes are pulled apart.
/// Reads vertices only where joints are in the wrong places.
void check_rest_pose(DataPhase& phase);
/// Morph targets that move vertices by many times the size of their mesh. Reads bounds only.
void check_morph_reach(DataPhase& phase);
/// Keyframes between which a property jumps or vanishes.
void check_keyframes(DataPhase& phase);
/// Animations without a duration, and nearly closed loops. Only if the rules are enabled.
void check_clips(DataPhase& phase);
/// Primitives with materials for variants only. Reads no bytes.
void check_variants(DataPhase& phase);
/// Images and accessors that are stored again, and bytes outside of buffer views. Compares bytes
/// only where formats, sizes and samples agree.
void check_waste_bytes(DataPhase& phase);
/// Unused vertices, from counts alone unless hints are wanted. Equal materials and meshes, and
/// keyframes without effect, only if these rules are enabled.
void check_waste_objects(DataPhase& phase);
/// Names that engines bind by: those of morph targets, and of nodes that move.
void check_bound_names(DataPhase& phase);
/// Materials that hide their own textures, that are metals by default, or blend a whole character.
void check_material_values(DataPhase& phase);
/// Vertex colors that are black everywhere. Reads one color of a primitive where it is not black.
void check_vertex_colors(DataPhase& phase);
/// Bounding volumes that do not enclose the geometry of their nodes (glTF 2.1). Reads vertices only
/// where bounds of accessors are outside, or where animations move them.
void check_bounding_volumes(DataPhase& phase);
/// Lights that are off or blinding.
void check_light_intensity(DataPhase& phase);
/// Textures that make a surface black or violet, or turn its relief over. By decoded images.
void check_texture_contents(DataPhase& phase);
/// Texture coordinates that show one color of a texture, its edge, or a tiny part. Reads a few
/// triangles of a primitive, and all only where these are suspicious.
void check_texture_coordinates(DataPhase& phase);
/// Alpha modes that do not suit the texels that triangles show. By decoded images.
void check_shown_alpha(DataPhase& phase);

}  // namespace gltfx::validate
