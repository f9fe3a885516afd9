// SPDX-License-Identifier: Apache-2.0
/// Assets with materials and their images.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "codec/support/png_encoder.hpp"
#include "image/png_builder.hpp"
#include "model/packed_bytes.hpp"
#include "rules/selected.hpp"

namespace gltfx::test {

// --- Images that can be decoded; those for header checks have one texel ---

inline std::string grey_png(const std::string& texels = "\x80") {
  return encode_png({static_cast<std::uint32_t>(texels.size()), 1, PngColor::grey, 8, texels, {}});
}
inline std::string rgb_png(const std::string& texels = "\x10\x80\xF0") {
  return encode_png(
      {static_cast<std::uint32_t>(texels.size() / 3), 1, PngColor::rgb, 8, texels, {}});
}
inline std::string rgba_png(const std::string& texels = "\x10\x80\xF0\x40") {
  return encode_png(
      {static_cast<std::uint32_t>(texels.size() / 4), 1, PngColor::rgba, 8, texels, {}});
}
/// A palette of those colors, with the alphas of its first entries.
inline std::string palette_png(const std::string& colors, const std::string& alphas = {}) {
  std::string chunks = png_encoder::chunk("PLTE", colors);
  if (!alphas.empty()) chunks += png_encoder::chunk("tRNS", alphas);
  return encode_png({1, 1, PngColor::palette, 8, std::string(1, '\0'), chunks});
}
/// The header of a JPEG of 32 by 16 pixels.
inline std::string jpeg_header(char components = 3) { return whole_jpeg({}, components); }
/// The header of a WebP of 4 by 4 pixels, with or without alpha.
inline std::string webp_header(bool alpha) { return extended_webp(alpha ? '\x10' : '\0'); }

/// One material, its images, and further members of the asset.
struct Textured {
  std::string material;             ///< members of the material, or an object list "{...}, {...}"
  std::vector<std::string> images;  ///< texture i uses image i, unless `textures` is set
  std::string textures = {};        ///< objects
  std::string extensions = {};      ///< used ones: R"("KHR_a", "KHR_b")"
  std::string more = {};            ///< further members of the root, beginning with a comma

  static std::string type_of(const std::string& bytes) {
    if (bytes.starts_with("\xff\xd8")) return "image/jpeg";
    if (bytes.starts_with("RIFF")) return "image/webp";
    return bytes.starts_with("\xabKTX") ? "image/ktx2" : "image/png";
  }

  std::string text() const {
    std::string uris, own_textures;
    for (std::size_t i = 0; i < images.size(); ++i) {
      const char* const comma = i == 0 ? "" : ", ";
      uris += fmt::format(R"({}{{"uri": "data:{};base64,{}"}})", comma, type_of(images[i]),
                          base64(images[i]));
      own_textures += fmt::format(R"({}{{"source": {}}})", comma, i);
    }
    const std::string materials =
        material.starts_with("{") ? material : fmt::format("{{{}}}", material);
    std::string list = fmt::format(R"("materials": [{}], "textures": [{}], "images": [{}])",
                                   materials, textures.empty() ? own_textures : textures, uris);
    if (!extensions.empty()) list += fmt::format(R"(, "extensionsUsed": [{}])", extensions);
    return asset_with(list + more);
  }
};

/// The findings on slots, images and lobes, without those on unused objects.
inline Lines about_textures(const Textured& textured, Profile profile = Profile::standard,
                            PixelLevel pixels = PixelLevel::headers) {
  ValidateOptions options;
  options.profile = profile;
  options.pixels = pixels;
  options.ignore = {"UNUSED_OBJECT",    "IMAGE_NPOT_DIMENSIONS", "EXTENSION_UNUSED",
                    "EXTENSION_LEGACY", "EXTENSION_DRAFT",       "EXTENSION_ARCHIVED"};
  return verdict(textured.text(), options);
}

/// A base color texture, followed by further members.
inline std::string base_color(const std::string& more = {}) {
  return fmt::format(R"("pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0}}}}{})", more);
}

/// An extension of a material, after other members of it.
inline std::string extension(const std::string& name, const std::string& members,
                             const std::string& before = {}) {
  return fmt::format(R"({}"extensions": {{"{}": {{{}}}}})", before, name, members);
}

}  // namespace gltfx::test
