// SPDX-License-Identifier: Apache-2.0
/// Which bytes of a text lie on lines that changed.
#pragma once

#include <gltfx/validate.hpp>

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/span.hpp"

namespace gltfx::validate {

class ChangedLines {
 public:
  /// `lines` in any order; those behind the end of the text are none. Lines end as in
  /// json::LineIndex. Time is linear in the text.
  ChangedLines(const std::vector<LineRange>& lines, std::string_view text);

  /// Whether a place in the text touches one; what has no place (an empty span at 0) does when
  /// anything changed.
  bool touches(Span span) const;

 private:
  bool any_ = false;
  bool last_line_ = false;   ///< changed
  std::uint32_t size_ = 0;   ///< of the text
  std::vector<Span> spans_;  ///< sorted, apart from each other
};

}  // namespace gltfx::validate
