// SPDX-License-Identifier: Apache-2.0
/// The results of a run, as many as code-scanning services take.
#pragma once

#include <gltfx/report.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace gltfx::report {

/// Keeps the most severe results, of equal ones the first. Memory does not grow beyond them.
class SarifResults {
 public:
  /// GitHub refuses a run with more than 25,000 results and shows 5,000 of them.
  static constexpr std::size_t kMost = 5000;

  /// `write` appends the text of the result; it is not called for one that is not kept.
  void add(Severity severity, const std::function<void(std::string&)>& write);
  /// How many are left out, by severity.
  const Counts& left_out() const { return left_out_; }

  /// The results in the order in which they came, separated by commas, each on its own line.
  void write(std::string& out) const;

 private:
  struct Result {
    std::uint64_t number;
    std::string text;
  };
  std::array<std::vector<Result>, 4> results_;  ///< by severity
  std::size_t size_ = 0;                        ///< of all
  std::uint64_t met_ = 0;
  Counts left_out_;
};

}  // namespace gltfx::report
