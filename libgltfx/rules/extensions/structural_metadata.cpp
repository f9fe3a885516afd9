// SPDX-License-Identifier: Apache-2.0
// EXT_structural_metadata: objects and primitives with metadata need a schema on the root object.
// Rules that need the schema, which may be another file, run with the data
// (rules/payload/metadata/).
#include "rules/extensions/structural_metadata.hpp"

#include "model/fields.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/payload/metadata/data_texture.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kMeshFeaturesExtension = "EXT_mesh_features";

void check_roots(const Context& context) {
  const auto check = [&](const ExtensionPlace& place, const Path& path) {
    check_root_extension(context, kMetadataExtension, place.object, path);
  };
  for (std::size_t i = 0; i < model::kRootArrayCount; ++i) {
    for_each_extension(context, static_cast<model::RootArray>(i), kMetadataExtension, check);
  }
  for_each_primitive_extension(context, kMetadataExtension, check);
}

}  // namespace

bool visit_data_texcoords(const Context& context, json::NodeId primitive,
                          const std::function<void(std::uint64_t)>& use) {
  const json::Document& document = context.document;
  if (has_objects_of(context, kMetadataExtension)) {
    const json::NodeId metadata = model::extension_object(document, primitive, kMetadataExtension);
    if (document.find(metadata, "propertyTextures") != json::kNoNode) return true;
  }
  if (!has_objects_of(context, kMeshFeaturesExtension)) return false;
  const json::NodeId features =
      model::extension_object(document, primitive, kMeshFeaturesExtension);
  if (features == json::kNoNode) return false;
  for (const json::NodeId set : object_list(document, features, "featureIds")) {
    const json::NodeId texture = model::object_member(document, set, "texture");
    if (texture == json::kNoNode) continue;
    if (const auto number = texcoord_set(document, texture)) use(*number);
  }
  return false;
}

const RuleGroup& structural_metadata_rules() {
  static constexpr LinkRule kLinkRules[] = {check_roots};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate
