// SPDX-License-Identifier: Apache-2.0
/// The texels of Vulkan's formats, from their names.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gltfx::image {

/// A format of Vulkan by the parts of its name: A2R10G10B10_UNORM_PACK32 has the layout
/// "A2R10G10B10", the type "UNORM", and words of 32 bits. Texts are static.
struct VkFormat {
  std::string_view layout;
  std::string_view type;
  std::uint32_t word_bits = 0;  ///< of a packed format
  bool block = false;           ///< its name ends in BLOCK
  bool has_srgb_variant = false;

  std::string name() const;
  bool is_srgb() const { return type == "SRGB"; }
};

/// The format with a number, or nothing if the number is unknown.
std::optional<VkFormat> vk_format(std::uint32_t value);

/// Whether KTX 2.0 forbids a format of Vulkan (section 3.2): scaled numbers and several planes.
bool is_prohibited_vk_format(std::uint32_t value);

}  // namespace gltfx::image
