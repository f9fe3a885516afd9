// SPDX-License-Identifier: Apache-2.0
#include "model/image_decoding.hpp"

#include <atomic>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/parallel.hpp"
#include "model/image_codec.hpp"

namespace gltfx::model {
namespace {

// Images that reach a limit take seconds each: at most two of them per asset.
constexpr int kMostCostly = 2;

}  // namespace

ImageDecoding::Verdict ImageDecoding::admit(std::uint32_t index) {
  const auto& header = resources_.images[index].header;
  if (!is_decodable(resources_.images[index]) || !header->doubt.empty()) return Verdict::skip;
  const std::uint64_t texels = image::texels_of(*header);
  if (texels > texels_left_) return Verdict::refuse;
  texels_left_ -= texels;
  return Verdict::decode;
}

codec::ImageResult ImageDecoding::decoded(const Request& request) const {
  codec::ImageRequest wanted = image_request(resources_, request.image);
  wanted.normals = request.normals;
  wanted.pixels = request.pixels;
  return codec::Client::shared().decode_image(wanted);
}

void ImageDecoding::decode(std::span<const Request> wanted, unsigned jobs, const Result& work,
                           const Result& take) {
  std::vector<Verdict> verdicts;
  for (const Request& each : wanted) verdicts.push_back(admit(each.image));
  std::vector<std::optional<codec::ImageResult>> results(wanted.size());
  std::atomic<bool> stopped = false;
  int costly = 0;
  const auto decode_one = [&](std::size_t i) {
    if (verdicts[i] != Verdict::decode || stopped) return;
    results[i] = decoded(wanted[i]);
    if (std::holds_alternative<codec::Image>(*results[i])) work(i, *results[i]);
  };
  parallel_ordered(wanted.size(), jobs, decode_one, [&](std::size_t i) {
    using codec::ErrorKind;
    std::optional<codec::ImageResult>& result = results[i];
    if (verdicts[i] == Verdict::refuse) {
      result = codec::DecodeError{ErrorKind::too_large, std::string(kTooManyTexels)};
    } else if (verdicts[i] == Verdict::decode && stopped) {
      result = codec::DecodeError{ErrorKind::unavailable, std::string(kStopped)};
    }
    if (!result) return;
    const auto* error = std::get_if<codec::DecodeError>(&*result);
    if (error != nullptr && codec::is_costly(*error) && ++costly == kMostCostly) stopped = true;
    take(i, *result);
    result.reset();
  });
}

}  // namespace gltfx::model
