// SPDX-License-Identifier: Apache-2.0
/// @file
/// A report as one web page that needs nothing else: no network, no other file.
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
  std::string uri;         ///< a data URI that a browser can show; empty: there is none
  std::uint32_t size = 0;  ///< pixels along each side
  std::string problem;     ///< one sentence where there is none; empty: none was requested
};

/// Everything that the page says of one asset. Owns its text.
struct PageAsset {
  FileReport report;                    ///< of the validation
  InspectReport inspection;             ///< what is in it
  PagePicture picture;                  ///< what it looks like
  std::optional<PagePicture> upgraded;  ///< where an upgrade changes the asset
  std::vector<std::string> targets;     ///< labels of those that it was checked for
};

/// What is on a page in addition to the assets.
struct PageOptions {
  std::string title;                       ///< plain text
  std::string profile, pixel_level;        ///< of the validation
  std::span<const RuleDescription> rules;  ///< all, sorted by code; static storage
  /// Of several, the page can be put together with those of the others by `gltfx merge`.
  Shard shard = {};
  std::optional<Severity> fail_on = Severity::error;  ///< of a shard; nothing: never
};

/// Calls: begin, asset for each in order, end. Each appends text to `out`, which the caller writes
/// and clears as it likes. The same bytes for the same assets. Text of assets is only in
/// one block of JSON, which no browser takes for markup. Not thread-safe.
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
