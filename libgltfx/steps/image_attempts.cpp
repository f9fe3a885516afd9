// SPDX-License-Identifier: Apache-2.0
#include "steps/image_attempts.hpp"

#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/text.hpp"
#include "image/gpu_memory.hpp"
#include "model/image_codec.hpp"

namespace gltfx::steps {

double bound_of(const ImageAttempt& attempt, const codec::Raster& source) {
  if (attempt.request.options.near_lossless == 100) return 0;
  constexpr double kNearlyLossless = 2;
  constexpr double kRounding = 0.5;
  return kNearlyLossless + (source.bits > 8 ? kRounding : 0);
}

namespace {

// A defect of the image refuses a request, but not a better compression.
void take_defect(Job& job, std::string why) {
  if (job.plan.requested) {
    job.plan.refused = std::move(why);
  } else {
    job.plan.left.push_back(std::move(why));
  }
}

// Returns whether another format may be tried.
bool take_error(Job& job, const ImageAttempt& attempt, const codec::DecodeError& error) {
  std::string why = half_sentence(error.message);
  switch (error.kind) {
    case codec::ErrorKind::unsupported:
      job.plan.left.push_back(fmt::format("not {}: {}", format_name(attempt.format), why));
      return true;
    case codec::ErrorKind::malformed:
      take_defect(job, fmt::format("it cannot be decoded: {}", why));
      return false;
    default:
      if (!codec::depends_on_bytes_alone(error)) job.trouble = why;
      job.plan.refused = std::move(why);
      return false;
  }
}

// Whether a new file can replace the old one.
bool is_good(Job& job, const ImageAttempt& attempt, const codec::EncodedImage& image) {
  const std::string_view name = format_name(attempt.format);
  if (!attempt.may_grow && image.size >= job.file.bytes.size()) {
    if (job.file.format == attempt.format) return false;
    job.plan.left.push_back(fmt::format("as {} it would be larger", name));
    return false;
  }
  if (image.source.bits > image.raster.bits && !attempt.may_reduce_bits) {
    job.plan.left.push_back(fmt::format("not {}: {}", name, wide_reason(image.source.bits)));
    return false;
  }
  if (attempt.format == image::Format::png && image.raster.bits > 8 && job.plan.color &&
      !job.file.format) {
    job.plan.refused = fmt::format(
        "it has {} bits per channel, but textures of colors have 8 (--images jpeg or webp with "
        "--quality reduces them)",
        image.raster.bits);
    return false;
  }
  if (!attempt.lossy) return true;
  const double bound = bound_of(attempt, image.source);
  if (image.distance && (bound == 0 || image.distance->greatest <= bound)) return true;
  job.plan.left.push_back(fmt::format("as {} it would differ too much from the original", name));
  return false;
}

// Lossless WebP has no forms but RGB and RGBA with 8 bits per channel.
codec::EncodeResult transcode(const ImageAttempt& attempt, ImageEncodings& encodings) {
  if (!attempt.rgb) return encodings.transcode(attempt.request);
  codec::TranscodeRequest request = attempt.request;
  request.format = codec::EncodedFormat::webp;
  request.options = {};
  codec::EncodeResult plain = encodings.transcode(request);
  const auto* image = std::get_if<codec::EncodedImage>(&plain);
  if (image == nullptr) return plain;
  request = attempt.request;
  request.image.bytes = image->bytes.first(static_cast<std::size_t>(image->size));
  request.image.format = model::codec_format(image::Format::webp);
  request.image.resize = {};
  codec::EncodeResult result = encodings.transcode(request);
  if (auto* png = std::get_if<codec::EncodedImage>(&result)) png->source = image->source;
  return result;
}

}  // namespace

void encode(Job& job, ImageEncodings& encodings) {
  for (const ImageAttempt& attempt : job.plan.attempts) {
    const codec::EncodeResult result = transcode(attempt, encodings);
    if (const auto* error = std::get_if<codec::DecodeError>(&result)) {
      if (!take_error(job, attempt, *error)) return;
      continue;
    }
    const auto& image = *std::get_if<codec::EncodedImage>(&result);
    if (!is_good(job, attempt, image)) continue;
    job.encoded.attempt = &attempt;
    job.encoded.bytes.assign(reinterpret_cast<const char*>(image.bytes.data()), image.size);
    job.encoded.source = image.source;
    job.encoded.raster = image.raster;
    job.encoded.distance = image.distance;
    job.encoded.gpu_bytes = image::gpu_bytes(image.bytes);
    return;
  }
}

}  // namespace gltfx::steps
