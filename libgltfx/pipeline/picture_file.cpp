// SPDX-License-Identifier: Apache-2.0
#include "pipeline/picture_file.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/replace_file.hpp"
#include "base/text.hpp"
#include "change/companions.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using codec::EncodedFormat;

constexpr std::array<std::pair<std::string_view, EncodedFormat>, 5> kEndings{
    {{".png", EncodedFormat::png},
     {".webp", EncodedFormat::webp},
     {".jpg", EncodedFormat::jpeg},
     {".jpeg", EncodedFormat::jpeg},
     {".exr", EncodedFormat::exr}}};
constexpr std::uint32_t kQuality = 92;  // JPEG; WebP loses nothing
// Of animations, which without loss are ten times as large.
constexpr std::uint32_t kAnimationQuality = 90;

Result<codec::EncodedImage> encoded(const codec::EncodeRequest& request) {
  auto result = codec::Client::shared().encode_image(request);
  if (auto* error = std::get_if<codec::DecodeError>(&result)) {
    return Error{"the picture cannot be encoded: " + error->message};
  }
  return std::get<codec::EncodedImage>(std::move(result));
}

bool is_empty_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(fs::symlink_status(path, error)) && fs::file_size(path, error) == 0 &&
         !error;
}

std::optional<Error> fill(const std::string& path, std::string_view bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (file) return std::nullopt;
  return Error{fmt::format("{} cannot be written", quoted(path, 200))};
}

}  // namespace

Result<EncodedFormat> picture_format(const std::string& path) {
  const std::string ending = ending_of(path);
  for (const auto& [name, format] : kEndings) {
    if (name == ending) return format;
  }
  return Error{
      fmt::format("{} does not end in .png, .webp, .jpg, .jpeg or .exr", quoted(path, 200))};
}

Result<EncodedFormat> output_format(const BakeOptions& options) {
  if (!options.format) return picture_format(options.output);
  switch (*options.format) {
    case BakeFormat::png:
      break;
    case BakeFormat::webp:
      return EncodedFormat::webp;
    case BakeFormat::jpeg:
      return EncodedFormat::jpeg;
    case BakeFormat::exr:
      return EncodedFormat::exr;
  }
  return EncodedFormat::png;
}

Result<EncodedFormat> output_format_of_bytes(const BakeOptions& options) {
  auto format = output_format(options);
  if (!format || !holds_floats(*format)) return format;
  return Error{"the picture has 8 bits for each channel, which OpenEXR does not hold"};
}

bool holds_floats(EncodedFormat format) { return format == EncodedFormat::exr; }

bool holds_alpha(EncodedFormat format) { return format != EncodedFormat::jpeg; }

Result<codec::EncodedImage> encode_picture(const preview::Picture& picture, EncodedFormat format) {
  codec::EncodeRequest request;
  request.format = format;
  request.raster = {picture.width, picture.height, picture.channels,
                    holds_floats(format) ? 32U : 8U};
  request.quality = format == EncodedFormat::webp ? 0 : kQuality;
  request.pixels = holds_floats(format) ? std::as_bytes(std::span(picture.floats))
                                        : std::as_bytes(std::span(picture.bytes));
  return encoded(request);
}

Result<codec::EncodedImage> encode_animation(const preview::Picture& picture, std::uint32_t frames,
                                             double fps) {
  codec::EncodeRequest request;
  request.format = EncodedFormat::webp;
  request.raster = {picture.width, picture.height, picture.channels, 8};
  request.quality = kAnimationQuality;
  request.options.frames = frames;
  request.options.frame_microseconds = static_cast<std::uint32_t>(std::lround(1e6 / fps));
  request.pixels = std::as_bytes(std::span(picture.bytes));
  return encoded(request);
}

Result<std::string> encode_png(const preview::Picture& picture) {
  const auto image = encode_picture(picture, EncodedFormat::png);
  if (!image) return image.error();
  return std::string(reinterpret_cast<const char*>(image->bytes.data()), image->bytes.size());
}

std::optional<Error> write_picture(const preview::Picture& picture, const std::string& path) {
  const auto format = picture_format(path);
  if (!format) return format.error();
  const auto image = encode_picture(picture, *format);
  if (!image) return image.error();
  return write_image(*image, path);
}

std::optional<Error> write_image(const codec::EncodedImage& image, const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty()) {
    if (auto trouble = change::make_folder(folder)) return trouble;
  }
  const auto* text = reinterpret_cast<const char*>(image.bytes.data());
  const std::string_view bytes(text, image.bytes.size());
  return is_empty_file(path) ? fill(path, bytes) : write_file(path, bytes);
}

}  // namespace gltfx
