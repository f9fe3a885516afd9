// SPDX-License-Identifier: Apache-2.0
/// From bytes to lines and columns, and the excerpt of a line that a person is shown.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <gltfx/diagnostic.hpp>

#include "base/span.hpp"

namespace gltfx::json {

/// Finds lines of one text: builds an index of line starts once (one vectorised pass), answers
/// in logarithmic time. The text must outlive it. Lines end at "\n", "\r\n" or "\r".
class LineIndex {
 public:
  explicit LineIndex(std::string_view text);

  /// Line and column of both ends of a span; `base` is added to the byte offset (the start of a
  /// GLB's JSON chunk).
  Location locate(Span span, std::uint64_t base = 0) const;

  /// The line on which `span` begins, cut to about `width` code points around it, with the marked
  /// part. A span over several lines is marked to the end of its first.
  Excerpt excerpt(Span span, std::size_t width = 100) const;

 private:
  std::string_view line_text(std::size_t line) const;
  std::size_t line_of(std::uint32_t byte) const;
  std::string_view text_;
  std::vector<std::uint32_t> starts_;
};

}  // namespace gltfx::json
