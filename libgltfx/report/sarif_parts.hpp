// SPDX-License-Identifier: Apache-2.0
/// Messages, levels, rules and results of SARIF, as many as code-scanning services take.
#pragma once

#include <gltfx/diagnostic.hpp>
#include <gltfx/report.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "json/writer.hpp"

namespace gltfx::report {

/// "error", "warning" or "note"; hints are notes.
std::string_view sarif_level(Severity severity);

/// A message object. The text is neutralised, and braces and links in it are escaped (sections
/// 3.11.5 and 3.11.6).
void write_sarif_message(json::Writer& writer, std::string_view text);

/// The rules that results of a run refer to, numbered in the order of their first result.
class SarifRules {
 public:
  /// `all` is sorted by code and has static storage.
  explicit SarifRules(std::span<const RuleDescription> all) : all_(all) {}

  /// The rule's position in the list. `severity` is that of the finding, which is used if the rule
  /// is unknown.
  std::uint64_t index_of(std::string_view code, Severity severity);

  /// The tool object with the rules so far.
  void write_tool(std::string& out) const;

 private:
  struct Met {
    std::string_view code;
    Severity severity;
  };
  void write_rule(json::Writer& writer, const Met& met) const;

  std::span<const RuleDescription> all_;
  std::vector<Met> met_;
  std::map<std::string_view, std::uint64_t> positions_;
};

/// Keeps the most severe results, and of equally severe ones the first. Memory does not grow beyond
/// them.
class SarifResults {
 public:
  /// GitHub refuses a run with more than 25,000 results and shows 5,000 of them.
  static constexpr std::size_t kMost = 5000;

  /// `write` appends the text of the result; it is not called for a result that is not kept.
  void add(Severity severity, const std::function<void(std::string&)>& write);
  /// Number of results that are left out, by severity.
  const Counts& left_out() const { return left_out_; }

  /// The results in their original order, separated by commas, each on its own line.
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
