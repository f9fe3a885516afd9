// SPDX-License-Identifier: Apache-2.0
#include "image/features.hpp"

namespace gltfx::image {

std::vector<std::string_view> features_of(const Header& header) {
  std::vector<std::string_view> names;
  const auto add_if = [&](bool has, std::string_view name) {
    if (has) names.push_back(name);
  };
  const bool grey = header.channels == Channels::luminance;
  if (header.format == Format::jpeg) {
    add_if(grey, "image.jpeg-grayscale");
    add_if(header.interlaced, "image.jpeg-progressive");
    add_if(header.channels == Channels::rgba, "image.jpeg-cmyk");
  }
  if (header.format != Format::png) return names;
  add_if(header.bits == 16, "image.png-16-bit");
  add_if(header.interlaced, "image.png-interlaced");
  add_if(header.palette, "image.png-palette");
  add_if(header.palette && has_alpha(header.channels), "image.png-palette-transparent");
  add_if(!header.palette && grey, "image.png-grayscale");
  add_if(!header.palette && header.channels == Channels::luminance_alpha,
         "image.png-grayscale-alpha");
  return names;
}

}  // namespace gltfx::image
