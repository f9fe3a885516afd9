// SPDX-License-Identifier: Apache-2.0
/// Decides how an image is stored.
#pragma once

#include <gltfx/convert.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/origin.hpp"
#include "codec/client.hpp"
#include "container/bytes.hpp"
#include "image/foreign.hpp"
#include "image/header.hpp"
#include "steps/image_use.hpp"

namespace gltfx::steps {

/// Properties of an image file that are known without decoding.
struct ImageFile {
  container::Bytes bytes;
  std::optional<image::Format> format;
  std::optional<image::ForeignFormat> foreign;
  std::optional<image::Header> header;  ///< of `format`
  std::string media_type;               ///< empty: it has no name
  std::string name;                     ///< "PNG", "BMP"
  std::string problem;  ///< why it cannot be decoded, half a sentence; empty: it can
  bool broken = false;  ///< the problem is a defect of the file, not its format
  bool floats = false;  ///< its colors are unlimited
  bool cmyk = false;    ///< a JPEG of four inks, which glTF does not allow
  bool lossy = false;   ///< the format is lossy
};

ImageFile read_image_file(container::Bytes bytes);

/// One way to encode an image.
struct ImageAttempt {
  codec::TranscodeRequest request;
  image::Format format = image::Format::png;
  bool lossy = false;
  bool may_grow = false;  ///< accepted even if it is not smaller than the file
  bool may_reduce_bits = false;
  bool rgb = false;  ///< PNG with 8 bits per channel, in RGB or RGBA
};

/// Why an image with more than 8 bits per channel does not change its format, half a sentence.
std::string wide_reason(std::uint32_t bits);

/// Planned changes of an image, and reasons for the rest.
struct ImagePlan {
  std::vector<ImageAttempt> attempts;  ///< the first that succeeds is used
  std::vector<std::string> left;       ///< half sentences
  std::string refused;                 ///< half a sentence, or empty
  /// A format or a size is requested, not only a better compression where it is possible: a file
  /// that cannot be read or decoded is refused, not left.
  bool requested = false;
  bool color = false;  ///< textures of colors, which have 8 bits per channel, use it
};

/// What a target needs of an image.
enum class ImageRepair : std::uint8_t {
  none,
  core,  ///< PNG or JPEG
  rgb,   ///< PNG with 8 bits per channel, in RGB or RGBA
};

/// Properties of the asset that affect the plan.
struct ImageContext {
  const ConvertOptions& options;
  const ImageUse& use;
  bool allowed = true;  ///< glTF, or an extension in use, allows the format
  Origin origin = {};
  ImageRepair repair = ImageRepair::none;
};

/// Whether the options request anything of images with this use.
bool is_requested(const ConvertOptions& options, const ImageUse& use);

/// `find_obstacle` takes a media type and returns why the image cannot change to it, or an empty
/// string. The file must outlive the plan.
ImagePlan plan_image(const ImageFile& file, const ImageContext& context,
                     const std::function<std::string(std::string_view)>& find_obstacle);

/// "PNG", "WebP" and so on.
std::string_view format_name(image::Format format);

}  // namespace gltfx::steps
