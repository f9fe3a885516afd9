// SPDX-License-Identifier: Apache-2.0
/// Whether a draft has findings that the asset did not have. All verbs have the same criterion for
/// a worse asset: for some code, there are more findings of a severity or above than before.
#pragma once

#include <gltfx/report.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rules/validated_asset.hpp"
#include "schema/set.hpp"

namespace gltfx::prove {

/// Numbers of findings by code. Codes live as long as the program.
class CodeCounts {
 public:
  explicit CodeCounts(const FileReport& report);

  /// Number of findings of a code with this severity or above.
  std::uint64_t of(std::string_view code, Severity least) const;

 private:
  friend std::vector<struct MoreFindings> more_findings(const CodeCounts& before,
                                                        const FileReport& after, Severity least);
  /// By severity: the findings of this severity or above.
  using Counts = std::array<std::uint64_t, 4>;
  std::map<std::string_view, Counts> codes_;
  bool has_errors_ = false;
};

/// A code with more findings in a draft.
struct MoreFindings {
  std::string_view code;
  Severity severity = Severity::error;  ///< the highest one with more findings of it or above
  std::uint64_t count = 0;              ///< number of additional findings
};

/// By code. Those that are quieter than `least` do not count; nor do hints, which describe what was
/// there before: a change may only have made it readable.
std::vector<MoreFindings> more_findings(const CodeCounts& before, const FileReport& after,
                                        Severity least = Severity::info);

/// Findings that an asset did not have before, or has more often now, by code.
struct NewFindings {
  std::string_view error;             ///< the code of an error; empty: no error
  std::vector<std::string> warnings;  ///< one per code: "CODE at /pointer: message"
};

/// Whether a finding that becomes an error is a new error.
enum class Louder : std::uint8_t {
  is_new,
  /// No. For drafts with decoded elements: a value is an error that is only a warning in a lossy
  /// stream, because there the encoder may have caused it.
  is_known,
};

/// Findings of `after` that `before` does not have, with default options. If `before` was validated
/// with other options, it is validated again, but only if `after` has findings. Both assets were
/// validated with `schemas`.
NewFindings new_findings(const validate::ValidatedAsset& before,
                         const validate::ValidatedAsset& after,
                         const std::shared_ptr<const schema::Set>& schemas);

/// The same for an asset that is not validated yet. It is validated if `after` has findings.
NewFindings new_findings(const model::OpenedAsset& before, const validate::ValidatedAsset& after,
                         const std::shared_ptr<const schema::Set>& schemas,
                         Louder louder = Louder::is_new);

}  // namespace gltfx::prove
