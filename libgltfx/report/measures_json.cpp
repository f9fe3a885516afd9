// SPDX-License-Identifier: Apache-2.0
#include "report/measures_json.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "report/value_json.hpp"

namespace gltfx::report {
namespace {

using json::Writer;

// Which element it is, as members of an object.
void write_element(Writer& writer, const Measurements& measurements, MeasureScope scope,
                   std::size_t element) {
  if (scope == MeasureScope::primitive) {
    writer.member("mesh", std::uint64_t{measurements.primitives[element].mesh});
    writer.member("index", std::uint64_t{measurements.primitives[element].index});
    return;
  }
  const auto& materials = measurements.columns[static_cast<std::size_t>(MeasureScope::material)];
  const bool last = !materials.empty() && element + 1 == materials.front().values.size();
  if (scope == MeasureScope::material && last && measurements.has_plain_primitives) {
    writer.key("index");
    writer.null();
    return;
  }
  writer.member("index", std::uint64_t{element});
}

void write_values(Writer& writer, const std::vector<MeasureColumn>& columns, std::size_t element) {
  for (const MeasureColumn& column : columns) {
    writer.key(column.measure->name);
    write_value(writer, column.values[element]);
  }
}

void write_scope(Writer& writer, const Measurements& measurements, MeasureScope scope) {
  const auto& columns = measurements.columns[static_cast<std::size_t>(scope)];
  if (columns.empty()) return;
  writer.key(measure_scope_name(scope));
  if (scope == MeasureScope::asset) {
    writer.begin_object();
    write_values(writer, columns, 0);
    writer.end_object();
    return;
  }
  writer.begin_array();
  for (std::size_t element = 0; element < columns.front().values.size(); ++element) {
    writer.begin_object();
    write_element(writer, measurements, scope, element);
    write_values(writer, columns, element);
    writer.end_object();
  }
  writer.end_array();
}

// The elements of a column that have no value for one reason.
struct Missing {
  std::uint32_t reason = 0;
  std::size_t first = 0;
  std::uint64_t count = 0;
};

std::vector<Missing> missing_values(const MeasureColumn& column) {
  std::vector<Missing> list;
  for (std::size_t element = 0; element < column.values.size(); ++element) {
    const auto* none = std::get_if<NotMeasured>(&column.values[element]);
    if (none == nullptr) continue;
    const auto same = std::find_if(
        list.begin(), list.end(), [&](const Missing& each) { return each.reason == none->reason; });
    if (same != list.end()) {
      ++same->count;
    } else if (list.size() < 16) {
      list.push_back({none->reason, element, 1});
    }
  }
  return list;
}

void write_missing(Writer& writer, const Measurements& measurements, MeasureScope scope) {
  for (const MeasureColumn& column : measurements.columns[static_cast<std::size_t>(scope)]) {
    for (const Missing& missing : missing_values(column)) {
      const MeasureReason& reason = measurements.reasons[missing.reason];
      writer.begin_object();
      writer.member("on", measure_scope_name(scope));
      if (scope != MeasureScope::asset) {
        write_element(writer, measurements, scope, missing.first);
      }
      writer.member("measure", column.measure->name);
      writer.member("reason", reason.text);
      writer.member("fault", reason.fault);
      if (missing.count > 1) writer.member("count", missing.count);
      writer.end_object();
    }
  }
}

}  // namespace

void write_measurements(Writer& writer, const Measurements& measurements) {
  writer.key("measures");
  writer.begin_object();
  for (std::size_t scope = 0; scope < kMeasureScopeCount; ++scope) {
    write_scope(writer, measurements, static_cast<MeasureScope>(scope));
  }
  writer.end_object();
  writer.key("unmeasured");
  writer.begin_array();
  for (std::size_t scope = 0; scope < kMeasureScopeCount; ++scope) {
    write_missing(writer, measurements, static_cast<MeasureScope>(scope));
  }
  writer.end_array();
}

}  // namespace gltfx::report
