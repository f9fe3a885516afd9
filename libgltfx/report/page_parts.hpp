// SPDX-License-Identifier: Apache-2.0
/// Pages that hold a part of the assets each (PageOptions::shard), read back line by line and put
/// together: the result is the page that one run over all assets writes.
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

/// What stands before the assets, from the first byte of the page.
struct PageHead {
  std::string title, profile, pixel_level;
  Shard shard;
  std::optional<Severity> fail_on;  ///< nothing: never
};

/// One line.
struct PageLine {
  std::uint64_t position = 0;      ///< among the assets of all parts
  std::string path;                ///< of the asset
  std::string json;                ///< as a page of all assets has it
  std::vector<std::string> codes;  ///< of its findings
};

/// What stands behind the assets.
struct PageEnd {
  std::set<std::string> targets;
  RunSummary summary;  ///< as far as the page has it
};

/// How many bytes the text of read_page_head() has at least.
std::size_t least_page_head();
/// `text`: the lines up to the one before the first asset, without its line break. An Error when
/// they are not those of a part that this version wrote.
Result<PageHead> read_page_head(std::string_view text);

/// Without its line break.
bool is_page_end(std::string_view line);
Result<PageLine> read_page_line(std::string_view line);
/// `text`: all behind the line that is_page_end().
Result<PageEnd> read_page_end(std::string_view text);

/// The data behind the assets, and the rest of the page.
std::string page_tail(const std::set<std::string_view>& codes, const std::set<std::string>& targets,
                      std::span<const RuleDescription> rules, const RunSummary& summary);

}  // namespace gltfx::report
