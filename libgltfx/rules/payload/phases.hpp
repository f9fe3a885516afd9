// SPDX-License-Identifier: Apache-2.0
/// Rules that read the bytes of buffers and images, and their shared state. rules/order.cpp has the
/// order in which they run.
#pragma once

#include <gltfx/report.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "model/accessor_data.hpp"
#include "model/pose.hpp"
#include "rules/context.hpp"
#include "rules/payload/bounds_box.hpp"

namespace gltfx::measure {
class Source;
}

namespace gltfx::validate {

/// Limits of the numbers that are read, and of the errors that are listed one by one. Accessors may
/// share bytes, and sparse ones need none: without a limit a small file could cause years of work,
/// or a report of any size.
class Budget {
 public:
  explicit Budget(const model::ResourceData& resources);
  /// Takes `count` times `each`, or nothing if less is left.
  bool take(std::uint64_t count, std::uint64_t each);
  /// Takes `errors` to be listed, or nothing if they are too many and must be counted.
  bool list(std::uint64_t errors);

 private:
  std::uint64_t left_;
  std::uint64_t listed_left_;
};

struct StudiedTextures;

/// State shared by the rules. They count the images that they decode in `report`.
struct DataPhase {
  const Context& context;
  const model::ResourceData& resources;
  const measure::Source& measured;  ///< what measures share of the asset
  Sink& sink;
  FileReport& report;
  Budget budget = Budget(resources);
  /// By accessor, the elements of those without a buffer view whose data is part of compressed
  /// geometry.
  std::unordered_map<std::uint32_t, model::AccessorData> decoded = {};
  /// The texture slots, once check_texture_slots() has run; null if there are none.
  std::shared_ptr<StudiedTextures> textures = {};
  std::unique_ptr<const model::Pose> made_pose = nullptr;
  std::vector<std::optional<BoundsBox>> made_boxes = {};  ///< by accessor

  /// The nodes of the default scene, at rest; made on the first call.
  const model::Pose& pose();
  /// The bounds that an accessor states, read once. Empty: it has none of three numbers.
  const BoundsBox& box_of(std::uint32_t accessor);
  /// The bounds of the positions of a mesh or a primitive, likewise.
  BoundsBox box_of_mesh(std::uint32_t mesh);
  BoundsBox box_of_primitive(const model::Primitive& primitive);

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
  /// Deviations::no_additional_rules disables it.
  bool additional = false;
};

/// All of them, in the order in which they run.
std::span<const DataRule> data_rules();
/// Those that run after all others, on an asset without errors: the group `shows`
/// (rules/shows/shows.hpp).
std::span<const DataRule> shown_rules();

/// Geometry compressed by Draco: decodes it, compares it with its accessors, and passes its
/// elements to later rules.
void decode_geometry(DataPhase& phase);
/// Indices of sparse accessors: increasing, within the accessor.
void check_sparse_indices(DataPhase& phase);
/// Every element of every accessor, by its format and its uses.
void check_elements(DataPhase& phase);
/// Structural metadata and feature IDs: their JSON, and the values in buffers and images.
void check_metadata(DataPhase& phase);
/// VRMC_vrm_animation: weights of expressions written by animations.
void check_expression_weights(DataPhase& phase);
/// Joints and weights of skinned meshes.
void check_influences(DataPhase& phase);
/// EXT_mesh_primitive_edge_visibility: the coding of edges, lines along them, normals of their
/// faces.
void check_edge_visibility(DataPhase& phase);
/// CESIUM_primitive_outline: outlines follow edges. CESIUM_tile_edges: the vertices exist.
void check_outlines(DataPhase& phase);
/// EXT_mesh_manifold: the surface is closed, and merged vertices have the same position.
void check_manifolds(DataPhase& phase);
/// KHR_materials_volume: the surface around a volume has no hole. Only if the rule is enabled.
void check_volumes(DataPhase& phase);
/// Textures with an image in a format that is not allowed for them.
void check_textures(DataPhase& phase);
/// Whether images are suitable for the slots that use them (rules/payload/texture_phase.hpp).
void check_texture_slots(DataPhase& phase);
/// EXT_lights_image_based: faces of cubes are square, with a power of two as size, and halve from
/// level to level, beginning with the size declared by the light.
void check_image_based_lights(DataPhase& phase);
/// Shapes of meshes (glTF 2.1): convex ones are convex; their surfaces are closed.
void check_shape_surfaces(DataPhase& phase);
/// VRMC_vrm: the thumbnail of an avatar is square.
void check_thumbnails(DataPhase& phase);
/// Opens the profiles of an asset and reads the head of each: a version of LM-63 that readers must
/// support, and an existing kind of photometry. Reports missing profiles like buffers and images.
void check_light_profiles(DataPhase& phase);
/// Positions are in metres: a scene that is far too small or too large for that is reported.
void check_scene_extent(DataPhase& phase);

}  // namespace gltfx::validate
