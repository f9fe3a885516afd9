// SPDX-License-Identifier: Apache-2.0
/// Lines and columns of bytes, and excerpts of lines for people.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/span.hpp"

namespace gltfx::json {

/// Finds lines and columns of one text. One pass builds a small index (16 bytes for every 4 KiB) up
/// to `reach`; the time of a call then does not depend on the position, also in a text that is one
/// long line. The text must outlive the index. Lines end at "\n", "\r\n" or "\r". Thread-safe.
class LineIndex {
 public:
  /// Spans that are passed later must end at `reach` or before.
  explicit LineIndex(std::string_view text, std::size_t reach = SIZE_MAX);

  /// Line and column of both ends of a span; `base` is added to the byte offset (the start of a
  /// GLB's JSON chunk).
  Location locate(Span span, std::uint64_t base = 0) const;

  /// The line on which `span` begins, cut to about `width` code points around it, with the marked
  /// part. A span over several lines is marked to the end of its first.
  Excerpt excerpt(Span span, std::size_t width = 100) const;

 private:
  /// Counts of the text before a block.
  struct Block {
    std::uint32_t lines = 0;       ///< line ends
    std::uint32_t line_start = 0;  ///< first byte of the line that reaches into the block
    std::uint32_t code_points = 0;
    std::uint32_t pairs = 0;  ///< code points that take two UTF-16 code units
  };
  /// A byte's line, counted from 0, and where that line starts.
  struct Place {
    std::uint32_t line;
    std::uint32_t line_start;
  };
  bool ends_line(std::size_t byte) const;
  bool is_end_of_line(std::size_t byte) const;
  std::uint32_t count_line_ends(std::size_t begin, std::size_t end) const;
  std::uint32_t last_line_start(std::size_t byte) const;
  Place place_of(std::size_t byte) const;
  std::uint32_t code_points_before(std::size_t byte) const;
  std::uint32_t pairs_before(std::size_t byte) const;
  std::uint32_t column_of(std::size_t byte, std::size_t line_start) const;
  std::uint32_t pairs_between(std::size_t line_start, std::size_t byte) const;
  std::size_t back(std::size_t byte, std::size_t code_points, std::size_t first) const;
  std::size_t forward(std::size_t byte, std::size_t code_points) const;
  std::string_view slice(std::size_t begin, std::size_t end) const {
    return text_.substr(begin, end - begin);
  }
  std::string_view text_;
  std::vector<Block> blocks_;
};

}  // namespace gltfx::json
