// SPDX-License-Identifier: Apache-2.0
/// The answer of a comparison as a comment on a pull request.
#pragma once

#include <gltfx/compare.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gltfx::tool {

/// Collects the pairs of a run. First come a line with totals and a table with what changed in each
/// asset, then a section for each of them, then the assets that are only stored differently. Names
/// are escaped: they make no markup, link or mention.
class CompareMarkdown {
 public:
  /// `picture_url`: the prefix of links to pictures. `pairs`: of the run; one has more room.
  CompareMarkdown(std::string picture_url, std::size_t pairs)
      : picture_url_(std::move(picture_url)), pairs_(pairs) {}

  /// `name`: what the pair is called.
  void add(const CompareReport& report, const std::string& name);
  /// At most 60,000 bytes: GitHub stops at 65,536 characters.
  std::string finish() const;

 private:
  /// What is said of a changed pair, in two lengths; all are empty if there was no room.
  struct Section {
    std::string summary;  ///< a row of the table of all
    std::string brief, full;
  };
  /// Of pairs, each in one of them.
  struct Counts {
    std::uint64_t levels[4] = {0, 0, 0, 0};  ///< by CompareLevel
    std::uint64_t added = 0, removed = 0, unread = 0;
  };

  void count(const CompareReport& report);
  std::string summary_table() const;
  std::string sections(std::size_t budget) const;

  const std::string picture_url_;
  const std::size_t pairs_;
  std::vector<Section> changed_;
  std::vector<std::string> stored_;  ///< rows of pairs that are only stored differently
  std::size_t collected_ = 0;        ///< bytes in both lists, without `full`
  std::size_t collected_in_full_ = 0;
  Counts count_;
};

}  // namespace gltfx::tool
