// SPDX-License-Identifier: Apache-2.0
/// Whether two assets mean the same, however they are stored.
///
/// Objects are compared by what they lead to: references are followed and never compared by number,
/// so assets that are renumbered, deduplicated or packed differently are equal. What says only how
/// something is stored is not compared: buffers, buffer views, where accessors and images lie and
/// in which format, extensions that store geometry or images in another way. The bytes of all that
/// is referred to are decoded and compared.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/opened_asset.hpp"
#include "schema/set.hpp"

namespace gltfx::prove {

/// Which vertices of a primitive are compared with each other.
enum class VertexOrder : std::uint8_t {
  kept,  ///< corner by corner, as the indices list them
  free,  ///< triangles, lines and points as sets: each has the same corners, in whatever place
};

enum class AnimationComparison : std::uint8_t {
  keys,  ///< the same keyframes
  /// The same values at all keyframes of `before` and at four moments between two of them, apart
  /// from rounding (2^-22 of the values at both), and the same first and last moment.
  curves,
};

enum class ImageComparison : std::uint8_t {
  none,
  bytes,  ///< of the files
  /// Exactly the same, channels and depth expanded. Files with the same bytes are not decoded.
  /// Where one of two images cannot be decoded, bytes count.
  texels,
};

/// Distances that still count as none; all 0: exact.
struct Tolerance {
  double position = 0;   ///< in the space of the mesh; with `in_world` in that of the scene
  double direction = 0;  ///< degrees: of NORMAL, and of TANGENT, whose w is exact
  double texcoord = 0;
  double color = 0;
  double weight = 0;     ///< of WEIGHTS_n
  double animation = 0;  ///< AnimationComparison::curves: of each component
};

struct MeaningRequest {
  /// Where it is free there is no tolerance: change values and order in two steps, prove each.
  VertexOrder order = VertexOrder::kept;
  AnimationComparison animations = AnimationComparison::keys;
  ImageComparison images = ImageComparison::texels;
  /// What nothing refers to need not be in `after`: materials, meshes, textures and their like, and
  /// extensions in `extensionsUsed`. Scenes, animations and nodes always stay.
  bool unused_may_go = false;
  /// POSITION is compared in the space of the scene, for each node that uses the mesh without a
  /// skin. The transform of such a node may change where nothing but the mesh tells: it has no
  /// children, camera or extensions, and no animation moves it. Not with VertexOrder::free.
  bool in_world = false;
  Tolerance tolerance = {};
  unsigned jobs = 1;       ///< threads that decode
  std::size_t most = 100;  ///< differences to list
};

/// One place where the assets differ.
struct Difference {
  std::string pointer;  ///< JSON pointer in `before`; of what is new there the place that has it
  std::string what;     ///< no stop: "POSITION of corner 17 is 0.25 away"
  double amount = 0;    ///< as far as measured, in the unit of its Tolerance; 0: not a number's
};

/// The greatest distance of one quantity over the asset, within its tolerance or not.
struct Measured {
  std::string quantity;  ///< "POSITION", "TEXCOORD", "translation"
  double greatest = 0;   ///< in the unit of its Tolerance
  std::string pointer;   ///< where, in `before`
};

struct Meaning {
  std::vector<Difference> differences;
  std::uint64_t more = 0;          ///< differences that are not listed
  std::vector<Measured> measured;  ///< those above 0
  /// What `before` has that cannot be read, and so was not compared: sentences with a pointer.
  std::vector<std::string> unread;

  bool same() const { return differences.empty(); }
};

/// Compares two assets. They may be broken in any way: what cannot be read in `before` is left out,
/// what can be read there and not in `after` is a difference. Reads all buffers (mapped), decodes
/// Draco and meshopt, and images where that is asked for; takes memory for the two texts and one
/// primitive or image at a time, and for decoded streams. Time grows with the size of the assets, n
/// log n, and with what primitives refer to, whoever shares it. Without a text there is nothing to
/// compare: that is a difference if `before` has one.
Meaning compare_meaning(const model::OpenedAsset& before, const model::OpenedAsset& after,
                        const schema::Set& schemas, const MeaningRequest& request);

/// Compares primitives alone, meshes with the same number, as the request says of vertices: for
/// changes of other objects that renumber nothing. All else as above.
Meaning compare_meshes(const model::OpenedAsset& before, const model::OpenedAsset& after,
                       const schema::Set& schemas, const MeaningRequest& request);

}  // namespace gltfx::prove
