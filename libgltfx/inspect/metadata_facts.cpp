// SPDX-License-Identifier: Apache-2.0
#include "inspect/metadata_facts.hpp"

#include <string_view>
#include <unordered_set>

#include "base/checked.hpp"
#include "model/fields.hpp"
#include "model/metadata.hpp"

namespace gltfx::inspect {
namespace {

constexpr std::string_view kMetadataExtension = "EXT_structural_metadata";

PropertyTableFacts table_facts(const model::Asset& asset, const model::Views& views,
                               json::NodeId table) {
  const json::Document& document = asset.document();
  PropertyTableFacts facts;
  facts.name = model::string_member(document, table, "name");
  facts.class_id = model::string_member(document, table, "class");
  facts.rows = model::unsigned_member(document, table, "count").value_or(0);
  const json::NodeId properties = model::object_member(document, table, "properties");
  if (properties == json::kNoNode) return facts;
  std::unordered_set<std::uint32_t> seen;
  for (const auto column : document.members(properties)) {
    ++facts.columns;
    for (const std::string_view member : {"values", "arrayOffsets", "stringOffsets"}) {
      const auto view = asset.index(column.value, member, model::RootArray::buffer_views);
      if (!view || !seen.insert(*view).second) continue;
      facts.bytes = saturating_add(facts.bytes, views.buffer_views[*view].byte_length.value_or(0));
    }
  }
  return facts;
}

}  // namespace

void add_metadata_facts(const model::Asset& asset, const model::Views& views, AssetFacts& facts) {
  const json::Document& document = asset.document();
  const json::NodeId root = model::extension_object(document, document.root(), kMetadataExtension);
  const model::MetadataSchema schema(document, model::object_member(document, root, "schema"));
  for (const model::MetadataClass& each : schema.classes()) {
    facts.metadata_classes.push_back({std::string(each.id), each.properties.size()});
  }
  const json::NodeId tables = document.find(root, "propertyTables");
  if (tables == json::kNoNode || document.kind(tables) != json::Kind::array) return;
  for (const json::NodeId table : document.elements(tables)) {
    facts.property_tables.push_back(table_facts(asset, views, table));
  }
}

}  // namespace gltfx::inspect
