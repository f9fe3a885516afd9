// SPDX-License-Identifier: Apache-2.0
/// @file
/// Contents of an asset: counts, sizes, use of bytes, extensions. The calls are in
/// <gltfx/pipeline.hpp>.
#pragma once

#include <gltfx/measure.hpp>
#include <gltfx/searched_folders.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

namespace schema {
class Set;
}

/// Use of the bytes of an asset's files. A byte that several objects refer to counts once, for the
/// object whose part of the buffer begins first.
enum class ByteUse : std::uint8_t {
  json,        ///< the JSON text, without the payloads of data URIs
  meshes,      ///< vertices, indices, morph targets, compressed or not
  images,      ///< encoded
  animations,  ///< times and values
  skins,       ///< inverse bind matrices
  other,       ///< other users of buffers, such as instances of a mesh
  unused,      ///< no known object refers to them
  base64,      ///< bytes of data URIs beyond those that they encode
  padding,     ///< headers of a GLB, and up to 15 bytes between two objects
};
inline constexpr std::size_t kByteUseCount = 9;  ///< how many there are
/// "json", "meshes" and so on.
std::string_view byte_use_name(ByteUse use);
using ByteShares = std::array<std::uint64_t, kByteUseCount>;  ///< by ByteUse

/// A file that belongs to an asset.
struct FileFacts {
  std::string uri;          ///< as the asset names it; empty: the asset itself
  std::uint64_t bytes = 0;  ///< its size
};

/// An extension that an asset declares or has.
struct ExtensionFacts {
  std::string name;  ///< as extensionsUsed has it
  /// "ratified", "release-candidate", "draft", "legacy", "archived", "vendor"; "unknown" when there
  /// is no schema of it.
  std::string status;
  std::string spec, successor;  ///< an address and a name; may be empty
  bool used = false;            ///< in extensionsUsed
  bool required = false;        ///< in extensionsRequired
  bool seen = false;            ///< some object has it
  bool has_objects = true;      ///< by its schema; some extensions have no objects
  /// Accessors in a format that an extension without objects adds; absent where it adds none.
  std::optional<std::uint64_t> accessors = std::nullopt;
};

/// One mesh, drawn once. Triangles and vertices as accessors declare them.
struct MeshFacts {
  std::string name;                                           ///< may be empty, like those below
  std::uint64_t primitives = 0, triangles = 0, vertices = 0;  ///< how many it has
  std::uint64_t bytes = 0;                                    ///< in files
  std::uint64_t gpu_bytes = 0;                                ///< of its accessors, decompressed
};

/// One material.
struct MaterialFacts {
  std::string name;                     ///< as it is written
  std::string alpha_mode;               ///< "OPAQUE", "MASK", "BLEND"
  bool double_sided = false;            ///< both sides are drawn
  std::uint64_t textures = 0;           ///< slots that are filled
  std::vector<std::string> extensions;  ///< names, in the order of the file
};

/// One image.
struct ImageFacts {
  std::string name;      ///< as it is written
  std::string uri;       ///< of a file; empty: inside the asset
  std::string format;    ///< media type by its first bytes; empty: unknown
  std::string encoding;  ///< of KTX2: "ETC1S", "UASTC", "ASTC" or "Vulkan format N"
  std::uint32_t width = 0, height = 0, bits = 0;  ///< 0: could not be read
  std::string channels;                           ///< "rgb"
  std::uint32_t levels = 1;                       ///< of its mipmaps that are stored
  std::vector<std::string> slots;  ///< of materials that show it: "baseColorTexture", sorted
  std::string color_space;     ///< in which the slots read it: "sRGB", "linear", "both", or empty
  std::uint64_t textures = 0;  ///< that name it
  std::uint64_t bytes = 0;     ///< as it is stored
  /// With all mipmaps: four bytes per texel for formats that a graphics card cannot keep
  /// compressed, one or half a byte for others.
  std::uint64_t gpu_bytes = 0;
};

/// One animation.
struct AnimationFacts {
  std::string name;     ///< as it is written
  double duration = 0;  ///< seconds, to the last keyframe
  std::uint64_t channels = 0, samplers = 0, keyframes = 0, bytes = 0;  ///< how many it has
};

/// One skin.
struct SkinFacts {
  std::string name;                     ///< as it is written
  std::uint64_t joints = 0, bytes = 0;  ///< how many it has
};

/// A camera or a light.
struct NamedFacts {
  std::string name, type;  ///< "perspective", "point"
};

/// A class of the asset's structural metadata.
struct MetadataClassFacts {
  std::string name;              ///< its id
  std::uint64_t properties = 0;  ///< how many it has
};

/// A property table of structural metadata.
struct PropertyTableFacts {
  std::string name, class_id;                      ///< as they are written
  std::uint64_t rows = 0, columns = 0, bytes = 0;  ///< how many it has
};

/// An element of `files` (glTF 2.1).
struct ReferredFileFacts {
  std::string name;                         ///< as it is written
  std::string uri;                          ///< likewise; empty: it is in a buffer view
  std::string mime_type;                    ///< as it is written
  std::optional<std::uint64_t> bytes = {};  ///< its size; absent: it could not be read
  std::vector<std::string> aliases;         ///< URIs that have other contents in this file
  std::string problem;                      ///< why it could not be read, half a sentence
};

/// Whether an external asset was read.
enum class ExternalAssetState : std::uint8_t {
  read,      ///< its own external assets follow it
  repeated,  ///< it is listed before, with its own external assets
  cycle,     ///< it has itself among its external assets, at any depth; it is left out
  unread,    ///< there is a problem
};
/// "read", "repeated" and so on.
std::string_view external_asset_state_name(ExternalAssetState state);

/// An element of `externalAssets` (glTF 2.1), of the asset or of one of its external assets.
struct ExternalAssetFacts {
  std::uint64_t depth = 0;   ///< 0: of the asset itself; else 1 more than that of its parent
  std::uint64_t index = 0;   ///< in `externalAssets` of its parent
  std::string path;          ///< of its file: below the asset's folder, or "parent.gltf#/files/0"
  std::string mime_type;     ///< as the element of `files` states it
  std::uint64_t placed = 0;  ///< nodes of the parent that have it
  ExternalAssetState state = ExternalAssetState::read;            ///< whether it was read
  std::uint64_t nodes = 0, meshes = 0, triangles = 0, bytes = 0;  ///< its own, if it was read
  std::string problem;  ///< why it was not read, half a sentence; else empty
};

/// Bounds of what the default scene shows, in metres; without morph targets; skinned meshes in the
/// pose of the file. External assets are included.
struct SceneBounds {
  std::array<double, 3> least{}, greatest{};  ///< corners: x, y, z
};

/// Owns its text; independent of the asset.
struct AssetFacts {
  std::string mime_type;  ///< "model/gltf+json", "model/gltf-binary"
  std::string version, min_version, generator, copyright;  ///< of `asset`; may be empty
  std::vector<FileFacts> files;            ///< those found, each once, the asset first
  ByteShares bytes{};                      ///< add up to the files
  std::vector<ExtensionFacts> extensions;  ///< sorted by name
  std::uint64_t scenes = 0, nodes = 0, accessors = 0, textures = 0;  ///< how many there are
  std::uint64_t primitives = 0, triangles = 0, vertices = 0;         ///< each once
  /// By the default scene, each time a node draws them, those of external assets included.
  std::uint64_t drawn_triangles = 0;
  std::optional<SceneBounds> bounds;        ///< absent: nothing is shown, or its extent is unknown
  std::vector<MeshFacts> meshes;            ///< these, like those below, by index
  std::vector<MaterialFacts> materials;     ///< by index
  std::vector<ImageFacts> images;           ///< by index
  std::vector<AnimationFacts> animations;   ///< by index
  std::vector<SkinFacts> skins;             ///< by index
  std::vector<NamedFacts> cameras, lights;  ///< by index
  std::vector<MetadataClassFacts> metadata_classes;  ///< in the order of the schema in the asset
  std::vector<PropertyTableFacts> property_tables;   ///< by index
  std::uint64_t shapes = 0, bounding_volumes = 0;    ///< how many it has; 0 before glTF 2.1
  std::vector<ReferredFileFacts> referred_files;     ///< by index
  /// Each is followed by its own ones, whose depth is greater.
  std::vector<ExternalAssetFacts> external_assets;
  std::vector<std::string> problems;         ///< what could not be read, a sentence each
  std::optional<Measurements> measurements;  ///< of all measures, if requested

  std::uint64_t total_bytes() const;      ///< of all files
  std::uint64_t image_gpu_bytes() const;  ///< of all images
  std::uint64_t mesh_gpu_bytes() const;   ///< of all meshes
};

/// Outcome of an upgrade for one object.
struct UpgradeFact {
  std::string pointer, from, to;  ///< `to` may be empty
  std::string outcome;  ///< as in upgrade_outcome_name(); "removed" when it is only deleted
  bool done = false;    ///< an upgrade with default options does it
  std::vector<std::string> notes;  ///< as UpgradeAction has them
};

/// A finding of the rules about what an asset without errors shows: the group `shows`, without
/// hints.
struct ShownFact {
  std::string code;      ///< of the rule: "NOTHING_VISIBLE"
  std::string severity;  ///< "warning", "info"
  std::string pointer;   ///< JSON pointer of the object; empty: the whole asset
  std::string message;   ///< one sentence
};

/// Options of an inspection.
struct InspectOptions {
  /// Folder that the asset and its files may come from; empty: the asset's own.
  std::string root;
  /// Folders that were searched: without a `root`, an asset below one is opened beneath it. Null:
  /// none. Not changed during a call.
  std::shared_ptr<const SearchedFolders> searched;
  unsigned jobs = 1;      ///< threads for compressed geometry
  bool measures = false;  ///< take all measures
  bool pixels = false;    ///< decode images for those that need pixels
  /// Schemas; null: the built-in set. Shared with other threads, never changed.
  std::shared_ptr<const schema::Set> schemas;
};

/// Report on one file. Owns its text.
struct InspectReport {
  std::string path;                  ///< as the user named it
  std::string error;                 ///< why there are no facts, one sentence; else empty
  std::optional<AssetFacts> facts;   ///< set if there is no error
  std::vector<UpgradeFact> upgrade;  ///< legacy objects, in the order of the document
  std::string upgrade_problem;       ///< why no upgrade is possible; else empty
  std::vector<ShownFact> shown;      ///< in the order of a validation
  std::string shown_problem;         ///< why these rules did not run, one sentence; else empty
};

/// `gltfx inspect --format json`: one report after the other.
class InspectWriter {
 public:
  void begin(std::string& out);                              ///< before the first report
  void file(const InspectReport& report, std::string& out);  ///< each report
  void end(std::string& out);                                ///< after the last one

 private:
  bool has_files_ = false;
};

/// The JSON Schema (2020-12) of that output.
std::string_view inspect_report_schema();

}  // namespace gltfx
