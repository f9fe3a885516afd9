// SPDX-License-Identifier: Apache-2.0
#include "pipeline/label_font.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace gltfx {
namespace {

constexpr std::uint32_t kScale = 2;
constexpr std::uint32_t kRows = kLabelHeight / kScale;
constexpr std::uint32_t kSpace = 3;  // columns
constexpr std::uint8_t kInk = 60;

struct Glyph {
  char letter;
  std::string_view rows;  // five pixels each, as a digit from 0 to V; the leftmost counts 16
};

constexpr std::string_view kBox = "VHHHHHV00";
constexpr std::array<Glyph, 74> kGlyphs{{
    {'a', "00E1FHF00"}, {'b', "GGUHHHU00"},  {'c', "00FGGGF00"}, {'d', "11FHHHF00"},
    {'e', "00EHVGE00"}, {'f', "698S88800"},  {'g', "00FHHHF1E"}, {'h', "GGUHHHH00"},
    {'i', "40C444E00"}, {'j', "2062222IC"},  {'k', "GGIKOKI00"}, {'l', "C44444E00"},
    {'m', "00QLLLL00"}, {'n', "00UHHHH00"},  {'o', "00EHHHE00"}, {'p', "00UHHHUGG"},
    {'q', "00FHHHF11"}, {'r', "00MPGGG00"},  {'s', "00FGE1U00"}, {'t', "88S889600"},
    {'u', "00HHHHF00"}, {'v', "00HHHA400"},  {'w', "00HHLLA00"}, {'x', "00HA4AH00"},
    {'y', "00HHHHF1E"}, {'z', "00V248V00"},  {'A', "EHHVHHH00"}, {'B', "UHHUHHU00"},
    {'C', "EHGGGHE00"}, {'D', "UHHHHHU00"},  {'E', "VGGUGGV00"}, {'F', "VGGUGGG00"},
    {'G', "EHGNHHF00"}, {'H', "HHHVHHH00"},  {'I', "E44444E00"}, {'J', "72222IC00"},
    {'K', "HIKOKIH00"}, {'L', "GGGGGGV00"},  {'M', "HRLLHHH00"}, {'N', "HHPLJHH00"},
    {'O', "EHHHHHE00"}, {'P', "UHHUGGG00"},  {'Q', "EHHHLID00"}, {'R', "UHHUKIH00"},
    {'S', "FGGE11U00"}, {'T', "V44444400"},  {'U', "HHHHHHE00"}, {'V', "HHHHHA400"},
    {'W', "HHHLLLA00"}, {'X', "HHA4AHH00"},  {'Y', "HHA444400"}, {'Z', "V1248GV00"},
    {'0', "EHJLPHE00"}, {'1', "4C4444E00"},  {'2', "EH168GV00"}, {'3', "U11E11U00"},
    {'4', "26AIV2200"}, {'5', "VGU11HE00"},  {'6', "EGGUHHE00"}, {'7', "V12488800"},
    {'8', "EHHEHHE00"}, {'9', "EHHF11E00"},  {'-', "000E00000"}, {'_', "0000000V0"},
    {'.', "00000CC00"}, {',', "00000CC48"},  {'+', "044V44000"}, {'=', "00V0V0000"},
    {'(', "248884200"}, {')', "842224800"},  {'[', "E88888E00"}, {']', "E22222E00"},
    {'#', "AAVAVAA00"}, {'\'', "444000000"},
}};

std::string_view rows_of(char letter) {
  const auto found = std::find_if(kGlyphs.begin(), kGlyphs.end(),
                                  [letter](const Glyph& each) { return each.letter == letter; });
  return found != kGlyphs.end() ? found->rows : kBox;
}

constexpr std::uint32_t bits(char digit) {
  return static_cast<std::uint32_t>(digit <= '9' ? digit - '0' : digit - 'A' + 10);
}

/// A letter without the empty columns beside it.
struct Letter {
  std::string_view rows;
  std::uint32_t first = 0, columns = kSpace;
};

Letter letter_of(char c) {
  if (c == ' ') return {};
  Letter letter{rows_of(c)};
  std::uint32_t used = 0;
  for (const char row : letter.rows) used |= bits(row);
  while ((used & (16U >> letter.first)) == 0) ++letter.first;
  std::uint32_t last = 4;
  while ((used & (16U >> last)) == 0) --last;
  letter.columns = last - letter.first + 1;
  return letter;
}

// One letter for each character: bytes that go on with one do not count.
std::vector<Letter> letters_of(std::string_view text) {
  std::vector<Letter> letters;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) letters.push_back(letter_of(c));
  }
  return letters;
}

std::uint32_t width_of(const std::vector<Letter>& letters) {
  std::uint32_t columns = 0;
  for (const Letter& each : letters) columns += each.columns + 1;
  return columns * kScale;
}

void shorten(std::vector<Letter>& letters, std::uint32_t width) {
  if (width_of(letters) <= width) return;
  const std::vector<Letter> dots = letters_of("...");
  while (!letters.empty() && width_of(letters) + width_of(dots) > width) letters.pop_back();
  if (width_of(dots) <= width) letters.insert(letters.end(), dots.begin(), dots.end());
}

void draw(bake::Picture& picture, const Letter& letter, std::uint32_t left, std::uint32_t top) {
  for (std::uint32_t y = 0; y < kRows * kScale && !letter.rows.empty(); ++y) {
    const std::uint32_t row = bits(letter.rows[y / kScale]);
    for (std::uint32_t x = 0; x < letter.columns * kScale; ++x) {
      if ((row & (16U >> (letter.first + x / kScale))) == 0) continue;
      const std::size_t at = (std::size_t{top + y} * picture.width + left + x) * 3;
      std::fill_n(picture.bytes.begin() + static_cast<std::ptrdiff_t>(at), 3, kInk);
    }
  }
}

}  // namespace

void write_label(bake::Picture& picture, std::string_view text, std::uint32_t left,
                 std::uint32_t top, std::uint32_t width) {
  std::vector<Letter> letters = letters_of(text);
  shorten(letters, width);
  std::uint32_t x = left + (width - width_of(letters)) / 2;
  for (const Letter& each : letters) {
    draw(picture, each, x, top);
    x += (each.columns + 1) * kScale;
  }
}

}  // namespace gltfx
