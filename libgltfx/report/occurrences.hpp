// SPDX-License-Identifier: Apache-2.0
/// Findings one by one, for formats that track each from run to run.
#pragma once

#include <gltfx/report.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace gltfx::report {

/// Each finding of a report, followed by each repeat that was folded into it. Repeats that were not
/// kept stay in the `count` of the finding. The reference is valid during the call.
void for_each_occurrence(const FileReport& report,
                         const std::function<void(const Diagnostic&)>& consume);

/// Identifies a finding in its file across runs.
struct Identity {
  /// "CODE at /nodes/*/mesh ('Leaf')": array indices change when an element is inserted before,
  /// names do not. Neutralised; very long parts are cut.
  std::string text;
  std::uint64_t number = 1;  ///< among those of the file with this text, in the order of the report

  /// The text, with " #2" if there are several.
  std::string label() const;
};

/// The identities of one file's findings. Not thread-safe.
class Identities {
 public:
  /// Call once for each occurrence, in order.
  Identity next(const Diagnostic& finding);

 private:
  std::map<std::string, std::uint64_t, std::less<>> met_;
};

}  // namespace gltfx::report
