// SPDX-License-Identifier: Apache-2.0
/// Prints changes as text, JSON and Markdown.
#pragma once

#include <gltfx/compare.hpp>

#include <cstdint>
#include <string>

#include "json/writer.hpp"
#include "terminal.hpp"

namespace gltfx::tool {

/// Numbers of a run.
struct CompareSummary {
  std::uint64_t pairs = 0, unproven = 0, unreadable = 0;
  std::uint64_t levels[4] = {0, 0, 0, 0};  ///< by CompareLevel
  bool allowed = true;

  void add(const CompareReport& report, CompareLevel allow);
};

/// "differs: 2 changes". Printable.
std::string compare_headline(const CompareReport& report);

/// All lines of a pair; at most `most` changes, 0: all. Neutralised; ends in a line break.
std::string compare_text(const CompareReport& report, std::size_t most, const Style& style);

using WriteComparePicture = void (*)(json::Writer& writer, const ComparePicture& picture);
/// The names of its files, and what it shows.
void write_picture_names(json::Writer& writer, const ComparePicture& picture);
/// Members of an object: what a picture shows.
void write_picture_verdict(json::Writer& writer, const ComparePicture& picture);

void write_compare_pair(json::Writer& writer, const CompareReport& report,
                        WriteComparePicture write_picture = write_picture_names);
void write_compare_summary(json::Writer& writer, const CompareSummary& summary);

/// A section for a comment on a pull request; at most `budget` bytes, or empty if there is no room.
/// Names are escaped. `picture_url`: the prefix of links to pictures.
std::string compare_markdown(const CompareReport& report, std::size_t budget,
                             const std::string& picture_url);

}  // namespace gltfx::tool
