// SPDX-License-Identifier: Apache-2.0
/// Findings that an asset itself asks to leave out, object by object:
///
///     "extras": {"gltfx": {"ignore": [{"code": "UNUSED_OBJECT", "reason": "loaded by name"}]}}
///
/// on any object counts for findings on it and below it, whatever their severity. It is looked at
/// only when the user asks (ValidateOptions::inline_suppressions): an asset that nobody vouches for
/// shall not silence what is said about it.
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

/// The suppressions of one document. Phases that run at once may ask at once: each counts for
/// itself.
class Suppressions {
 public:
  static constexpr std::size_t kMostPhases = 8;

  Suppressions() = default;
  /// Reads them. The document outlives this.
  explicit Suppressions(const json::Document& document);

  bool empty() const { return entries_.empty(); }
  /// Whether a finding at `path` is left out, counted for `phase` (below kMostPhases).
  bool covers(Code code, const Path& path, std::size_t phase, std::uint64_t count);
  /// Findings left out.
  std::uint64_t total() const;
  /// Reports entries that are not understood, have no reason or left nothing out. For when all
  /// phases are done.
  void report(const ValidateOptions& options, Sink& sink) const;

 private:
  struct Entry {
    std::string host;   ///< pointer of the object
    std::string place;  ///< pointer of the entry itself
    json::NodeId node;
    std::optional<Code> code;  ///< nothing: none that is known
    std::string problem;       ///< why it is not understood
    bool has_reason = false;
    std::array<std::uint64_t, kMostPhases> hits{};
    std::uint64_t total() const;
  };
  using Places = std::unordered_map<std::string, std::size_t>;

  void read(json::NodeId wish, const std::string& host);
  void read_entry(json::NodeId item, const std::string& host, std::string place);
  void report_entry(const Entry& entry, const ValidateOptions& options, Sink& sink) const;

  const json::Document* document_ = nullptr;
  std::vector<Entry> entries_;
  std::unordered_map<Code, Places> by_code_;  ///< code -> host -> entry
};

}  // namespace gltfx::validate
