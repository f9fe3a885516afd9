// SPDX-License-Identifier: Apache-2.0
#include "image/vk_format.hpp"

#include <algorithm>
#include <array>

namespace gltfx::image {
namespace {

// Formats of one layout, with consecutive numbers.
struct Run {
  std::uint32_t first;
  std::string_view layout;
  std::string_view types;  // separated by spaces
  std::uint32_t word_bits = 0;
};

constexpr std::string_view kIntegers = "UNORM SNORM USCALED SSCALED UINT SINT";
constexpr std::string_view kBytes = "UNORM SNORM USCALED SSCALED UINT SINT SRGB";
constexpr std::string_view kHalves = "UNORM SNORM USCALED SSCALED UINT SINT SFLOAT";
constexpr std::string_view kWords = "UINT SINT SFLOAT";
constexpr std::string_view kColors = "UNORM SRGB";

constexpr std::array kRuns = {
    Run{1, "R4G4", "UNORM", 8},
    Run{2, "R4G4B4A4", "UNORM", 16},
    Run{3, "B4G4R4A4", "UNORM", 16},
    Run{4, "R5G6B5", "UNORM", 16},
    Run{5, "B5G6R5", "UNORM", 16},
    Run{6, "R5G5B5A1", "UNORM", 16},
    Run{7, "B5G5R5A1", "UNORM", 16},
    Run{8, "A1R5G5B5", "UNORM", 16},
    Run{9, "R8", kBytes},
    Run{16, "R8G8", kBytes},
    Run{23, "R8G8B8", kBytes},
    Run{30, "B8G8R8", kBytes},
    Run{37, "R8G8B8A8", kBytes},
    Run{44, "B8G8R8A8", kBytes},
    Run{51, "A8B8G8R8", kBytes, 32},
    Run{58, "A2R10G10B10", kIntegers, 32},
    Run{64, "A2B10G10R10", kIntegers, 32},
    Run{70, "R16", kHalves},
    Run{77, "R16G16", kHalves},
    Run{84, "R16G16B16", kHalves},
    Run{91, "R16G16B16A16", kHalves},
    Run{98, "R32", kWords},
    Run{101, "R32G32", kWords},
    Run{104, "R32G32B32", kWords},
    Run{107, "R32G32B32A32", kWords},
    Run{110, "R64", kWords},
    Run{113, "R64G64", kWords},
    Run{116, "R64G64B64", kWords},
    Run{119, "R64G64B64A64", kWords},
    Run{122, "B10G11R11", "UFLOAT", 32},
    Run{123, "E5B9G9R9", "UFLOAT", 32},
    Run{124, "D16", "UNORM"},
    Run{125, "X8_D24", "UNORM", 32},
    Run{126, "D32", "SFLOAT"},
    Run{127, "S8", "UINT"},
    Run{128, "D16_UNORM_S8", "UINT"},
    Run{129, "D24_UNORM_S8", "UINT"},
    Run{130, "D32_SFLOAT_S8", "UINT"},
    Run{131, "BC1_RGB", kColors},
    Run{133, "BC1_RGBA", kColors},
    Run{135, "BC2", kColors},
    Run{137, "BC3", kColors},
    Run{139, "BC4", "UNORM SNORM"},
    Run{141, "BC5", "UNORM SNORM"},
    Run{143, "BC6H", "UFLOAT SFLOAT"},
    Run{145, "BC7", kColors},
    Run{147, "ETC2_R8G8B8", kColors},
    Run{149, "ETC2_R8G8B8A1", kColors},
    Run{151, "ETC2_R8G8B8A8", kColors},
    Run{153, "EAC_R11", "UNORM SNORM"},
    Run{155, "EAC_R11G11", "UNORM SNORM"},
    Run{157, "ASTC_4x4", kColors},
    Run{159, "ASTC_5x4", kColors},
    Run{161, "ASTC_5x5", kColors},
    Run{163, "ASTC_6x5", kColors},
    Run{165, "ASTC_6x6", kColors},
    Run{167, "ASTC_8x5", kColors},
    Run{169, "ASTC_8x6", kColors},
    Run{171, "ASTC_8x8", kColors},
    Run{173, "ASTC_10x5", kColors},
    Run{175, "ASTC_10x6", kColors},
    Run{177, "ASTC_10x8", kColors},
    Run{179, "ASTC_10x10", kColors},
    Run{181, "ASTC_12x10", kColors},
    Run{183, "ASTC_12x12", kColors},
    Run{1000066000, "ASTC_4x4", "SFLOAT"},
    Run{1000066001, "ASTC_5x4", "SFLOAT"},
    Run{1000066002, "ASTC_5x5", "SFLOAT"},
    Run{1000066003, "ASTC_6x5", "SFLOAT"},
    Run{1000066004, "ASTC_6x6", "SFLOAT"},
    Run{1000066005, "ASTC_8x5", "SFLOAT"},
    Run{1000066006, "ASTC_8x6", "SFLOAT"},
    Run{1000066007, "ASTC_8x8", "SFLOAT"},
    Run{1000066008, "ASTC_10x5", "SFLOAT"},
    Run{1000066009, "ASTC_10x6", "SFLOAT"},
    Run{1000066010, "ASTC_10x8", "SFLOAT"},
    Run{1000066011, "ASTC_10x10", "SFLOAT"},
    Run{1000066012, "ASTC_12x10", "SFLOAT"},
    Run{1000066013, "ASTC_12x12", "SFLOAT"},
    Run{1000340000, "A4R4G4B4", "UNORM", 16},
    Run{1000340001, "A4B4G4R4", "UNORM", 16},
};

// Word `index` of a list separated by spaces, or nothing.
std::optional<std::string_view> word(std::string_view list, std::uint32_t index) {
  for (; index > 0; --index) {
    const std::size_t space = list.find(' ');
    if (space == std::string_view::npos) return std::nullopt;
    list.remove_prefix(space + 1);
  }
  return list.substr(0, list.find(' '));
}

bool is_block_layout(std::string_view layout) {
  return layout.starts_with("BC") || layout.starts_with("ETC2_") || layout.starts_with("EAC_") ||
         layout.starts_with("ASTC_");
}

}  // namespace

std::string VkFormat::name() const {
  std::string text = std::string(layout) + '_' + std::string(type);
  if (block) text += "_BLOCK";
  if (word_bits != 0) text += "_PACK" + std::to_string(word_bits);
  return text;
}

std::optional<VkFormat> vk_format(std::uint32_t value) {
  const auto behind =
      std::upper_bound(kRuns.begin(), kRuns.end(), value,
                       [](std::uint32_t wanted, const Run& run) { return wanted < run.first; });
  if (behind == kRuns.begin()) return std::nullopt;
  const Run& run = *(behind - 1);
  const auto type = word(run.types, value - run.first);
  if (!type) return std::nullopt;
  return VkFormat{run.layout, *type, run.word_bits, is_block_layout(run.layout),
                  run.types.ends_with("SRGB")};
}

bool is_prohibited_vk_format(std::uint32_t value) {
  const std::optional<VkFormat> format = vk_format(value);
  if (format) return format->type.ends_with("SCALED");
  // Extensions 156 and 330 of Vulkan add texels of two or three planes, among others.
  struct Range {
    std::uint32_t first, last;
  };
  constexpr std::array kPlanes = {Range{1000156002, 1000156006}, Range{1000156012, 1000156016},
                                  Range{1000156022, 1000156026}, Range{1000156029, 1000156033},
                                  Range{1000330000, 1000330003}};
  return std::any_of(kPlanes.begin(), kPlanes.end(), [value](const Range& range) {
    return value >= range.first && value <= range.last;
  });
}

}  // namespace gltfx::image
