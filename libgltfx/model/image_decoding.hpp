// SPDX-License-Identifier: Apache-2.0
/// Decodes the images of an asset within limits.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "codec/client.hpp"
#include "model/resource_data.hpp"

namespace gltfx::model {

/// Limits the texels of all images of an asset together, and stops when images reach limits of time
/// and memory, which take seconds each. The resources must outlive it.
class ImageDecoding {
 public:
  /// What the errors of images that are not decoded for these reasons say.
  static constexpr std::string_view kTooManyTexels =
      "The images of the asset exceed the limit on texels.";
  static constexpr std::string_view kStopped =
      "Other images of the asset reached the limit on decoding.";

  /// `texels`: the maximum number of decoded texels, all images together.
  explicit ImageDecoding(const ResourceData& resources,
                         std::uint64_t texels = std::uint64_t{1} << 30U)
      : resources_(resources), texels_left_(texels) {}

  struct Request {
    std::uint32_t image = 0;
    bool normals = false;  ///< check it as a normal map
    bool pixels = false;   ///< keep the pixels
  };
  using Result = std::function<void(std::size_t request, codec::ImageResult& result)>;
  /// Decodes images with a valid header, `jobs` at a time; there is no result of others. Calls
  /// `work` for each one that was decoded, also from several threads at once, and then `take` for
  /// each result, in the order of the requests. Which images fail does not depend on `jobs`.
  void decode(std::span<const Request> wanted, unsigned jobs, const Result& work,
              const Result& take);

 private:
  enum class Verdict : std::uint8_t { skip, refuse, decode };
  Verdict admit(std::uint32_t index);
  codec::ImageResult decoded(const Request& request) const;

  const ResourceData& resources_;
  std::uint64_t texels_left_;
};

}  // namespace gltfx::model
