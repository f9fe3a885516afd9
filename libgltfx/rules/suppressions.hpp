// SPDX-License-Identifier: Apache-2.0
/// Findings that an asset itself suppresses, per object:
///
///     "extras": {"gltfx": {"ignore": [{"code": "UNUSED_OBJECT", "reason": "loaded by name"}]}}
///
/// on any object applies to findings on it and below it, at any severity. It is read only if the
/// user enables it (ValidateOptions::inline_suppressions): an untrusted asset must not suppress
/// findings about itself.
#pragma once

#include <gltfx/validate.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/json_pointer.hpp"
#include "base/sink.hpp"
#include "json/document.hpp"

namespace gltfx::validate {

/// The suppressions of one document. Phases that run at once may call it at once: each has its own
/// counts.
class Suppressions {
 public:
  static constexpr std::size_t kMostPhases = 8;

  Suppressions() = default;
  /// Reads the suppressions. The document, and `own`, which may be null, outlive this.
  explicit Suppressions(const json::Document& document, const OwnRules* own = nullptr);

  bool empty() const { return entries_.empty(); }
  /// Whether a finding at `path` is suppressed, counted for `phase` (below kMostPhases).
  bool covers(Code code, const Path& path, std::size_t phase, std::uint64_t count);
  /// Number of suppressed findings.
  std::uint64_t total() const;
  /// Reports entries that are malformed, have no reason or suppress nothing. Call it after all
  /// phases.
  void report(const ValidateOptions& options, Sink& sink) const;

 private:
  struct Entry {
    std::string host;   ///< pointer of the object
    std::string place;  ///< pointer of the entry
    json::NodeId node;
    std::optional<Code> code;  ///< nothing: an unknown code
    std::string problem;       ///< why it is malformed
    bool has_reason = false;
    std::array<std::uint64_t, kMostPhases> hits{};
    std::uint64_t total() const;
  };
  using Places = std::unordered_map<std::string, std::size_t>;

  void read(json::NodeId wish, const std::string& host);
  void read_entry(json::NodeId item, const std::string& host, std::string place);
  void report_entry(const Entry& entry, const ValidateOptions& options, Sink& sink) const;

  const json::Document* document_ = nullptr;
  const OwnRules* own_ = nullptr;
  std::vector<Entry> entries_;
  std::unordered_map<Code, Places> by_code_;  ///< code -> host -> entry
};

}  // namespace gltfx::validate
