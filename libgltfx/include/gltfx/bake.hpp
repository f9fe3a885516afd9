// SPDX-License-Identifier: Apache-2.0
/// @file
/// Options of a picture of an asset, and its report. The calls are in <gltfx/pipeline.hpp>.
#pragma once

#include <gltfx/edited_bytes.hpp>
#include <gltfx/report.hpp>
#include <gltfx/searched_folders.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

namespace schema {
class Set;
}
class ResultCache;

/// False in a build without Embree (GLTFX_BAKE=OFF), where each picture has the problem
/// BakeProblem::refused.
bool can_bake();

/// Light sources of a picture. `studio`: soft boxes that follow the camera. `asset`: those of the
/// asset; the studio when it has none.
enum class BakeLights : std::uint8_t { studio, asset, both };

/// The amount of work for a picture.
enum class BakeQuality : std::uint8_t {
  draft,     ///< 4 samples; surfaces that are not seen themselves are lit by an open sky
  standard,  ///< up to 44 samples on average, fewer if the picture has little noise
  final,     ///< 256 samples and 12 bounces
};

/// How a camera around the asset projects it.
enum class BakeProjection : std::uint8_t {
  perspective,
  orthographic,  ///< parallel edges stay parallel, and sizes do not depend on the distance
};

/// Whether the camera is inside: at a place with a view of much of a room, with a wide angle and
/// light that comes in through walls.
enum class BakeInterior : std::uint8_t {
  automatic,  ///< in a closed room that shows only walls to a camera around it
  on,         ///< a camera of the asset stays in its place
  off,
};

/// What is seen beside the asset.
struct BakeBackground {
  /// What takes the place of the asset's surroundings.
  enum class Kind : std::uint8_t {
    automatic,    ///< the environment where there is one, else the studio
    studio,       ///< a grey backdrop with the shadow of the asset
    environment,  ///< what lights the asset: the soft boxes of the studio where there is no other
    color,        ///< as it is, without shadow and tone mapping
    transparent,  ///< nothing; an alpha channel where the format has one
  };
  Kind kind = Kind::automatic;                       ///< `color`: the color below
  std::array<std::uint8_t, 3> color{255, 255, 255};  ///< sRGB
};

/// From light to the range of a display, in pictures of 8 bits.
enum class BakeToneMap : std::uint8_t {
  neutral,  ///< Khronos PBR Neutral: base colors in white light do not change
  aces,     ///< fit of ACES by Stephen Hill, as bright as that of three.js
  agx,      ///< AgX, base look
  none,     ///< light above 1 is clipped
};

/// Pictures of something other than light, each in a file of its own.
enum class BakeLayer : std::uint8_t {
  albedo,    ///< base colour of the first visible surface
  normal,    ///< in the world: -1 to 1 stored as 0 to 1, in EXR unchanged
  depth,     ///< near is white; in EXR metres along the ray
  material,  ///< a colour for each; in EXR its index
};
/// "albedo", "normal", "depth", "material".
std::string_view bake_layer_name(BakeLayer layer);

/// What a picture shows of surfaces besides, or in place of, their materials. All but `clay` and
/// `wireframe` are lit from the camera, without shadows.
enum class BakeOverlay : std::uint8_t {
  none,
  clay,       ///< all surfaces opaque, grey and matt
  wireframe,  ///< the edges of triangles, over clay
  /// Texture coordinates of the base color: 8 by 8 squares for each unit, red by u, green by v;
  /// grey: none.
  uv,
  /// Texels for each metre of the base color, or else of the first texture: from blue (64) over
  /// cyan (256), green (1024) and yellow (4096) to red (16384); grey: no texture.
  density,
  facing,  ///< fronts of triangles blue, backs red, also those that are not drawn otherwise
};

/// How the frames of a turntable or clip become files.
enum class BakeLayout : std::uint8_t {
  automatic,  ///< an animation in WebP, else files
  files,      ///< one each, with "-NNN" before the name's ending
  animation,  ///< one WebP file, lossy, repeated without end
  /// One picture of all, in rows from the top: as many columns as the root of their number, rounded
  /// up.
  sprites,
};

/// Formats of pictures.
enum class BakeFormat : std::uint8_t { png, webp, jpeg, exr };

/// The greatest number of frames of a turntable or clip.
constexpr std::uint32_t kMostBakeFrames = 3600;

/// The mistake in the name of a picture to write, one sentence; empty when its ending is that of a
/// format.
std::string check_picture_name(const std::string& path);

/// Pixels, each side from 1 to 16384, and 2^26 in all at most.
struct BakeSize {
  std::uint32_t width = 512, height = 512;  ///< of the picture
};

/// Maximum of BakeOptions::samples.
constexpr std::uint32_t kMostBakeSamples = 1U << 20U;

/// Options of a picture.
struct BakeOptions {
  /// One file each; with several "-WIDTHxHEIGHT" goes before the name's ending.
  std::vector<BakeSize> sizes{BakeSize{}};
  /// Frames all around, at most kMostBakeFrames; 0: one picture.
  std::uint32_t turntable = 0;
  /// Animation by name or index, whose frames are drawn from its start to its end; the camera
  /// stays, with all of them in view. Empty: none. Not with `turntable` and `animation`.
  std::string clip;
  double fps = 0;  ///< frames a second; 0: 24 of a clip, 12 of a turntable
  BakeLayout layout = BakeLayout::automatic;  ///< of frames
  std::vector<BakeLayer> layers;  ///< beside the picture, with "-NAME" before the name's ending

  BakeQuality quality = BakeQuality::standard;  ///< for unset `samples` and `bounces`
  /// Paths through each pixel, at most; from 1 to kMostBakeSamples. With `denoise`, from 16 on and
  /// where neither `seconds` nor `noise` ends them, on average: from a quarter to four times as
  /// many, more where there is noise, which two to four further paths measure.
  std::optional<std::uint32_t> samples;
  std::optional<std::uint32_t> bounces;  ///< surfaces along a path that scatter, at most
  std::uint32_t seed = 0;                ///< of the noise
  bool denoise = true;                   ///< smooth the noise away
  double seconds = 0;  ///< for each picture; 0: no limit. With a limit, runs may differ.
  /// Standard error at which parts of a picture have enough samples, as part of the range from
  /// black to white; 0: all samples.
  double noise = 0;
  /// Use the literal sample implementations of the specification, which can reflect more than they
  /// receive.
  bool literal_shader = false;

  BakeLights lights = BakeLights::both;  ///< light sources
  std::string environment;  ///< a Radiance or OpenEXR file that lights the scene; empty: none
  /// Turns the environment or studio around y: degrees, in the direction of AZIMUTH below.
  double environment_rotation = 0;
  double exposure = 0;                          ///< stops, from -64 to 64; 1 doubles all light
  BakeBackground background;                    ///< pixels without a surface
  BakeToneMap tone_map = BakeToneMap::neutral;  ///< not of EXR pictures
  BakeOverlay overlay = BakeOverlay::none;      ///< for technical checks of surfaces

  /// Each a camera of the asset by name or index; for any asset "front", "back", "left", "right",
  /// "top", "bottom", "iso", or "AZIMUTH,ELEVATION" in degrees around it, "0,0" in front of it.
  /// With several, each has files of its own, with ".CAMERA" before the name's ending: letters of
  /// ASCII, digits, '-', '_' and ',' of its name, '_' for all else. Empty: three quarters from the
  /// front.
  std::vector<std::string> cameras;
  BakeProjection projection = BakeProjection::perspective;  ///< not of a camera of the asset
  /// Node by name, index or pointer ("/nodes/3") that fills the picture, with its subtree; all else
  /// is drawn in place. Not with a camera of the asset. Empty: everything.
  std::string frame;
  /// `automatic` holds for a perspective camera where `cameras`, `turntable` and `frame` are not
  /// set.
  BakeInterior interior = BakeInterior::automatic;
  std::string scene;  ///< name or index; empty: the default one
  /// Name or index, or "none". Empty: of an asset with skins the first animation that moves their
  /// joints and has "idle" in its name, else the first that moves them, else none.
  std::string animation;
  double time = 0;      ///< of the animation, seconds
  std::string variant;  ///< name or index; empty: none
  /// Names and indices of cameras, scenes, animations, clips and variants that the asset lacks
  /// count as not given, with a note where it has others; else they are refused.
  bool if_present = false;

  /// Refuse any asset that has errors, not only those that leave no picture, or of which parts
  /// would be left out.
  bool strict = false;
  /// File to write: .png, .webp, .jpg, .jpeg or .exr, or of any name with `format`. Folders are
  /// made.
  std::string output;
  std::optional<BakeFormat> format;  ///< nothing: by the ending of `output`
  /// Put the picture, of the first size, into the asset itself, as its thumbnail.
  bool embed = false;
  /// Folder that the asset and its files may come from; empty: the asset's own.
  std::string root;
  /// Folders that were searched: without a `root`, an asset below one is opened beneath it. Null:
  /// none. Not changed during a call.
  std::shared_ptr<const SearchedFolders> searched;
  unsigned jobs = 0;  ///< threads; 0: one a core. Pictures do not depend on it.
  /// Schemas; null: the built-in set. Shared with other threads, never changed.
  std::shared_ptr<const schema::Set> schemas;
  /// Records which pictures at `output` are current; these are not drawn again. Null: all are
  /// drawn. No effect without `output`, with `embed` and with `seconds`.
  std::shared_ptr<ResultCache> cache;
  /// Called now and then with the part of all pictures that is done, from 0 to 1, one call at a
  /// time, from any thread; may be empty.
  std::function<void(double)> progress;
};

/// Why there is no picture.
enum class BakeProblem : std::uint8_t {
  none,
  unreadable,      ///< the file could not be read, or is not glTF
  invalid,         ///< it is refused because of errors: see `validation`
  nothing_to_see,  ///< the asset is valid but shows nothing
  refused,         ///< the options cannot be met for this file
  not_written,     ///< the picture could not be encoded or written
};

/// 8 bits a channel, rows from the top, packed RGB or RGBA; alpha not multiplied in.
struct BakedPixels {
  std::uint32_t width = 0, height = 0;  ///< pixels
  std::uint32_t channels = 3;           ///< 3 or 4
  std::vector<std::uint8_t> bytes;      ///< width times height times channels
};

/// Outcome for one file. Owns its text.
struct BakeReport {
  std::string path;                         ///< as the user named it
  BakeProblem problem = BakeProblem::none;  ///< why there is no picture, if so
  std::string error;                        ///< the problem, one sentence
  FileReport validation;                    ///< with a picture, errors that did not prevent it
  std::vector<std::string> notes;    ///< parts that are drawn differently or not at all, sentences
  std::vector<std::string> written;  ///< paths of files
  bool embedded = false;             ///< the asset has the picture now
  BakedPixels pixels;                ///< the first picture
};

/// Outcome for an asset in memory. Owns all its data. `bytes` and `files` are those of the asset
/// with its thumbnail if that is embedded, else empty.
struct BakedBytes : EditedBytes<BakeReport> {
  /// PNG files, by what bake_file() puts before the ending of their names: "", "-000", "-albedo".
  std::map<std::string, std::string> pictures;
};

/// How much two pictures of one size differ.
struct BakeComparison {
  BakeReport first, second;  ///< of the two assets
  /// Decibels, of the range of 8 bits, over pixels that show either asset; infinite when they are
  /// the same. Not set when either has a problem.
  double psnr = 0;
  /// Mean structural similarity of the luma of the same pixels (Wang et al. 2004), 1 when they are
  /// the same. Not set when either has a problem.
  double ssim = 0;
  std::string error;  ///< why the picture of the difference could not be written; else empty
};

}  // namespace gltfx
