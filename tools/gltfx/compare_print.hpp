// SPDX-License-Identifier: Apache-2.0
/// Prints changes as text and JSON.
#pragma once

#include <gltfx/compare.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

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

/// "old.glb -> new.glb", or the only path. Printable.
std::string pair_name(const CompareReport& report);
/// "/nodes/4/scale", "+ /nodes/7", "/nodes/4 -> /nodes/5".
std::string place_of(const Change& change);
/// "'Door' moved by 0.1 along x", without its measure.
std::string sentence_of(const Change& change);
/// " (position 0.2%, bound 0.01%)"
std::string measure_of(const CompareMeasure& measure, bool with_bound);
/// "2 node.moved, 1 node.added", the most frequent first.
std::string kinds_of(const CompareReport& report);
/// "files 1.20 MB -> 400 kB (-67 %)"
std::string size_row(const CompareSize& size);
/// What is stored differently, with sizes: of other changes only where the files are larger or
/// smaller by a hundredth.
std::vector<std::string> storage_rows(const CompareReport& report);
/// "external asset of hall.gltf, lobby.gltf and 3 more"
std::string parents_of(const CompareReport& report);

/// "differs: 2 node.moved". Printable.
std::string compare_headline(const CompareReport& report);

/// All lines of a pair; at most `most` changes, 0: all. Neutralised; ends in a line break.
std::string compare_text(const CompareReport& report, std::size_t most, const Style& style);

using WriteComparePicture = std::function<void(json::Writer&, const ComparePicture&)>;
/// The names of its files, and what it shows.
void write_picture_names(json::Writer& writer, const ComparePicture& picture);
/// Members of an object: what a picture shows.
void write_picture_verdict(json::Writer& writer, const ComparePicture& picture);

void write_compare_pair(json::Writer& writer, const CompareReport& report,
                        const WriteComparePicture& write_picture = write_picture_names);
void write_compare_summary(json::Writer& writer, const CompareSummary& summary);

}  // namespace gltfx::tool
