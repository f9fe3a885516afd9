// SPDX-License-Identifier: Apache-2.0
#include "rules/payload/metadata/property_table.hpp"

#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "rules/finding.hpp"
#include "rules/payload/metadata/values.hpp"

namespace gltfx::validate {
namespace {

using model::MetadataProperty;
using model::MetadataType;

// Bytes of an offset type; 0: unknown type.
unsigned offset_size(const json::Document& document, json::NodeId column, std::string_view member) {
  const json::NodeId value = document.find(column, member);
  if (value == json::kNoNode) return 4;
  if (!document.is_string(value)) return 0;
  const std::string name = document.string(value);
  return name.starts_with("UINT")
             ? metadata_component_size(model::metadata_component_from_name(name))
             : 0;
}

class TableCheck {
 public:
  explicit TableCheck(MetadataPhase& phase) : phase_(phase) {}

  void run() {
    for_each_listed(phase_, "propertyTables",
                    [&](std::size_t index, json::NodeId table, const PropertyUse& use) {
                      add(index, table, use);
                    });
    std::vector<std::vector<StoredFinding>> found(columns_.size());
    parallel_ordered(
        columns_.size(), phase_.context().options.jobs,
        [&](std::size_t i) { found[i] = scan_column(columns_[i]); },
        [&](std::size_t i) { report(columns_[i], std::move(found[i])); });
  }

 private:
  const json::Document& document() const { return phase_.document(); }

  void add(std::size_t index, json::NodeId table, const PropertyUse& use) {
    const MetadataProperty& property = use.property;
    check_offsets(use, "arrayOffsets", property.is_variable(),
                  "it is not an array of variable length");
    check_offsets(use, "stringOffsets", property.type == MetadataType::string,
                  "its type is not STRING");
    const auto rows = model::unsigned_member(document(), table, "count");
    if (!rows || *rows == 0 || !property.is_sound()) return;
    Column column;
    column.property = &property;
    column.table = index;
    column.node = use.value;
    column.rows = *rows;
    column.values = part(use, "values", 0);
    if (property.is_variable()) {
      column.array_offsets =
          part(use, "arrayOffsets", offset_size(document(), use.value, "arrayOffsetType"));
    }
    if (property.type == MetadataType::string) {
      column.string_offsets =
          part(use, "stringOffsets", offset_size(document(), use.value, "stringOffsetType"));
    }
    column.limits = value_limits(phase_, use);
    if (affordable(column, use)) columns_.push_back(std::move(column));
  }

  void check_offsets(const PropertyUse& use, std::string_view member, bool needed,
                     std::string_view why_not) {
    const json::NodeId value = document().find(use.value, member);
    if ((value != json::kNoNode) == needed || !use.property.is_sound()) return;
    if (needed) {
      report_member(phase_.sink(), phase_.context(), use.path, use.value, member,
                    Code::PROPERTY_TABLE_OFFSETS_MISSING,
                    fmt::format("Property {} has values of variable length; {} is missing.",
                                gltfx::quoted(use.property.id), gltfx::quoted(member)));
    } else {
      report_member(phase_.sink(), phase_.context(), use.path, use.value, member,
                    Code::PROPERTY_TABLE_OFFSETS_UNUSED,
                    fmt::format("{} has no effect for property {}, because {}.",
                                gltfx::quoted(member), gltfx::quoted(use.property.id), why_not));
    }
  }

  ColumnPart part(const PropertyUse& use, std::string_view member, unsigned size) const {
    ColumnPart found;
    found.member = member;
    found.size = size;
    const Context& context = phase_.context();
    const auto index = context.asset.index(use.value, member, model::RootArray::buffer_views);
    if (!index) return found;
    const model::BufferView& view = context.views.buffer_views[*index];
    found.byte_offset = view.byte_offset.value_or(0);
    found.bytes = phase_.data.resources.part(document(), view, 0, view.byte_length.value_or(0));
    return found;
  }

  // Columns may share bytes: without a limit, a small file could cause years of work.
  bool affordable(const Column& column, const PropertyUse& use) {
    for (const ColumnPart* each : {&column.values, &column.array_offsets, &column.string_offsets}) {
      if (!each->bytes || phase_.data.budget.take(each->bytes->size(), 1)) continue;
      report_in(phase_.sink(), use.path, document(), use.value, Code::ACCESSOR_DATA_NOT_CHECKED,
                "The columns of the tables have far more values than the file has bytes; this one "
                "is not checked.");
      return false;
    }
    return true;
  }

  void report(const Column& column, std::vector<StoredFinding> findings) {
    if (findings.empty()) return;
    with_metadata_path([&](const Path& path) {
      const Path list(path, "propertyTables");
      const Path table(list, column.table);
      const Path properties(table, "properties");
      report_stored(phase_, Path(properties, column.property->id), column.node,
                    std::move(findings));
    });
  }

  MetadataPhase& phase_;
  std::vector<Column> columns_;
};

}  // namespace

void check_property_tables(MetadataPhase& phase) { TableCheck(phase).run(); }

}  // namespace gltfx::validate
