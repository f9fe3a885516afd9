// SPDX-License-Identifier: Apache-2.0
#include "preview/contact_sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "preview/label_font.hpp"

namespace gltfx::preview {
namespace {

constexpr std::uint32_t kCell = 256;
constexpr std::uint32_t kWidest = 8192;  // pixels of the sheet, beyond which cells become smaller
constexpr std::uint32_t kWords = 96;     // narrowest cell that has a name below it
constexpr std::uint32_t kMargin = 4;     // around a name
constexpr std::uint8_t kPaper = 236;

// The mean of the part of a picture that one pixel of the sheet covers, on a paper background.
std::array<std::uint8_t, 3> covered(const BakedPixels& from, double left, double top, double step) {
  const auto at = [](double value, std::uint32_t limit) {
    return std::min(static_cast<std::uint32_t>(std::max(value, 0.0)), limit - 1);
  };
  const std::uint32_t x1 = at(std::ceil(left + step) - 1, from.width);
  const std::uint32_t y1 = at(std::ceil(top + step) - 1, from.height);
  std::array<double, 3> sum{};
  double count = 0;
  for (std::uint32_t y = at(top, from.height); y <= y1; ++y) {
    for (std::uint32_t x = at(left, from.width); x <= x1; ++x) {
      const std::uint8_t* texel = &from.bytes[(std::size_t{y} * from.width + x) * from.channels];
      const double alpha = from.channels == 4 ? texel[3] / 255.0 : 1.0;
      for (std::size_t c = 0; c < 3; ++c) sum[c] += texel[c] * alpha + kPaper * (1 - alpha);
      ++count;
    }
  }
  return {static_cast<std::uint8_t>(sum[0] / count + 0.5),
          static_cast<std::uint8_t>(sum[1] / count + 0.5),
          static_cast<std::uint8_t>(sum[2] / count + 0.5)};
}

}  // namespace

ContactSheet::ContactSheet(std::size_t count, const BakeSize& size)
    : columns_(static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))))) {
  const std::uint32_t widest =
      std::clamp(static_cast<std::uint32_t>(kWidest / columns_), 16U, kCell);
  const double longer = std::max({size.width, size.height, 1U});
  const double scale = std::min(1.0, widest / longer);
  width_ = std::max(static_cast<std::uint32_t>(size.width * scale), 1U);
  height_ = std::max(static_cast<std::uint32_t>(size.height * scale), 1U);
  label_ = width_ < kWords ? 0 : kLabelHeight + 2 * kMargin;
  const std::size_t rows = (count + columns_ - 1) / columns_;
  picture_.width = static_cast<std::uint32_t>(columns_ * width_);
  picture_.height = static_cast<std::uint32_t>(rows * (height_ + label_));
  picture_.bytes.assign(std::size_t{picture_.width} * picture_.height * 3, kPaper);
}

void ContactSheet::add(const BakedPixels& pixels, std::string_view name, std::string_view instead) {
  const auto left = static_cast<std::uint32_t>(next_ % columns_ * width_);
  const auto top = static_cast<std::uint32_t>(next_ / columns_ * (height_ + label_));
  ++next_;
  if (!pixels.bytes.empty()) {
    place(pixels, left, top);
  } else if (height_ >= kLabelHeight) {
    write(instead, left, top + (height_ - kLabelHeight) / 2);
  }
  write(name, left, top + height_ + kMargin);
}

// Cells that are too narrow for words have none.
void ContactSheet::write(std::string_view words, std::uint32_t left, std::uint32_t top) {
  if (label_ > 0) write_label(picture_, words, left + kMargin, top, width_ - 2 * kMargin);
}

void ContactSheet::place(const BakedPixels& pixels, std::uint32_t left, std::uint32_t top) {
  const double step = std::max(static_cast<double>(pixels.width) / width_,
                               static_cast<double>(pixels.height) / height_);
  const auto width = std::clamp(static_cast<std::uint32_t>(pixels.width / step), 1U, width_);
  const auto height = std::clamp(static_cast<std::uint32_t>(pixels.height / step), 1U, height_);
  left += (width_ - width) / 2;
  top += (height_ - height) / 2;
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const auto color = covered(pixels, x * step, y * step, step);
      const std::size_t at = (std::size_t{top + y} * picture_.width + left + x) * 3;
      std::copy(color.begin(), color.end(),
                picture_.bytes.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }
}

Picture ContactSheet::take() { return std::move(picture_); }

std::vector<std::string> sheet_labels(const std::vector<std::string>& paths) {
  namespace fs = std::filesystem;
  std::vector<fs::path> folders;  // remaining folders above each label
  std::vector<std::string> labels;
  for (const std::string& path : paths) {
    const fs::path normal = fs::path(path).lexically_normal();
    folders.push_back(normal.parent_path());
    labels.push_back(normal.stem().native());
  }
  for (bool longer = true; longer;) {
    longer = false;
    std::map<std::string, std::size_t> uses;
    for (const std::string& label : labels) ++uses[label];
    for (std::size_t i = 0; i < paths.size(); ++i) {
      if (uses[labels[i]] == 1 || !folders[i].has_filename()) continue;
      labels[i] = folders[i].filename().native() + "/" + labels[i];
      folders[i] = folders[i].parent_path();
      longer = true;
    }
  }
  std::map<std::string, std::size_t> uses;
  for (const std::string& label : labels) ++uses[label];
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (uses[labels[i]] > 1) labels[i] += fs::path(paths[i]).extension().native();
  }
  return labels;
}

}  // namespace gltfx::preview
