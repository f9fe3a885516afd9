// SPDX-License-Identifier: Apache-2.0
// DejaVu Sans is embedded in the program, so that labels do not depend on installed fonts.
#include "preview/label_font.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/text.hpp"

// The font is trusted, and the library never aborts.
#define STBTT_assert(condition) static_cast<void>(0)
#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>

// GLTFX_FONT: the path of the font, in quotes.
asm(".pushsection .rodata\n"
    ".hidden gltfx_label_font\n"
    ".global gltfx_label_font\n"
    "gltfx_label_font: .incbin " GLTFX_FONT
    "\n"
    ".popsection\n");
extern "C" __attribute__((visibility("hidden"))) const unsigned char gltfx_label_font[];

namespace gltfx::preview {
namespace {

constexpr int kInk = 60;

/// Letters of one line.
class LabelLine {
 public:
  explicit LabelLine(std::string_view text) {
    stbtt_InitFont(&font_, gltfx_label_font, 0);
    scale_ = stbtt_ScaleForPixelHeight(&font_, kLabelHeight);
    letters_ = placed(glyphs_of(text));
  }

  /// Shortens a line that is too wide and ends it in dots; empties it if the dots do not fit.
  void shorten(double width) {
    if (this->width() <= width) return;
    const std::vector<int> dots = glyphs_of("...");
    const double dots_width = end_of(placed(dots));
    do {
      if (letters_.empty()) return;
      letters_.pop_back();
    } while (this->width() + dots_width > width);
    std::vector<int> glyphs;
    for (const Letter& letter : letters_) glyphs.push_back(letter.glyph);
    glyphs.insert(glyphs.end(), dots.begin(), dots.end());
    letters_ = placed(glyphs);
  }

  double width() const { return end_of(letters_); }

  /// `left` and `top` are those of the label's area; the line begins `indent` further to the right.
  void draw(Picture& picture, std::uint32_t left, std::uint32_t top, std::uint32_t width,
            double indent) const {
    int ascent = 0, descent = 0, gap = 0;
    stbtt_GetFontVMetrics(&font_, &ascent, &descent, &gap);
    const int base = static_cast<int>(std::lround(static_cast<float>(ascent) * scale_));
    for (const Letter& letter : letters_) {
      const double at = indent + pixels(letter.begin);
      const double whole = std::floor(at);
      int columns = 0, rows = 0, right = 0, down = 0;
      unsigned char* ink =
          stbtt_GetGlyphBitmapSubpixel(&font_, scale_, scale_, static_cast<float>(at - whole), 0,
                                       letter.glyph, &columns, &rows, &right, &down);
      const int x = static_cast<int>(whole) + right;
      for (int k = 0; k < columns * rows; ++k) {
        const int column = x + k % columns, row = base + down + k / columns;
        const bool inside = column >= 0 && column < static_cast<int>(width) && row >= 0 &&
                            row < static_cast<int>(kLabelHeight);
        if (inside) {
          blend(picture, left + static_cast<std::uint32_t>(column),
                top + static_cast<std::uint32_t>(row), ink[k]);
        }
      }
      stbtt_FreeBitmap(ink, nullptr);
    }
  }

 private:
  struct Letter {
    int glyph;
    std::int64_t begin, end;  ///< units of the font
  };

  std::vector<int> glyphs_of(std::string_view text) const {
    std::vector<int> glyphs;
    for (std::size_t at = 0; at < text.size();) {
      const CodePoint point = decode_utf8(text, at);
      at += point.size;
      glyphs.push_back(point.valid ? stbtt_FindGlyphIndex(&font_, static_cast<int>(point.value))
                                   : 0);
    }
    return glyphs;
  }

  // Letters side by side, with kerning.
  std::vector<Letter> placed(const std::vector<int>& glyphs) const {
    std::vector<Letter> letters;
    for (const int glyph : glyphs) {
      std::int64_t begin = 0;
      if (!letters.empty()) {
        const Letter& before = letters.back();
        begin = before.end + stbtt_GetGlyphKernAdvance(&font_, before.glyph, glyph);
      }
      int advance = 0, bearing = 0;
      stbtt_GetGlyphHMetrics(&font_, glyph, &advance, &bearing);
      letters.push_back({glyph, begin, begin + advance});
    }
    return letters;
  }

  double pixels(std::int64_t units) const {
    return static_cast<double>(units) * static_cast<double>(scale_);
  }
  double end_of(const std::vector<Letter>& letters) const {
    return letters.empty() ? 0 : pixels(letters.back().end);
  }

  static void blend(Picture& picture, std::uint32_t x, std::uint32_t y, int coverage) {
    std::uint8_t* texel = &picture.bytes[(std::size_t{y} * picture.width + x) * 3];
    for (int c = 0; c < 3; ++c) {
      texel[c] =
          static_cast<std::uint8_t>((texel[c] * (255 - coverage) + kInk * coverage + 127) / 255);
    }
  }

  stbtt_fontinfo font_{};
  float scale_ = 1;
  std::vector<Letter> letters_;
};

}  // namespace

void write_label(Picture& picture, std::string_view text, std::uint32_t left, std::uint32_t top,
                 std::uint32_t width) {
  LabelLine line(text);
  line.shorten(width);
  line.draw(picture, left, top, width, std::max((width - line.width()) / 2, 0.0));
}

}  // namespace gltfx::preview
