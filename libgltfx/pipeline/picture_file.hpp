// SPDX-License-Identifier: Apache-2.0
/// Pictures as files, encoded by a worker process.
#pragma once

#include <gltfx/bake.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "codec/client.hpp"
#include "preview/picture.hpp"

namespace gltfx {

/// The format that the ending of a path asks for; an Error names those that there are.
Result<codec::EncodedFormat> picture_format(const std::string& path);

/// The format of the pictures at `output`; an Error where nothing says it.
Result<codec::EncodedFormat> output_format(const BakeOptions& options);

/// The same where they have 8 bits a channel.
Result<codec::EncodedFormat> output_format_of_bytes(const BakeOptions& options);

/// Whether a format holds floats instead of bytes.
bool holds_floats(codec::EncodedFormat format);
/// Whether it holds alpha.
bool holds_alpha(codec::EncodedFormat format);

/// The bytes of a file. Precondition: the picture has the numbers and channels that the format
/// holds.
Result<codec::EncodedImage> encode_picture(const preview::Picture& picture,
                                           codec::EncodedFormat format);

/// The same of an animation in WebP: the frames are one below the other in `picture`.
Result<codec::EncodedImage> encode_animation(const preview::Picture& picture, std::uint32_t frames,
                                             double fps);

/// The same of a PNG, as text.
Result<std::string> encode_png(const preview::Picture& picture);

/// Writes a file, whole or not at all. An empty file is filled instead of replaced: those who have
/// it open, as thumbnailing services do, then read the picture. Makes the folder.
std::optional<Error> write_image(const codec::EncodedImage& image, const std::string& path);

/// Encodes by the ending of `path`, and writes.
std::optional<Error> write_picture(const preview::Picture& picture, const std::string& path);

}  // namespace gltfx
