// SPDX-License-Identifier: Apache-2.0
/// The bytes of a column of a property table (3D Metadata, "Binary Table Format").
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "rules/payload/metadata/value_scan.hpp"

namespace gltfx::validate {

/// Bytes of one of the buffer views of a column.
struct ColumnPart {
  std::string_view member;  ///< "values"
  std::optional<container::Bytes> bytes;
  std::uint64_t byte_offset = 0;  ///< in its buffer
  unsigned size = 0;              ///< bytes per offset; 0: not offsets
};

/// A column whose bytes are checked. Property and limits outlive it.
struct Column {
  const model::MetadataProperty* property = nullptr;
  std::size_t table = 0;  ///< index
  json::NodeId node = json::kNoNode;
  std::uint64_t rows = 0;
  ColumnPart values, array_offsets, string_offsets;
  ValueLimits limits;
};

/// The problems of the bytes of a column. Reads them once; thread-safe.
std::vector<StoredFinding> scan_column(const Column& column);

}  // namespace gltfx::validate
