// SPDX-License-Identifier: Apache-2.0
/// A baseline is the list of findings a team has agreed to live with for now: what is on it is not
/// reported again, what comes on top is. It is kept under version control, so it is sorted, has one
/// finding a line and names nothing that an unrelated edit moves: no line, no array index.
///
///     {
///       "gltfx-baseline": 1,
///       "findings": [
///         {"path": "a.gltf", "code": "UNUSED_OBJECT", "pointer": "/nodes/*", "count": 2}
///       ]
///     }
#pragma once

#include <gltfx/report.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>

#include "base/result.hpp"

namespace gltfx::report {

/// Path (without "./" and the like), code, and pointer with '*' for array indices. Valid UTF-8.
using FindingKey = std::tuple<std::string, std::string, std::string>;

/// How often each finding is known or was met.
using FindingCounts = std::map<FindingKey, std::uint64_t>;

/// Immutable; any number of threads may apply one.
class Baseline {
 public:
  /// Reads what BaselineWriter wrote. Entries of one key add up, as after a merge of branches.
  static Result<Baseline> parse(std::string_view text);

  /// Takes the known findings out of a report and its counts and adds their number to
  /// `suppressed`. Of a folded finding that is known in part, the rest stays, with a remark that it
  /// is not known which ones are new. A file that could not be read is reported in any case.
  void apply(FileReport& report) const;

 private:
  FindingCounts known_;
};

/// Collects reports and writes their baseline.
class BaselineWriter {
 public:
  /// Files that could not be read are left out.
  void add(const FileReport& report);
  /// The file's text; the same findings give the same bytes, in whatever order they came.
  std::string text() const;

 private:
  FindingCounts counts_;
};

}  // namespace gltfx::report
