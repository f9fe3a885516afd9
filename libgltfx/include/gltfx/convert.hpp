// SPDX-License-Identifier: Apache-2.0
/// @file
/// Options of `gltfx convert`, and the report of each step. The calls are in <gltfx/pipeline.hpp>.
#pragma once

#include <gltfx/edited_file.hpp>
#include <gltfx/loss_bounds.hpp>
#include <gltfx/targets.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

/// The storage of an asset.
enum class StoredAs : std::uint8_t {
  glb,       ///< one binary file with all buffers and images
  gltf,      ///< JSON text with files for buffers and images
  embedded,  ///< JSON text with data URIs for buffers and images
};

/// The version of a GLB.
enum class GlbVersion : std::uint8_t {
  least,  ///< 2, or 3 for more than 4 GiB
  two,    ///< at most 4 GiB, and one BIN chunk
  three,  ///< of the draft of glTF 2.1
};

/// How geometry is stored.
enum class Compression : std::uint8_t { none, meshopt, draco };

/// What images are used as: the union of their texture slots.
enum class ImageClass : std::uint8_t { color, normal, data };

/// The format that images get.
enum class ImageTarget : std::uint8_t {
  webp,
  png,
  jpeg,
  ktx2,   ///< UASTC with mipmaps, which graphics cards keep compressed
  avif,   ///< for colors only, where gltfx was built with libavif
  legal,  ///< PNG, for images that neither glTF nor an extension in use allows
};

/// A request for images.
struct ImageConversion {
  ImageTarget target = ImageTarget::png;  ///< the new format
  std::optional<ImageClass> only;         ///< nothing: all classes
};

/// The point of the box of the default scene, at rest, that moves to the origin.
enum class Pivot : std::uint8_t {
  bottom,  ///< the center of its lower side
  origin,  ///< its center
};

/// Size and place of an asset.
struct Placement {
  std::optional<Pivot> center;  ///< nothing: the scene stays where it is
  double scale = 1;             ///< factor of all lengths, finite and above 0
  bool rebase = false;          ///< large offsets of vertices move into nodes, those of nodes up
};

/// How far triangles are simplified. Exactly one of the two is not 0.
struct Simplification {
  /// Greatest distance of the surfaces before and after, as a part of the diagonal of the box of
  /// the default scene at rest; for a mesh in no scene, of its own box.
  double error = 0;
  std::uint64_t triangles = 0;  ///< of all meshes together; meshes that must not change count, too
};

/// Versions after 2.0: of glTF, of GLB, and what becomes of external assets.
struct LaterParts {
  std::string gltf;      ///< "2.0": the asset gets that version; empty: it keeps its own
  bool flatten = false;  ///< external assets are copied into the asset
  /// Nothing: `least`, but an asset that is replaced in place, or goes nowhere, keeps its version
  /// unless ConvertOptions::to is glb.
  std::optional<GlbVersion> glb_version;
};

/// Options of a run.
struct ConvertOptions : EditOptions {
  /// Nothing: from the ending of the output, or unchanged if there is no output.
  std::optional<StoredAs> to;
  /// Nothing: compressed geometry stays as its bytes.
  std::optional<Compression> compress;
  /// The first that applies to an image decides.
  std::vector<ImageConversion> images;
  /// 1 to 100, of lossy images except KTX2. Nothing: WebP and PNG are exact, JPEG has 90, AVIF 80.
  std::optional<std::uint32_t> quality;
  std::optional<std::uint32_t> texture_size;  ///< texels that no side exceeds; nothing is enlarged
  /// Vertices become integers within these bounds. Nothing: they stay exact.
  std::optional<LossBounds> quantize;
  bool dedup = false;     ///< equal accessors, views, images, samplers, textures, materials once
  bool prune = false;     ///< unused objects and vertices go
  bool weld = false;      ///< equal vertices of a primitive once
  bool reorder = false;   ///< triangles and vertices for the caches of a GPU
  bool resample = false;  ///< removes keyframes that interpolation reproduces
  Placement placement;    ///< another size or place of the default scene
  std::optional<Simplification> simplify;  ///< nothing: all triangles stay
  /// All that loses nothing: the five above, PNG images compressed again, and compact JSON in GLBs.
  bool shrink = false;
  /// Replaces what one of these engines refuses, or ignores with an effect on the picture. With
  /// `shrink`, geometry and images get the smallest encoding that all of them read.
  std::vector<TargetChoice> targets;
  LaterParts later;     ///< versions after 2.0
  bool verify = false;  ///< compares rendered pictures before and after
  /// Write although a part of the request was refused.
  bool partial = false;
  /// Other assets have their files in the same folder: names of new files contain a hash of their
  /// content.
  bool shared_folder = false;
  unsigned jobs = 1;  ///< threads for one asset; results do not depend on it
};

/// An object that a step skipped, and why.
struct ConvertNote {
  std::string pointer;  ///< in the document before the step; empty: the whole asset
  std::string reason;   ///< half a sentence
};

/// A loss of a step.
struct ConvertLoss {
  std::string quantity;   ///< "normals", or the lost value: "the name of /buffers/1"
  double bound = 0;       ///< greatest permitted loss; 0: not a quantity
  double measured = 0;    ///< never above the bound
  std::string_view unit;  ///< unit of both, static storage
};

/// Result of one step. Owns its text.
struct ConvertStep {
  std::string_view step;             ///< name of the step, static storage
  std::string what;                  ///< its effect, half a sentence; empty: none
  bool changes = false;              ///< the asset after the step differs from the one before
  std::vector<ConvertNote> left;     ///< objects that it does not apply to
  std::vector<ConvertNote> refused;  ///< objects that it applies to, but not safely
  std::vector<ConvertLoss> losses;   ///< empty: no loss
  std::uint64_t bytes_before = 0;    ///< size of the asset with its files
  std::uint64_t bytes_after = 0;     ///< the same
  /// Bytes of images on a graphics card, with mipmaps; both 0: the step changes no image.
  std::uint64_t gpu_bytes_before = 0;
  std::uint64_t gpu_bytes_after = 0;  ///< the same
};

/// A feature of the new asset that a target refuses, or ignores with an effect on the picture.
struct ConvertRemainder {
  std::string target;    ///< "three.js 0.187.0"
  std::string feature;   ///< its name in schema/targets/features.json
  std::string pointer;   ///< in the new document; empty: the whole asset
  std::string message;   ///< one sentence, as of TARGET_REFUSES or TARGET_IGNORES
  std::string help;      ///< what an author can do, an imperative; may be empty
  bool refused = false;  ///< the target loads nothing
};

/// What an option would save, if it were the only one. Images are not encoded to find that.
struct ConvertSaving {
  std::string_view option;      ///< "--prune", static storage
  std::uint64_t bytes = 0;      ///< of the files; 0 with `--texture-size`, where it is not known
  std::uint64_t gpu_bytes = 0;  ///< on the graphics card
};

/// Result for one file. Owns its text.
struct ConvertReport : EditOutcome {
  std::vector<ConvertStep> steps;      ///< the requested steps, in order
  std::vector<std::string> new_files;  ///< new files of the new document, relative to its folder
  /// Warnings of `gltfx validate` that only the new document has, one per code: "CODE at /pointer:
  /// message".
  std::vector<std::string> new_warnings;
  std::vector<ConvertRemainder> remaining;  ///< what no step could replace, by target
  /// Of a dry run that asks for no step: what options would save. Else empty.
  std::vector<ConvertSaving> savings;
  std::uint64_t gpu_image_bytes = 0;  ///< beside them: memory on the graphics card, of images
  std::uint64_t gpu_mesh_bytes = 0;   ///< the same, of meshes
  bool verified = false;              ///< the pictures before and after are the same
  std::string not_verified;           ///< why there are no pictures, without full stop; else empty

  /// Number of objects that steps refused, and of remaining features that a target refuses.
  std::uint64_t refused() const;
};

}  // namespace gltfx
