// SPDX-License-Identifier: Apache-2.0
/// Rules about the edges of triangles: what extensions of meshes and materials ask of them.
#pragma once

#include "validate/data/phases.hpp"

namespace gltfx::validate {

/// EXT_mesh_primitive_edge_visibility: how edges are coded, lines along them, normals beside them.
void check_edge_visibility(DataPhase& phase);
/// CESIUM_primitive_outline: outlines follow edges.
void check_outlines(DataPhase& phase);
/// EXT_mesh_manifold: the surface is closed, and merged vertices lie where they were.
void check_manifolds(DataPhase& phase);
/// KHR_materials_volume: what encloses a volume has no hole. Only where somebody wants to know.
void check_volumes(DataPhase& phase);

/// All of them.
inline void check_mesh_edges(DataPhase& phase) {
  if (phase.context.deviations.no_additional_rules) return;
  check_edge_visibility(phase);
  check_outlines(phase);
  check_manifolds(phase);
  check_volumes(phase);
}

}  // namespace gltfx::validate
