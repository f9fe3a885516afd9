// SPDX-License-Identifier: Apache-2.0
/// @file
/// What changed between two assets: each change with its place, a sentence and a measure.
#pragma once

#include <gltfx/bake.hpp>
#include <gltfx/diagnostic.hpp>
#include <gltfx/memory_asset.hpp>
#include <gltfx/schema.hpp>
#include <gltfx/searched_folders.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

/// How much two assets differ. Each level includes those before it.
enum class CompareLevel : std::uint8_t {
  identical,  ///< the same bytes, of all files that the assets refer to, too
  storage,    ///< each value that a reader can get is the same, stored differently
  bounds,     ///< each difference is within the bound of its kind
  differs,    ///< at least one is not
};
/// "storage".
std::string_view compare_level_name(CompareLevel level);

/// Up to which distances values count as `CompareLevel::bounds`.
struct CompareBounds {
  double position = 1e-4;     ///< in the scene, as part of the smaller diagonal of both scenes
  double normal = 0.5;        ///< degrees, for NORMAL, TANGENT and texels of normal maps
  double texcoord = 0.25;     ///< texels of the largest image that the material reads
  double color = 0.5 / 255;   ///< for COLOR_n
  double weight = 5e-4;       ///< for the influence of a joint on a vertex
  double animation = 1e-4;    ///< part of the diagonal, radians, or a plain number
  double factor = 0.5 / 255;  ///< for numbers of materials, lights and cameras
  double image = 1.0 / 255;   ///< mean distance of texels
};

/// A kind of change: what `--ignore`, `--count` and reports name.
struct ChangeKind {
  std::string_view name;     ///< "material.value"
  std::string_view meaning;  ///< half a sentence
};
/// All kinds, sorted by name. Static storage.
std::span<const ChangeKind> change_kinds();
/// The kind with that name, or null.
const ChangeKind* find_change_kind(std::string_view name);

/// Options of a comparison.
struct CompareOptions {
  /// Folder that both assets and their files must be in; empty: the folder of each asset.
  std::string root;
  /// Folders in which assets were searched (see SearchedFolders); null: none.
  std::shared_ptr<const SearchedFolders> searched;
  /// Null: the built-in schemas.
  std::shared_ptr<const schema::Set> schemas;
  CompareBounds bounds;  ///< of the level `bounds`
  /// Only what is drawn counts: no names, hierarchy, extras, unused objects and attributes,
  /// unknown extensions and lists of extensions.
  bool drawn = false;
  std::set<std::string, std::less<>> ignore;  ///< names of kinds that do not count
  std::set<std::string, std::less<>> count;   ///< kinds that count although they do not by default
  unsigned jobs = 1;                          ///< threads for decoding; results do not depend on it
  /// Pixels along the sides of pictures of both assets, at most kMostComparePicture; 0: there are
  /// none.
  std::uint32_t picture_size = 0;
};

/// Maximum of CompareOptions::picture_size: no PNG file of such a picture is larger than 5 MB.
constexpr std::uint32_t kMostComparePicture = 1024;

/// A measured distance.
struct CompareMeasure {
  std::string_view quantity;  ///< "position", static storage
  double value = 0;           ///< in `unit`
  std::string_view unit;      ///< "%", "deg", "texel", static storage; empty: a plain number
  double bound = 0;           ///< of the level `bounds`, in the same unit
};

/// One change. Owns its text, which may contain any characters of the assets.
struct Change {
  std::string_view kind;                       ///< name of a ChangeKind
  CompareLevel level = CompareLevel::differs;  ///< the least that allows it
  std::optional<std::string> old_pointer;      ///< JSON pointer to the value; nothing: it was added
  std::optional<std::string> new_pointer;      ///< likewise; nothing: it was removed
  std::string name;                            ///< of the object; empty: it has none
  std::string what;                            ///< the change, half a sentence
  std::string before;  ///< the old value, cut; empty: there is none, or it is not short
  std::string after;   ///< likewise, the new one
  std::optional<CompareMeasure> measure;  ///< if the change is a distance
  std::optional<double> time;             ///< of an animation: where values differ most, in seconds
  Location old_location;  ///< of the value at `old_pointer`; line 0: it has no place
  Location new_location;  ///< likewise, at `new_pointer`
  /// Pointers to further values that differ for the same cause; at most 100.
  std::vector<std::string> also;
};

/// Bytes of one use in the files of both assets.
struct CompareSize {
  std::string_view what;        ///< "files" for all of them, or a byte_use_name(); static storage
  std::uint64_t old_bytes = 0;  ///< of the old asset
  std::uint64_t new_bytes = 0;  ///< of the new one
};

/// The part of a picture that shows the object of a change: parts of its width and height, from
/// the upper left.
struct PictureRegion {
  std::size_t change = 0;                           ///< index in CompareReport::changes
  bool is_old = false;                              ///< of the old asset; else of the new one
  double left = 0, top = 0, right = 1, bottom = 1;  ///< from 0 to 1
};

/// Both assets from one camera, in the same light and with the same noise.
struct ComparePicture {
  /// "usual"; "opposite", from the other side; or "change", with the object of the greatest change
  /// in the middle. Static storage.
  std::string_view view;
  std::optional<std::size_t> change;  ///< the one in the middle: index in CompareReport::changes
  BakedPixels old_pixels;             ///< empty: there is no such picture
  BakedPixels new_pixels;             ///< likewise
  BakedPixels difference;             ///< what changed in orange on grey; empty without both
  /// The greatest difference of the means of squares of 8 by 8 pixels, in steps of 255.
  double distance = 0;
  double limit = 0;                    ///< what noise and rounding explain of it, at most
  std::vector<PictureRegion> regions;  ///< of changed objects, at most 2000
  /// Names of the files that the caller wrote; compare_files() leaves them empty.
  std::string old_file, new_file, difference_file;

  /// Whether there is an old and a new picture.
  bool has_both() const { return !difference.bytes.empty(); }
  /// Whether the picture shows a change. The level of the assets does not depend on it.
  bool changed() const { return distance > limit; }
};

/// Result for a pair of assets. Owns its text.
struct CompareReport {
  std::string old_path;  ///< empty: the asset was added
  std::string new_path;  ///< empty: the asset was removed
  /// Assets that have this one as an external asset; compare_files() leaves it empty.
  std::vector<std::string> external_asset_of;
  CompareLevel level = CompareLevel::identical;  ///< of all that counts
  std::vector<Change> changes;        ///< in the order of the old asset, then of the new one
  std::vector<std::string> storage;   ///< what is stored differently, half sentences
  std::vector<std::string> unproven;  ///< what could not be compared, sentences
  /// All files first, then each use of their bytes that differs; empty for equal bytes.
  std::vector<CompareSize> sizes;
  /// Of CompareOptions::picture_size; none of assets with the same bytes.
  std::vector<ComparePicture> pictures;
  std::string picture_problem;  ///< why pictures are missing, sentences; empty: none is
  /// Why there is no comparison, with the name of the asset; empty: there is one.
  std::string error;

  /// Whether the assets are equal up to a level, and nothing is unproven.
  bool is_within(CompareLevel allowed) const {
    return error.empty() && level <= allowed && unproven.empty();
  }
};

/// Compares two files. Reads both, and the files that they refer to. Does not throw; writes
/// nothing. Time grows with the size of the assets, n log n; memory holds both texts, their
/// buffers (mapped) and one surface or image of each at a time. An empty path: there is no such
/// asset, and only the other one is drawn.
CompareReport compare_files(const std::string& old_path, const std::string& new_path,
                            const CompareOptions& options = {});

/// The same for assets in memory; nothing: there is no such asset. `root` and `searched` of the
/// options must be empty.
CompareReport compare_bytes(std::optional<MemoryAsset> old_asset,
                            std::optional<MemoryAsset> new_asset,
                            const CompareOptions& options = {});

/// The JSON Schema of what `gltfx compare --format json` writes.
std::string_view compare_report_schema();

}  // namespace gltfx
