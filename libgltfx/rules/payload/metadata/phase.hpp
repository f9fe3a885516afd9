// SPDX-License-Identifier: Apache-2.0
/// Structural metadata: its schema, and its values in tables, textures, attributes and objects.
#pragma once

#include <gltfx/report.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "model/metadata.hpp"
#include "rules/payload/phases.hpp"

namespace gltfx::validate {

inline constexpr std::string_view kMetadataExtension = "EXT_structural_metadata";

/// State shared by the parts.
struct MetadataPhase {
  DataPhase& data;
  FileReport& report;
  json::NodeId root = json::kNoNode;  ///< the extension's object on the root object, if any
  model::MetadataSchema schema = {};  ///< without a node if there is none, or it cannot be read
  /// By image of a color slot, that slot; made on the first use.
  std::optional<std::unordered_map<std::uint32_t, std::string>> color_slots = {};

  const Context& context() const { return data.context; }
  const json::Document& document() const { return data.context.document; }
  Sink& sink() const { return data.sink; }
};

/// Calls `use` with the path of the extension's object on the root object.
template <typename Use>
void with_metadata_path(Use&& use) {
  const Path root;
  const Path extensions(root, "extensions");
  use(Path(extensions, kMetadataExtension));
}

/// Reports at `path` that `node` of `document` is invalid: marks all of a scalar, the first
/// character of an object or array. For findings that may be in another file than the asset.
void report_in(Sink& sink, const Path& path, const json::Document& document, json::NodeId node,
               Code code, std::string message, std::optional<Severity> severity = {});

/// A schema in the asset or in a separate file, which is only opened inside the root.
class MetadataSource {
 public:
  /// Reads and checks the schema of `phase.root`, and stores it there. Problems of a file are
  /// reported at `schemaUri`, with the line of the file.
  void load(MetadataPhase& phase);

 private:
  bool read_file(MetadataPhase& phase, const Path& path);
  void check_file(MetadataPhase& phase, const Path& path);

  json::Document file_;
  std::string name_;  ///< name of the file
};

/// Rules about classes and enums that a schema file cannot state.
void check_metadata_schema(const model::MetadataSchema& schema, const Path& path, Sink& sink);

/// Property tables: their columns against the schema, then the bytes of all of them.
void check_property_tables(MetadataPhase& phase);
/// Property textures: their channels, texels as far as requested, and whether the primitives that
/// use them have the coordinates.
void check_property_textures(MetadataPhase& phase);
/// Property attributes, with the primitives that use them.
void check_property_attributes(MetadataPhase& phase);
/// The metadata of nodes, materials and so on.
void check_metadata_of_objects(MetadataPhase& phase);
/// Feature IDs of primitives and instances.
void check_feature_ids(MetadataPhase& phase);

}  // namespace gltfx::validate
