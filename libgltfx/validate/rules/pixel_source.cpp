// SPDX-License-Identifier: Apache-2.0
#include "validate/rules/pixel_source.hpp"

#include "base/parallel.hpp"

namespace gltfx::validate {
namespace {

std::optional<codec::ImageFormat> codec_format(image::Format format) {
  switch (format) {
    case image::Format::png:
      return codec::ImageFormat::png;
    case image::Format::jpeg:
      return codec::ImageFormat::jpeg;
    case image::Format::webp:
      return codec::ImageFormat::webp;
    case image::Format::ktx2:
      break;
  }
  return std::nullopt;
}

}  // namespace

void PixelSource::decode(const std::vector<Request>& requests) {
  const auto decode_one = [&](std::size_t i) {
    const Request& wanted = requests[i];
    const model::ImageData& data = resources_.images[wanted.image];
    if (!data.header || !data.bytes || !data.header->doubt.empty()) return;
    const auto format = codec_format(data.header->format);
    if (!format) return;
    codec::ImageRequest request;
    request.bytes = data.bytes->view();
    request.format = *format;
    request.normals = wanted.normals;
    results_[wanted.image] = codec::Client::shared().decode_image(request);
  };
  parallel_ordered(requests.size(), default_jobs(), decode_one, [](std::size_t) {});
}

}  // namespace gltfx::validate
