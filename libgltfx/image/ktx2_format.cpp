// SPDX-License-Identifier: Apache-2.0
// vkFormat of a KTX2 file against its data format descriptor, and typeSize against both (KTX 2.0
// sections 3.2, 3.3 and 3.10). The texels of a format follow from its name, as in the
// specification.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "image/ktx2_parts.hpp"
#include "image/vk_format.hpp"

namespace gltfx::image {
namespace {

// Color models of the Khronos Data Format Specification, section 5.6.
constexpr std::uint8_t kRgbsda = 1, kBc1a = 128, kBc7 = 134, kEtc2 = 161, kAstc = 162, kPvrtc = 164,
                       kPvrtc2 = 165;

// Whether all texels of a color model have formats in Vulkan.
bool is_known_to_vulkan(std::uint8_t model) {
  return (model >= kBc1a && model <= kBc7) || model == kEtc2 || model == kAstc || model == kPvrtc ||
         model == kPvrtc2;
}

// --- Names ---

// A component of an uncompressed texel.
struct Part {
  char letter = 0;
  std::uint32_t bits = 0;
  auto operator<=>(const Part&) const = default;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The number at `at`, which is moved past it.
std::uint32_t number(std::string_view text, std::size_t& at) {
  std::uint32_t value = 0;
  for (; at < text.size() && is_digit(text[at]); ++at) {
    value = value * 10 + static_cast<std::uint32_t>(text[at] - '0');
  }
  return value;
}

// The components of a layout such as "R5G6B5".
std::vector<Part> parts_of(std::string_view layout) {
  std::vector<Part> parts;
  for (std::size_t at = 0; at < layout.size();) {
    const char letter = layout[at++];
    if (letter != '_') parts.push_back({letter, number(layout, at)});
  }
  return parts;
}

bool is_depth_or_stencil(const VkFormat& format) {
  return !format.block && format.layout.find_first_of("DS") != std::string_view::npos;
}

bool is_combined(const VkFormat& format) {
  return format.layout.find("_S8") != std::string_view::npos;
}

// Section 3.3.
std::uint32_t type_size(const VkFormat& format) {
  if (format.block) return 1;
  if (format.word_bits != 0) return format.word_bits / 8;
  if (is_combined(format)) return format.layout.starts_with("D16") ? 2 : 4;
  return parts_of(format.layout).front().bits / 8;
}

// The texel blocks of a format, as a descriptor has them.
struct Blocks {
  std::uint8_t model = kRgbsda;
  std::uint32_t width = 1, height = 1;
  std::uint32_t bytes = 0;
};

Blocks blocks_of(const VkFormat& format) {
  const std::string_view layout = format.layout;
  if (layout.starts_with("BC")) {
    const auto number = static_cast<std::uint8_t>(layout[2] - '1');
    const bool small = number == 0 || number == 3;
    return {static_cast<std::uint8_t>(kBc1a + number), 4, 4, small ? 8U : 16U};
  }
  if (layout.starts_with("ASTC_")) {
    std::size_t at = 5;
    const std::uint32_t width = number(layout, at);
    return {kAstc, width, number(layout, ++at), 16};
  }
  if (format.block) {
    const bool large = layout.ends_with("A8") || layout.ends_with("G11");
    return {kEtc2, 4, 4, large ? 16U : 8U};
  }
  std::uint32_t bits = 0;
  for (const Part& part : parts_of(layout)) bits += part.bits;
  return {kRgbsda, 1, 1, bits / 8};
}

// --- Descriptors ---

char letter_of(std::uint8_t channel) {
  switch (channel) {
    case 0:
      return 'R';
    case 1:
      return 'G';
    case 2:
      return 'B';
    case 13:
      return 'S';
    case 14:
      return 'D';
    default:
      return channel == 15 ? 'A' : '?';
  }
}

std::vector<Part> parts_of(const std::vector<Ktx2Sample>& samples) {
  std::vector<Part> parts;
  for (const Ktx2Sample& sample : samples) {
    parts.push_back({letter_of(sample.channel), sample.bits});
  }
  return parts;
}

std::string text_of(const std::vector<Part>& parts) {
  std::string text;
  for (const Part& part : parts) text += fmt::format("{}{}", part.letter, part.bits);
  return text;
}

std::string_view model_name(Ktx2Model model) {
  switch (model) {
    case Ktx2Model::etc1s:
      return "ETC1S";
    case Ktx2Model::uastc:
      return "UASTC";
    case Ktx2Model::astc:
      return "ASTC";
    case Ktx2Model::other:
      break;
  }
  return {};
}

// "166 (UASTC)".
std::string model_text(const Ktx2Reading& reading) {
  const std::string_view name = model_name(reading.file.model);
  return name.empty() ? fmt::to_string(reading.color_model)
                      : fmt::format("{} ({})", reading.color_model, name);
}

// --- Names against descriptors ---

class FormatCheck {
 public:
  FormatCheck(Ktx2Reading& reading, const VkFormat& format) : reading_(reading), format_(format) {}

  void check() {
    const Ktx2& file = reading_.file;
    if (const std::uint32_t size = type_size(format_); file.type_size != size) {
      reading_.error(Code::KTX2_HEADER_INVALID, fmt::format("typeSize is {}; for {} it must be {}.",
                                                            file.type_size, format_.name(), size));
    }
    const Blocks blocks = blocks_of(format_);
    if (reading_.color_model != blocks.model) {
      return bad(fmt::format("colorModel of the descriptor is {}, not {}", model_text(reading_),
                             blocks.model));
    }
    if (!is_combined(format_)) check_blocks(blocks);
    check_samples();
    check_transfer();
  }

 private:
  std::string sentence(std::string_view problem) const {
    return fmt::format("vkFormat is {} ({}), but {}.", reading_.file.vk_format, format_.name(),
                       problem);
  }
  void bad(std::string_view problem) {
    reading_.error(Code::KTX2_FORMAT_MISMATCH, sentence(problem));
  }

  // Earlier editions of the specification wrote no bytes for supercompressed data.
  void check_blocks(const Blocks& blocks) {
    const std::array<std::uint8_t, 4>& block = reading_.file.block;
    const std::uint32_t width = block[0] + 1U, height = block[1] + 1U;
    if (width != blocks.width || height != blocks.height || block[2] != 0 || block[3] != 0) {
      return bad(fmt::format("the texel blocks of the descriptor are {}x{}", width, height));
    }
    const std::uint32_t bytes = reading_.plane_bytes[0];
    if (bytes != blocks.bytes && (bytes != 0 || reading_.has_scheme(Ktx2Scheme::none))) {
      bad(fmt::format("the texel blocks of the descriptor have {} bytes", bytes));
    }
  }

  void check_samples() {
    if (is_combined(format_) || format_.layout.starts_with("E5")) return;
    const std::vector<Ktx2Sample>& samples = reading_.samples;
    if (format_.layout.starts_with("ASTC_")) {
      const bool one = samples.size() == 1 && samples[0].channel == 0 && samples[0].bits == 128;
      if (!one) return bad("the descriptor does not have one sample of 128 bits");
    } else if (!format_.block) {
      std::vector<Part> wanted = parts_of(format_.layout), found = parts_of(samples);
      std::erase_if(wanted, [](const Part& part) { return part.letter == 'X'; });
      constexpr std::size_t kMaxShown = 8;
      const std::string text =
          found.size() <= kMaxShown ? text_of(found) : fmt::format("{} in number", found.size());
      std::sort(wanted.begin(), wanted.end());
      std::sort(found.begin(), found.end());
      if (wanted != found) return bad(fmt::format("the samples of the descriptor are {}", text));
    }
    check_type();
  }

  void check_type() {
    const std::string_view type = format_.type;
    const bool is_float = type.ends_with("FLOAT"),
               is_signed = type.starts_with("S") && !format_.is_srgb();
    for (const Ktx2Sample& sample : reading_.samples) {
      if (sample.is_float == is_float && sample.is_signed == is_signed) continue;
      return bad(fmt::format("the samples of the descriptor are {} {}",
                             sample.is_signed ? "signed" : "unsigned",
                             sample.is_float ? "floats" : "integers"));
    }
  }

  void check_transfer() {
    const Ktx2& file = reading_.file;
    const bool declared = file.transfer == kKtx2TransferSrgb;
    if (format_.is_srgb() && !declared) {
      bad(fmt::format("the transfer function of the descriptor is {}, not sRGB", file.transfer));
    } else if (declared && !format_.is_srgb() && format_.has_srgb_variant) {
      reading_.tolerated_error(
          Code::KTX2_FORMAT_MISMATCH,
          sentence(
              "the transfer function of the descriptor is sRGB, which has a different vkFormat"));
    }
    const bool plain = format_.type.ends_with("INT") || is_depth_or_stencil(format_);
    if (plain && (file.transfer != 0 || file.primaries != 0)) {
      reading_.tolerated_error(Code::KTX2_FORMAT_MISMATCH,
                               sentence("the descriptor declares a color space"));
    }
  }

  Ktx2Reading& reading_;
  const VkFormat& format_;
};

std::string named(std::uint32_t value) {
  const auto format = vk_format(value);
  return format ? fmt::format("{} ({})", value, format->name()) : fmt::to_string(value);
}

// UASTC and ETC1S, for which Vulkan has no formats.
void check_universal(Ktx2Reading& reading) {
  const Ktx2& file = reading.file;
  if (file.vk_format != 0) {
    reading.error(Code::KTX2_FORMAT_MISMATCH,
                  fmt::format("vkFormat is {}; for colorModel {} it must be 0.",
                              named(file.vk_format), model_text(reading)));
  }
  const bool vendor = file.scheme > static_cast<std::uint32_t>(Ktx2Scheme::zlib);
  const bool etc1s = file.model == Ktx2Model::etc1s;
  if (etc1s && !vendor && !reading.has_scheme(Ktx2Scheme::basis_lz)) {
    reading.error(Code::KTX2_HEADER_INVALID,
                  fmt::format("supercompressionScheme is {}; for ETC1S it must be 1 (BasisLZ).",
                              file.scheme));
  }
}

}  // namespace

void check_ktx2_format(Ktx2Reading& reading) {
  const Ktx2& file = reading.file;
  if (is_prohibited_vk_format(file.vk_format)) {
    return reading.error(
        Code::KTX2_HEADER_INVALID,
        fmt::format("vkFormat is {}, which KTX2 prohibits.", named(file.vk_format)));
  }
  if (!file.described) return;
  if (reading.has_scheme(Ktx2Scheme::basis_lz) && file.model != Ktx2Model::etc1s) {
    reading.error(Code::KTX2_HEADER_INVALID,
                  "supercompressionScheme is 1 (BasisLZ), but colorModel is not ETC1S.");
  }
  if (file.model == Ktx2Model::etc1s || file.model == Ktx2Model::uastc) {
    return check_universal(reading);
  }
  const auto format = vk_format(file.vk_format);
  if (format) return FormatCheck(reading, *format).check();
  if (file.vk_format == 0 && is_known_to_vulkan(reading.color_model)) {
    reading.error(
        Code::KTX2_FORMAT_MISMATCH,
        fmt::format("vkFormat is 0, but colorModel {} has a Vulkan format.", model_text(reading)));
  }
}

}  // namespace gltfx::image
