// SPDX-License-Identifier: Apache-2.0
/// @file
/// What `gltfx convert` can be asked for, and what it says of each step. The calls are in
/// <gltfx/pipeline.hpp>.
#pragma once

#include <gltfx/edited_file.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

/// How an asset is stored.
enum class StoredAs : std::uint8_t {
  glb,       ///< one binary file with all buffers and images
  gltf,      ///< JSON text with files for buffers and images
  embedded,  ///< JSON text with data URIs for buffers and images
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
  legal,  ///< PNG, for images that neither glTF nor an extension in use allows
};

/// A request for images.
struct ImageConversion {
  ImageTarget target = ImageTarget::png;
  std::optional<ImageClass> only;  ///< nothing: all classes
};

/// What a run is asked for.
struct ConvertOptions : EditOptions {
  /// Nothing: as the name of the output ends, and as the input is stored where there is none.
  std::optional<StoredAs> to;
  /// Nothing: compressed geometry stays as its bytes.
  std::optional<Compression> compress;
  /// The first that applies to an image decides.
  std::vector<ImageConversion> images;
  /// 1 to 100, of lossy images. Nothing: WebP and PNG are exact, others have a default.
  std::optional<std::uint32_t> quality;
  std::optional<std::uint32_t> texture_size;  ///< texels that no side exceeds; nothing is enlarged
  bool dedup = false;     ///< equal accessors, views, images, samplers, textures, materials once
  bool prune = false;     ///< unused objects and vertices go
  bool weld = false;      ///< equal vertices of a primitive once
  bool reorder = false;   ///< triangles and vertices for the caches of a GPU
  bool resample = false;  ///< keyframes that interpolation gives exactly go
  /// All that loses nothing: the five above, and PNG images compressed again where that is smaller.
  bool shrink = false;
  bool verify = false;  ///< compares pictures and images before and after
  /// Write although something that was asked for was refused.
  bool partial = false;
  /// Other assets have their files in the same folder: names of new images say what is in them.
  bool shared_folder = false;
  unsigned jobs = 1;  ///< threads for one asset; results do not depend on it
};

/// An object that a step did not deal with, and why.
struct ConvertNote {
  std::string pointer;  ///< in the document as the step found it; empty: the asset
  std::string reason;   ///< half a sentence
};

/// What is not as it was.
struct ConvertLoss {
  std::string quantity;   ///< "normals", or what is gone: "the name of /buffers/1"
  double bound = 0;       ///< that was allowed; 0: it is no quantity
  double measured = 0;    ///< never above the bound
  std::string_view unit;  ///< of both, static storage
};

/// What one step came to. Owns its text.
struct ConvertStep {
  std::string_view step;             ///< its name, static storage
  std::string what;                  ///< what it does, half a sentence; empty: nothing
  bool changes = false;              ///< the asset differs from what it was before the step
  std::vector<ConvertNote> left;     ///< it does not apply to these
  std::vector<ConvertNote> refused;  ///< it applies, and is not safe there
  std::vector<ConvertLoss> losses;   ///< empty: nothing is lost
  std::uint64_t bytes_before = 0;    ///< of the asset with its files
  std::uint64_t bytes_after = 0;     ///< the same
};

/// What became of one file. Owns its text.
struct ConvertReport : EditOutcome {
  std::vector<ConvertStep> steps;      ///< those that were asked for, in their order
  std::vector<std::string> new_files;  ///< that the new document refers to, from its folder
  /// Warnings of `gltfx validate` that the new document has and the old one has not, one a code:
  /// "CODE at /pointer: message".
  std::vector<std::string> new_warnings;

  /// Objects that a step was refused for.
  std::uint64_t refused() const;
};

}  // namespace gltfx
