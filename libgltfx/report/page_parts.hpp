// SPDX-License-Identifier: Apache-2.0
/// Pages that hold a part of the assets each (PageOptions::shard), read back line by line and
/// combined: the result is the page that one run over all assets writes.
#pragma once

#include <gltfx/report.hpp>

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace gltfx::report {

/// The part before the assets, from the first byte of the page.
struct PageHead {
  std::string title, profile, pixel_level;
  Shard shard;
  std::optional<Severity> fail_on;  ///< nothing: never
};

/// The line of one asset.
struct PageLine {
  std::uint64_t position = 0;      ///< among the assets of all parts
  std::string path;                ///< of the asset
  std::string json;                ///< as in the page of all assets
  std::vector<std::string> codes;  ///< of its findings
};

/// The data after the assets.
struct PageEnd {
  std::set<std::string> targets;
  RunSummary summary;  ///< the members that the page has
};

/// Minimum size of the text for read_page_head(), in bytes.
std::size_t least_page_head();
/// `text`: the lines up to the one before the first asset, without its line break. An Error when
/// they are not from a page that this version wrote.
Result<PageHead> read_page_head(std::string_view text);

/// Without its line break.
bool is_page_end(std::string_view line);
Result<PageLine> read_page_line(std::string_view line);
/// `text`: everything after the line that is_page_end().
Result<PageEnd> read_page_end(std::string_view text);

/// The data after the assets, and the rest of the page.
std::string page_tail(const std::set<std::string_view>& codes, const std::set<std::string>& targets,
                      std::span<const RuleDescription> rules, const RunSummary& summary);

}  // namespace gltfx::report
