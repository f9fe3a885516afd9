// SPDX-License-Identifier: Apache-2.0
// Features of property tables: the types of their columns. A schema in a separate file is not
// opened for it.
#include <string>

#include "model/fields.hpp"
#include "model/metadata.hpp"
#include "rules/payload/metadata/phase.hpp"
#include "rules/targets/features.hpp"

namespace gltfx::validate {
namespace {

using json::NodeId;
using model::MetadataType;

void find_column(const model::MetadataProperty& property, NodeId column, Features& features) {
  const MetadataType type = property.type;
  features.note_if(type == MetadataType::boolean, "structural-metadata.boolean", column);
  features.note_if(type == MetadataType::enumeration, "structural-metadata.enum", column);
  features.note_if(type == MetadataType::string, "structural-metadata.string", column);
  features.note_if(type >= MetadataType::mat2 && type <= MetadataType::mat4,
                   "structural-metadata.matrix", column);
  features.note_if(property.is_variable(), "structural-metadata.array", column);
  features.note_if(property.array && !property.is_variable(), "structural-metadata.array-fixed",
                   column);
}

}  // namespace

void find_metadata_features(const Context& context, Features& features) {
  const json::Document& document = context.document;
  const NodeId root = model::extension_object(document, document.root(), kMetadataExtension);
  const NodeId tables = document.find(root, "propertyTables");
  if (tables == json::kNoNode || document.kind(tables) != json::Kind::array) return;
  const model::MetadataSchema schema(document, model::object_member(document, root, "schema"));
  for (const NodeId table : document.elements(tables)) {
    const auto* of = schema.find_class(model::string_member(document, table, "class"));
    const NodeId columns = model::object_member(document, table, "properties");
    if (of == nullptr || columns == json::kNoNode) continue;
    for (const auto column : document.members(columns)) {
      const auto* property = of->find(document.key(column.key_id));
      if (property != nullptr) find_column(*property, column.value, features);
    }
  }
}

}  // namespace gltfx::validate
