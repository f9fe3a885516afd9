// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/text.hpp"

namespace gltfx {
namespace {

// Distances are counted in half edits, because a wrong case is half of one.
constexpr std::size_t kEdit = 2;
// Longer words are no misspelt names; the limit keeps the quadratic distance small.
constexpr std::size_t kLongestWord = 128;

std::size_t substitution(char a, char b) {
  if (a == b) return 0;
  return ascii_lower(a) == ascii_lower(b) ? kEdit / 2 : kEdit;
}

// Damerau-Levenshtein distance (optimal string alignment) over three rolling rows.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> above(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j * kEdit;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, above);
    std::swap(above, row);
    row[0] = i * kEdit;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min(
          {above[j] + kEdit, row[j - 1] + kEdit, above[j - 1] + substitution(a[i - 1], b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && a[i - 1] != b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + kEdit);
      }
    }
  }
  return row[b.size()];
}

bool is_same_but_for_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return ascii_lower(x) == ascii_lower(y); });
}

// A third of the letters may be wrong, or the case of all.
std::size_t tolerance(std::string_view a, std::string_view b) {
  const std::size_t length = std::min(a.size(), b.size());
  return is_same_but_for_case(a, b) ? length * (kEdit / 2) : length / 3 * kEdit;
}

// Shorter words begin too many others.
constexpr std::size_t kShortestBeginning = 3;

// Whether one of the words is the other one's beginning: "MASKED", "CUBIC".
bool begins(std::string_view a, std::string_view b) {
  const std::size_t length = std::min(a.size(), b.size());
  return length >= kShortestBeginning &&
         is_same_but_for_case(a.substr(0, length), b.substr(0, length));
}

// The only candidate that begins like the word, or empty.
std::string_view only_one_that_begins(std::string_view word,
                                      std::span<const std::string_view> candidates) {
  std::string_view found;
  for (const std::string_view candidate : candidates) {
    if (!begins(word, candidate) || candidate == found) continue;
    if (!found.empty()) return {};
    found = candidate;
  }
  return found;
}

}  // namespace

std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates) {
  std::string_view best;
  if (word.empty() || word.size() > kLongestWord) return best;
  std::size_t best_distance = SIZE_MAX;
  for (const std::string_view candidate : candidates) {
    const std::size_t allowed = tolerance(word, candidate);
    const std::size_t longer = std::max(word.size(), candidate.size());
    const std::size_t shorter = std::min(word.size(), candidate.size());
    if (candidate.empty() || (longer - shorter) * kEdit > allowed) continue;
    const std::size_t found = distance(word, candidate);
    if (found <= allowed && found < best_distance) {
      best = candidate;
      best_distance = found;
    }
  }
  return best.empty() ? only_one_that_begins(word, candidates) : best;
}

}  // namespace gltfx
