// SPDX-License-Identifier: Apache-2.0
/// Comparison of values with limits.
#pragma once

#include <gltfx/limit.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/pattern.hpp"

namespace gltfx::measure {

/// The pattern or words of a limit, prepared for many texts. The limit must outlive it.
class LimitTexts {
 public:
  explicit LimitTexts(const Limit& limit);

  /// Whether a text is within the limit. A pattern that does not compile accepts nothing.
  bool accepts(std::string_view text) const;

 private:
  bool is_listed(std::string_view text) const;

  const Limit& limit_;
  std::optional<schema::Pattern> pattern_;
  std::vector<std::string_view> words_;     // sorted
  std::vector<std::string_view> prefixes_;  // of words with '*'
};

/// Whether a value is within the limit, for all operators but unique. Precondition: it is a value
/// of the type of the measure.
bool holds(const Limit& limit, const LimitTexts& texts, const MeasureValue& value);

}  // namespace gltfx::measure
