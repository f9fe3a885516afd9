// SPDX-License-Identifier: Apache-2.0
#include "prove/text.hpp"

#include <algorithm>

namespace gltfx::prove {
namespace {

std::size_t common_length(std::string_view a, std::string_view b) {
  const std::size_t length = std::min(a.size(), b.size());
  return static_cast<std::size_t>(
      std::mismatch(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(length), b.begin()).first -
      a.begin());
}

}  // namespace

std::optional<std::size_t> find_unedited_change(std::string_view before, std::string_view after,
                                                std::span<const json::Edit> edits) {
  std::size_t at = 0;
  const auto follow = [&](std::size_t end) -> std::optional<std::size_t> {
    const std::string_view kept = before.substr(at, end - at);
    const std::size_t same = common_length(kept, after);
    if (same < kept.size()) return at + same;
    after.remove_prefix(kept.size());
    at = end;
    return std::nullopt;
  };
  for (const json::Edit& edit : edits) {
    const auto [begin, end] = edit.span;
    if (begin < at || end < begin || end > before.size()) return at;
    if (const auto change = follow(begin)) return change;
    if (!after.starts_with(edit.text)) return at;
    after.remove_prefix(edit.text.size());
    at = end;
  }
  if (const auto change = follow(before.size())) return change;
  return after.empty() ? std::nullopt : std::optional(before.size());
}

}  // namespace gltfx::prove
