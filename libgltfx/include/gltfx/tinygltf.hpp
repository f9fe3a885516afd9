// SPDX-License-Identifier: Apache-2.0
/// @file
/// Assets as models of tinygltf (github.com/syoyo/tinygltf) and back, for programs that use it:
/// tinygltf gets validated bytes only, and decoded data where it has no decoder.
/// The calls are in the CMake target gltfx::tinygltf, built with the version of tiny_gltf.h that
/// CMake found.
#pragma once

#include <gltfx/decoders.hpp>
#include <gltfx/memory_asset.hpp>
#include <gltfx/report.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace gltfx {

namespace schema {
class Set;
}

/// What `tinygltf::Image::image` holds.
enum class TinygltfImages : std::uint8_t {
  /// RGBA, 8 or 16 bits a channel, as tinygltf's own loader has it. Images that cannot be decoded,
  /// such as KTX2, stay encoded, and a note says so.
  decoded,
  encoded,  ///< the bytes of the image file; `as_is` is set
};

/// How an asset becomes a model.
struct ToTinygltfOptions {
  TinygltfImages images = TinygltfImages::decoded;  ///< what Image::image holds
  /// Write sparse accessors out in full, for programs that do not look at `sparse`. Those that
  /// would take too much memory stay as they are, and a note says so.
  bool expand_sparse = false;
  /// Folder that the asset and its files may come from; empty: the asset's own. For assets in
  /// memory, empty means none.
  std::string root;
  unsigned jobs = 0;  ///< threads; 0: one a core
  /// What is known of glTF; null: the built-in set. Shared with other threads, never changed.
  std::shared_ptr<const schema::Set> schemas;
};

/// How a model becomes an asset.
struct FromTinygltfOptions {
  /// Put bytes of buffers and images into the .gltf itself, as data URIs, independent of their
  /// `uri`.
  bool embed = false;
  unsigned jobs = 0;  ///< threads; 0: one a core
  /// What is known of glTF; null: the built-in set. Shared with other threads, never changed.
  std::shared_ptr<const schema::Set> schemas;
};

/// A difference between the asset and the model.
struct TinygltfNote {
  std::string pointer;  ///< in the document that was read or written (RFC 6901)
  std::string message;  ///< its outcome, the end of a sentence, without full stop
  bool lost = false;    ///< the other side cannot hold it; else it has another form there
};

/// Outcome of a conversion. Owns its text.
struct TinygltfReport {
  bool done = false;                 ///< else the model, or the asset, is unchanged
  std::string error;                 ///< why it is not, one sentence, without full stop
  FileReport validation;             ///< of the asset that was read or would be written
  std::vector<TinygltfNote> notes;   ///< in no particular order
  std::vector<std::string> written;  ///< paths of files
};

/// Validates the .gltf or .glb at `path` and fills `model` with it, as tinygltf's own loader would
/// (values of `Material::values` and `Model::lights` included), except:
/// - Compressed data (KHR_draco_mesh_compression, EXT_ and KHR_meshopt_compression) becomes plain
///   accessors, and the extension is no longer named. Nothing is renumbered: decoded bytes are
///   after all others or in the empty buffer that is their fallback; compressed ones stay. Bounds
///   of accessors become those of the decoded values, since compression rounds.
/// - Channels of animations that move no node are there, with a `target_node` of -1.
/// - Nulls, empty objects and numbers beyond 32 bits in extras and extensions are kept.
/// - `uri` of buffers and images that were data URIs is empty.
/// Quantised accessors stay as they are. An invalid asset is refused: errors are in `validation`.
/// Never throws. Safe to call from several threads for different models.
TinygltfReport to_tinygltf(const std::string& path, tinygltf::Model& model,
                           const ToTinygltfOptions& options = {});
/// The same from memory.
TinygltfReport to_tinygltf(const MemoryAsset& asset, tinygltf::Model& model,
                           const ToTinygltfOptions& options = {});

/// Writes `model` to `path`, as a GLB when that ends in .glb; files that buffers and images name go
/// into the same folder or below it. They are validated before anything is written, and each is
/// replaced whole or not at all, the asset itself last. Buffers without a `uri` become the BIN
/// chunk (the first one of a GLB) or files beside the asset; pixels become PNG files, or WebP ones
/// where they were WebP; images in a buffer view are taken from there and their pixels are ignored.
/// `Material::values` and `additionalValues` are ignored. Never throws.
TinygltfReport from_tinygltf(const tinygltf::Model& model, const std::string& path,
                             const FromTinygltfOptions& options = {});
/// The same into memory: the ending of `asset.name`, .gltf or .glb, gives the format. Its bytes and
/// files are replaced.
TinygltfReport from_tinygltf(const tinygltf::Model& model, MemoryAsset& asset,
                             const FromTinygltfOptions& options = {});

}  // namespace gltfx
