// SPDX-License-Identifier: Apache-2.0
/// The parts of the data phase, in the order in which they report.
#pragma once

#include <gltfx/report.hpp>

#include <cstdint>
#include <optional>
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

/// What the parts share.
struct DataPhase {
  const Context& context;
  const model::ResourceData& resources;
  Sink& sink;
  Budget budget;
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

/// Geometry compressed by Draco: decodes it, compares it with the accessors it stands for, and
/// gives its elements to the parts below.
void decode_geometry(DataPhase& phase);
/// Indices of sparse accessors: increasing, within the accessor.
void check_sparse_indices(DataPhase& phase);
/// Every element of every accessor, by its format and its uses.
void check_elements(DataPhase& phase);
/// Structural metadata and feature ids: what JSON says of them, and the values in buffers and
/// images. Files and images that are read for it are counted in `report`.
void check_metadata(DataPhase& phase, FileReport& report);
/// VRMC_vrm_animation: what animations write as weights of expressions.
void check_expression_weights(DataPhase& phase);
/// Joints and weights of skinned meshes.
void check_influences(DataPhase& phase);

}  // namespace gltfx::validate
