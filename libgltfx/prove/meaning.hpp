// SPDX-License-Identifier: Apache-2.0
/// Whether two assets have the same meaning, independent of how they are stored.
///
/// Objects are compared by content: references are followed and never compared by number, so assets
/// that are renumbered, deduplicated or packed differently are equal. Properties of storage are not
/// compared: buffers, buffer views, the position and format of accessors and images, and extensions
/// that store geometry or images differently. The data of all references is decoded and compared.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/opened_asset.hpp"
#include "schema/set.hpp"

namespace gltfx::prove {

/// How vertices of a primitive are matched.
enum class VertexOrder : std::uint8_t {
  kept,  ///< corner by corner, in the order of the indices
  free,  ///< as sets of triangles, lines and points: both have the same elements, in any order
};

enum class AnimationComparison : std::uint8_t {
  keys,  ///< the same keyframes
  /// The same values at all keyframes of `before` and at four times between each two of them,
  /// except for rounding (2^-22 of the values at both), and the same first and last time.
  curves,
};

enum class ImageComparison : std::uint8_t {
  none,
  bytes,  ///< the same files
  /// Exactly the same texels, after channels and depth are expanded. Files with the same bytes are
  /// not decoded. If one of two images cannot be decoded, their bytes are compared.
  texels,
};

/// Distances up to which values count as equal; all 0: exact.
struct Tolerance {
  /// In the space of the mesh, or of the scene: MeaningRequest::in_world,
  /// MeaningRequest::regridded.
  double position = 0;
  double direction = 0;  ///< in degrees, for NORMAL and TANGENT; the w of TANGENT is exact
  double texcoord = 0;
  double color = 0;
  double weight = 0;     ///< for WEIGHTS_n
  double animation = 0;  ///< AnimationComparison::curves: for each component
  /// The same, as a part of the greatest absolute component of the curve; of rotations 1.
  double animation_part = 0;
};

struct MeaningRequest {
  /// There is no tolerance with `free`: change values and order in two steps, and prove each.
  VertexOrder order = VertexOrder::kept;
  AnimationComparison animations = AnimationComparison::keys;
  ImageComparison images = ImageComparison::texels;
  /// Unused objects may be missing in `after`: materials, meshes, textures and so on, and
  /// extensions in `extensionsUsed`. Scenes, animations and nodes must not be missing.
  bool unused_may_go = false;
  /// Images may have other names.
  bool image_names_may_go = false;
  /// `after` may lack members that only versions after 2.0 have, and be of another version. Extras
  /// of `asset` are not compared: they have what was such a member.
  bool older_version = false;
  /// POSITION is compared in the space of the scene at rest, at each node with the mesh, if only
  /// nodes without a skin refer to the mesh and no scale above them is 0 or changes. The transform
  /// of such a node may change if it affects only the mesh: the node has no children, camera or
  /// extensions, and only its parent or a scene refers to it. Other meshes are compared in their
  /// own space. Takes time for each node. Not with VertexOrder::free.
  bool in_world = false;
  /// Meshes may have other coordinates if their places undo that: transforms of nodes that affect
  /// only a mesh, unnamed new children that get the mesh, inverse bind matrices, instances, and
  /// lengths of materials. All positions are compared in the space of the scene
  /// (`prove/regridded.hpp`); Tolerance::position is a part of its diagonal. Not with
  /// VertexOrder::free or `in_world`.
  bool regridded = false;
  Tolerance tolerance = {};
  unsigned jobs = 1;       ///< threads for decoding
  std::size_t most = 100;  ///< greatest number of listed differences
};

/// One difference of the assets.
struct Difference {
  std::string pointer;  ///< JSON pointer in `before`; for a new value, the place that contains it
  std::string what;     ///< without a full stop: "POSITION of corner 17 is 0.25 away"
  double amount = 0;    ///< if measured, in the unit of its Tolerance; 0: not a numeric difference
};

/// The greatest distance of one quantity in the asset, also if it is within its tolerance.
struct Measured {
  std::string quantity;  ///< "POSITION", "TEXCOORD", "translation"
  double greatest = 0;   ///< in the unit of its Tolerance
  std::string pointer;   ///< place in `before`
};

struct Meaning {
  std::vector<Difference> differences;
  std::uint64_t more = 0;          ///< differences that are not listed
  std::vector<Measured> measured;  ///< quantities with a distance above 0
  /// Parts of `before` that cannot be read and were not compared: sentences with a pointer.
  std::vector<std::string> unread;

  bool same() const { return differences.empty(); }
};

/// Compares two assets. They may be broken in any way: what cannot be read in `before` is left out,
/// what can be read there and not in `after` is a difference. Reads all buffers (mapped), decodes
/// Draco and meshopt, and images where that is asked for; takes memory for the two texts and one
/// primitive or image at a time, and for decoded streams. Time grows with the size of the assets, n
/// log n; what several primitives or channels share is compared, and told, once. Without a text
/// there is nothing to compare: that is a difference if `before` has one.
Meaning compare_meaning(const model::OpenedAsset& before, const model::OpenedAsset& after,
                        const schema::Set& schemas, const MeaningRequest& request);

}  // namespace gltfx::prove
