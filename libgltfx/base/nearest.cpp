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

// What is left where neither case nor '_' count: "base_color_factor" is "baseColorFactor".
std::string letters_of(std::string_view word) {
  std::string letters = lower_case(word);
  letters.erase(std::remove(letters.begin(), letters.end(), '_'), letters.end());
  return letters;
}

// Farther words are a guess.
constexpr std::size_t kMostEdits = 2;

// Whether one of the words is the other one's beginning, as of "MASKED".
bool begins(std::string_view a, std::string_view b) {
  const std::size_t length = std::min(a.size(), b.size());
  return length >= 3 && lower_case(a.substr(0, length)) == lower_case(b.substr(0, length));
}

// A third of the letters may be wrong, but no more than two; an ending may have two in any word.
std::size_t tolerance(std::string_view a, std::string_view b) {
  const std::size_t edits = begins(a, b) ? kMostEdits : std::min(a.size(), b.size()) / 3;
  return std::min(edits, kMostEdits) * kEdit;
}

// The only candidate of which the word is another spelling, or empty.
std::string_view only_other_spelling(std::string_view word,
                                     std::span<const std::string_view> candidates) {
  const std::string letters = letters_of(word);
  std::string_view found;
  for (const std::string_view candidate : candidates) {
    if (letters.empty() || candidate == found || letters_of(candidate) != letters) continue;
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
  return best.empty() ? only_other_spelling(word, candidates) : best;
}

}  // namespace gltfx
