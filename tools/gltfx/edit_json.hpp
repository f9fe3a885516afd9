// SPDX-License-Identifier: Apache-2.0
/// The JSON output of the verbs that change assets, apart from the members of each verb.
#pragma once

#include <gltfx/edited_file.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "json/writer.hpp"
#include "report/safe_text.hpp"

namespace gltfx::tool {

/// The start of the output.
std::string edit_json_begin();

/// Writes the members `path` to `written`, those of all verbs.
void write_outcome(json::Writer& writer, const EditOutcome& report);
/// Writes `writtenTo`, if there is such a path.
void write_place(json::Writer& writer, const EditOutcome& report);

/// One file; `first`: none was written before it. `write_members(writer)` writes the members of the
/// verb, between those of all verbs.
template <class WriteMembers>
std::string edit_json(const EditOutcome& report, bool first, const WriteMembers& write_members) {
  std::string out = first ? "\n" : ",\n";
  json::Writer writer(out);
  writer.begin_object();
  write_outcome(writer, report);
  write_members(writer);
  if (!report.diff.empty()) writer.member("diff", report.diff);
  writer.end_object();
  report::defuse_json(out, 0);
  return out;
}

/// The end of the output, with the totals of the run by their names.
std::string edit_json_end(const std::vector<std::pair<std::string_view, std::uint64_t>>& totals);

}  // namespace gltfx::tool
