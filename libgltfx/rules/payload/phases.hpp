// SPDX-License-Identifier: Apache-2.0
/// Rules that look at the bytes of buffers and images, and what they share. rules/order.cpp has the
/// order in which they run.
#pragma once

#include <gltfx/report.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>

#include "model/accessor_data.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// How many numbers may be looked at, and how many errors listed one by one. Accessors may
/// share bytes, and sparse ones need none: without a limit a small file could ask for years of
/// work, or for a report of any size.
class Budget {
 public:
  explicit Budget(const model::ResourceData& resources);
  /// Takes `count` times `each`, or nothing when that much is not left.
  bool take(std::uint64_t count, std::uint64_t each);
  /// Takes `errors` to be listed, or nothing when they are too many and must be counted.
  bool list(std::uint64_t errors);

 private:
  std::uint64_t left_;
  std::uint64_t listed_left_;
};

/// What the rules share. They count the images that they decode in `report`.
struct DataPhase {
  const Context& context;
  const model::ResourceData& resources;
  Sink& sink;
  FileReport& report;
  Budget budget = Budget(resources);
  /// By accessor, the elements of those that have no buffer view because their data is part of
  /// compressed geometry.
  std::unordered_map<std::uint32_t, model::AccessorData> decoded = {};

  std::optional<model::AccessorData> open(std::uint32_t accessor) const {
    const auto found = decoded.find(accessor);
    if (found != decoded.end()) return found->second;
    return model::AccessorData::open(
        context.asset, context.views, resources, context.views.accessors[accessor],
        context.deviations.broken_values_are_absent ? model::Malformed::absent
                                                    : model::Malformed::unusable);
  }
};

struct DataRule {
  void (*check)(DataPhase& phase);
  /// Deviations::no_additional_rules leaves it out.
  bool additional = false;
};

/// All of them, in the order in which they run.
std::span<const DataRule> data_rules();

/// Geometry compressed by Draco: decodes it, compares it with the accessors it stands for, and
/// gives its elements to the rules behind it.
void decode_geometry(DataPhase& phase);
/// Indices of sparse accessors: increasing, within the accessor.
void check_sparse_indices(DataPhase& phase);
/// Every element of every accessor, by its format and its uses.
void check_elements(DataPhase& phase);
/// Structural metadata and feature ids: what JSON says of them, and the values in buffers and
/// images.
void check_metadata(DataPhase& phase);
/// VRMC_vrm_animation: what animations write as weights of expressions.
void check_expression_weights(DataPhase& phase);
/// Joints and weights of skinned meshes.
void check_influences(DataPhase& phase);
/// EXT_mesh_primitive_edge_visibility: how edges are coded, lines along them, normals beside them.
void check_edge_visibility(DataPhase& phase);
/// CESIUM_primitive_outline: outlines follow edges. CESIUM_tile_edges: the vertices are there.
void check_outlines(DataPhase& phase);
/// EXT_mesh_manifold: the surface is closed, and merged vertices lie where they were.
void check_manifolds(DataPhase& phase);
/// KHR_materials_volume: what encloses a volume has no hole. Only where somebody wants to know.
void check_volumes(DataPhase& phase);
/// Textures whose image has a format that is not theirs.
void check_textures(DataPhase& phase);
/// Whether images are what the slots that show them read (rules/payload/texture_phase.hpp).
void check_texture_slots(DataPhase& phase);
/// EXT_lights_image_based: faces of cubes are square, of a power of two, and halve from level to
/// level, beginning with the size that the light states.
void check_image_based_lights(DataPhase& phase);
/// VRMC_vrm: the thumbnail of an avatar is square.
void check_thumbnails(DataPhase& phase);
/// Opens what the profiles of an asset refer to and looks at the head of each: a version of LM-63
/// that readers must know, and a kind of photometry that there is. Reports what cannot be had as
/// for buffers and images.
void check_light_profiles(DataPhase& phase);
/// Positions are in metres: a scene that is far too small or too large for that is reported.
void check_scene_extent(DataPhase& phase);

}  // namespace gltfx::validate
