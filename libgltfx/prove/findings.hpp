// SPDX-License-Identifier: Apache-2.0
/// Whether a draft has findings that the asset had not. What makes an asset worse is the same for
/// all verbs: of some code there are more findings of a severity, or louder, than before.
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
class FindingCounts {
 public:
  FindingCounts() = default;
  explicit FindingCounts(const FileReport& report);

 private:
  friend std::vector<struct MoreFindings> more_findings(const FindingCounts& before,
                                                        const FileReport& after, Severity least);
  /// By severity, those that are so loud or louder.
  using Counts = std::array<std::uint64_t, 4>;
  std::map<std::string_view, Counts> codes_;
};

/// A code of which a draft has more findings.
struct MoreFindings {
  std::string_view code;
  Severity severity = Severity::error;  ///< the loudest of which, and louder, there are more
  std::uint64_t count = 0;              ///< how many more
};

/// By code. Those that are quieter than `least` do not count.
std::vector<MoreFindings> more_findings(const FindingCounts& before, const FileReport& after,
                                        Severity least = Severity::hint);

/// What an asset has that it had not, or not as often, by codes.
struct NewFindings {
  std::string_view error;             ///< the code of an error; empty: there is none
  std::vector<std::string> warnings;  ///< one a code: "CODE at /pointer: message"
};

/// What `after` has that `before` has not, as default options judge. Where `before` was validated
/// with other options that is done anew, and not at all where nothing is wrong with `after`.
/// `schemas` are those that both were validated with.
NewFindings new_findings(const validate::ValidatedAsset& before,
                         const validate::ValidatedAsset& after,
                         const std::shared_ptr<const schema::Set>& schemas);

/// The same for an asset that is not validated yet, which happens if something is wrong with
/// `after`.
NewFindings new_findings(const model::OpenedAsset& before, const validate::ValidatedAsset& after,
                         const std::shared_ptr<const schema::Set>& schemas);

/// Default options for one of many files.
ValidateOptions default_validation(const std::shared_ptr<const schema::Set>& schemas);

}  // namespace gltfx::prove
