// SPDX-License-Identifier: Apache-2.0
/// A baseline is a list of accepted findings: those in it are not reported again, further ones are.
/// It is kept under version control, so it is sorted, has one finding per line and contains nothing
/// that an unrelated edit changes: no line, no array index.
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

/// How often each finding is in the baseline or was found.
using FindingCounts = std::map<FindingKey, std::uint64_t>;

/// Immutable; any number of threads may apply one.
class Baseline {
 public:
  /// Reads the text of a BaselineWriter. Entries of one key add up, as after a merge of branches.
  static Result<Baseline> parse(std::string_view text);

  /// Removes the known findings from a report and its counts, the mildest ones of a key first, and
  /// adds their number to `suppressed`.
  /// If a folded finding is known in part, the rest stays, with a remark that it is unknown which
  /// ones are new. A file that could not be read is reported in any case.
  void apply(FileReport& report) const;

 private:
  FindingCounts known_;
};

/// Collects reports and writes their baseline.
class BaselineWriter {
 public:
  /// Files that could not be read are left out.
  void add(const FileReport& report);
  /// The file's text; the same findings give the same bytes, in any order.
  std::string text() const;

 private:
  FindingCounts counts_;
};

}  // namespace gltfx::report
