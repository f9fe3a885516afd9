// SPDX-License-Identifier: Apache-2.0
#include "validate/rules/pixel_source.hpp"

#include <algorithm>
#include <atomic>

#include "base/parallel.hpp"
#include "model/image_codec.hpp"

namespace gltfx::validate {
namespace {

// Images that run into a limit cost seconds each: one asset gets no more than two of them.
constexpr int kMostCostly = 2;

}  // namespace

bool PixelSource::take(std::uint32_t index) {
  const auto& header = resources_.images[index].header;
  const bool sound = header && header->doubt.empty() && resources_.images[index].bytes;
  if (!sound || !model::codec_format(header->format)) return false;
  const std::uint64_t texels = image::texels_of(*header);
  if (texels <= texels_left_) {
    texels_left_ -= texels;
    return true;
  }
  results_[index] = codec::DecodeError{codec::ErrorKind::too_large,
                                       "The images of the asset exceed the limit on texels."};
  return false;
}

codec::ImageResult PixelSource::decoded(const Request& request) const {
  const model::ImageData& data = resources_.images[request.image];
  codec::ImageRequest wanted;
  wanted.bytes = data.bytes->view();
  wanted.format = *model::codec_format(data.header->format);
  wanted.max_pixels = std::min(wanted.max_pixels, image::texels_of(*data.header));
  wanted.normals = request.normals;
  wanted.origin = resources_.origin;
  return codec::Client::shared().decode_image(wanted);
}

void PixelSource::decode(const std::vector<Request>& wanted, unsigned jobs) {
  std::vector<Request> requests;
  for (const Request& each : wanted) {
    if (take(each.image)) requests.push_back(each);
  }
  std::atomic<bool> stopped = false;
  int costly = 0;
  const auto decode_one = [&](std::size_t i) {
    if (!stopped) results_[requests[i].image] = decoded(requests[i]);
  };
  // Which ones are left over does not depend on the number of threads.
  parallel_ordered(requests.size(), jobs, decode_one, [&](std::size_t i) {
    auto& result = results_[requests[i].image];
    if (stopped) {
      result = codec::DecodeError{codec::ErrorKind::unavailable,
                                  "Other images of the asset reached the limit on decoding."};
    }
    const auto* error = result ? std::get_if<codec::DecodeError>(&*result) : nullptr;
    if (error != nullptr && codec::is_costly(*error) && ++costly == kMostCostly) stopped = true;
  });
}

}  // namespace gltfx::validate
