// SPDX-License-Identifier: Apache-2.0
/// @file
/// A report as one self-contained web page: no network, no other file.
#pragma once

#include <gltfx/inspect.hpp>
#include <gltfx/report.hpp>

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gltfx {

/// A picture of an asset, or why there is none.
struct PagePicture {
  std::string uri;         ///< a data URI that a browser can show; empty: no picture
  std::uint32_t size = 0;  ///< pixels along each side
  std::string problem;     ///< one sentence if there is no picture; empty: none was requested
};

/// Everything on the page about one asset. Owns its text.
struct PageAsset {
  FileReport report;                    ///< of the validation
  InspectReport inspection;             ///< its contents
  PagePicture picture;                  ///< its picture
  std::optional<PagePicture> upgraded;  ///< where an upgrade changes the asset
  std::vector<std::string> targets;     ///< labels of the targets that it was checked for
  /// Of an earlier run, whose values are shown beside those of the report; may be empty.
  std::vector<Requirement> previous;
};

/// What is on a page in addition to the assets.
struct PageOptions {
  std::string title;                       ///< plain text
  std::string profile, pixel_level;        ///< of the validation
  std::span<const RuleDescription> rules;  ///< all, sorted by code; static storage
  /// Part of a run in several shards, whose pages `gltfx merge` combines.
  Shard shard = {};
  std::optional<Severity> fail_on = Severity::error;  ///< of a shard; nothing: never
};

/// Calls: begin, asset for each asset in order, end. Each appends text to `out`, which the caller
/// writes and clears as it likes. The same bytes for the same assets. Text of assets is only in one
/// block of JSON, which no browser takes for markup. Not thread-safe.
class PageWriter {
 public:
  /// A writer of one page.
  explicit PageWriter(PageOptions options) : options_(std::move(options)) {}
  void begin(std::string& out) const;                           ///< before the first asset
  void asset(const PageAsset& asset, std::string& out);         ///< each asset
  void end(const RunSummary& summary, std::string& out) const;  ///< after the last one

 private:
  PageOptions options_;
  std::set<std::string_view> codes_;  ///< that findings have
  std::set<std::string> targets_;     ///< of the assets
  bool has_assets_ = false;
};

}  // namespace gltfx
