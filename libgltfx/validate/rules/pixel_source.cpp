// SPDX-License-Identifier: Apache-2.0
#include "validate/rules/pixel_source.hpp"

#include "base/parallel.hpp"
#include "model/image_codec.hpp"

namespace gltfx::validate {

bool PixelSource::take(std::uint32_t image) {
  const auto& header = resources_.images[image].header;
  if (!header || !header->doubt.empty() || !model::codec_format(header->format)) return false;
  const std::uint64_t texels = std::uint64_t{header->width} * header->height;
  if (texels <= texels_left_) {
    texels_left_ -= texels;
    return true;
  }
  results_[image] = codec::Fault{codec::FaultKind::too_large,
                                 "The images of the asset have more texels than are looked at."};
  return false;
}

void PixelSource::decode(const std::vector<Request>& wanted, unsigned jobs) {
  std::vector<Request> requests;
  for (const Request& each : wanted) {
    if (take(each.image)) requests.push_back(each);
  }
  const auto decode_one = [&](std::size_t i) {
    const Request& next = requests[i];
    const model::ImageData& data = resources_.images[next.image];
    if (!data.bytes) return;
    const auto format = model::codec_format(data.header->format);
    if (!format) return;
    codec::ImageRequest request;
    request.bytes = data.bytes->view();
    request.format = *format;
    request.normals = next.normals;
    results_[next.image] = codec::Client::shared().decode_image(request);
  };
  parallel_ordered(requests.size(), jobs, decode_one, [](std::size_t) {});
}

}  // namespace gltfx::validate
