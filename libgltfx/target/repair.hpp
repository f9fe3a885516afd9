// SPDX-License-Identifier: Apache-2.0
/// Conversions for engines that refuse or ignore a feature.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace gltfx::target {

/// The member `repair` of a feature in schema/targets/features.json names one of them.
enum class Repair : std::uint8_t {
  decode_draco,           ///< plain accessors in place of Draco bitstreams
  decode_meshopt,         ///< plain buffer views in place of meshoptimizer streams
  float_attributes,       ///< no vertex attributes that only an extension allows
  float_texcoords,        ///< floats in place of normalized integers
  float_colors,           ///< the same
  float_weights,          ///< the same
  float_rotations,        ///< the same, of animations
  float_morph_weights,    ///< the same, of animations
  plain_accessors,        ///< stored elements in place of sparse ones and implied zeros
  separate_views,         ///< no interleaved attributes
  wide_indices,           ///< indices of 16 bits in place of 8
  write_indices,          ///< indices for primitives without any
  lists,                  ///< lists of triangles and lines in place of strips, fans and loops
  instance_nodes,         ///< nodes in place of instances
  inverse_bind_matrices,  ///< matrices for skins without any
  core_images,            ///< PNG or JPEG in place of formats of extensions
  rgb_images,             ///< PNG with 8 bits per channel, in RGB or RGBA
  media_types,            ///< `mimeType` for images
  one_file,               ///< no URIs of files
  no_data_uris,           ///< no data URIs
};
inline constexpr std::size_t kRepairCount = 20;

/// Their names, in order: "decode-draco".
extern const std::array<std::string_view, kRepairCount> kRepairNames;

/// The repair of a built-in feature, or nothing.
std::optional<Repair> repair_of(std::string_view feature);

/// Requested repairs, with the features that they are for.
class Repairs {
 public:
  /// `only_required`: it is enough that the extension is not required.
  void add(Repair repair, std::string_view feature, bool only_required);

  bool empty() const { return features_.empty(); }
  bool has(Repair repair) const { return features_.contains(repair); }
  bool has_any(std::initializer_list<Repair> repairs) const;
  /// By name; the value is whether it is enough that the extension is not required.
  std::map<std::string, bool, std::less<>> features(Repair repair) const;

 private:
  std::map<Repair, std::map<std::string, bool, std::less<>>> features_;
};

}  // namespace gltfx::target
