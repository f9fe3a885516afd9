// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_textures.hpp"

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "model/image_codec.hpp"

namespace gltfx {
namespace {

// Images that run into a limit cost a second each: one asset gets no more than two of them.
constexpr int kMostCostly = 2;

// What a worker decodes in the time that another one takes to start.
constexpr std::uint64_t kWorkerPixels = std::uint64_t{1} << 23U;

bake::Wrap wrap_of(model::Wrap wrap) {
  if (wrap == model::Wrap::clamp_to_edge) return bake::Wrap::clamp_to_edge;
  return wrap == model::Wrap::repeat ? bake::Wrap::repeat : bake::Wrap::mirrored_repeat;
}

// Bytes of the decoded image, as its header has it.
Checked decoded_size(const image::Header& header) {
  const Checked texels = checked_mul(header.width, header.height);
  return texels ? checked_mul(*texels, header.bits == 16 ? 8 : 4) : std::nullopt;
}

}  // namespace

std::uint32_t SceneTextures::use(std::uint32_t texture) {
  const auto [known, fresh] = known_.try_emplace(texture, static_cast<std::uint32_t>(used_.size()));
  if (!fresh) return known->second;
  used_.push_back(texture);
  textures_.push_back(
      model::read_texture(asset_, asset_.elements(model::RootArray::textures)[texture]));
  const model::Sampler& sampler = textures_.back().sampler;
  bake::Texture to;
  to.wrap_s = wrap_of(sampler.wrap_s);
  to.wrap_t = wrap_of(sampler.wrap_t);
  to.filter =
      sampler.magnify == model::Filter::nearest ? bake::Filter::nearest : bake::Filter::linear;
  to.missing = true;
  scene_.textures.push_back(std::move(to));
  return known->second;
}

std::string SceneTextures::obstacle(std::uint32_t image) const {
  const model::ImageData& data = resources_.images[image];
  if (!data.bytes) return "has a missing image";
  if (!data.format) return "has an image in an unknown format";
  if (!model::codec_format(*data.format)) {
    return fmt::format("has an image of type {}, which is not supported",
                       image::media_type(*data.format));
  }
  return data.header ? std::string() : "has an image with an invalid header";
}

// What memory there may be is settled here, image by image, whatever the number of threads.
void SceneTextures::plan(model::MemoryBudget& budget) {
  for (const model::Texture& texture : textures_) {
    for (const std::uint32_t image : texture.images) {
      if (!obstacle(image).empty() || job_of_.count(image) > 0) continue;
      Job job{image,
              codec::DecodeError{codec::ErrorKind::too_large, "its pixels need too much memory"}};
      const image::Header& header = *resources_.images[image].header;
      if (budget.take(decoded_size(header))) job.result = codec::Image();
      pixels_ = saturating_add(pixels_, texels_of(header));
      job_of_.emplace(image, jobs_.size());
      jobs_.push_back(std::move(job));
      break;
    }
  }
}

void SceneTextures::decode(codec::Client& client, unsigned jobs, model::MemoryBudget& budget) {
  plan(budget);
  const auto worth = static_cast<unsigned>(std::min<std::uint64_t>(pixels_ / kWorkerPixels, 64));
  std::atomic<bool> stopped = false;
  int costly = 0;
  parallel_ordered(
      jobs_.size(), std::min(jobs == 0 ? default_jobs() : jobs, 1 + worth),
      [&](std::size_t i) {
        Job& job = jobs_[i];
        if (stopped || std::holds_alternative<codec::DecodeError>(job.result)) return;
        const model::ImageData& data = resources_.images[job.image];
        codec::ImageRequest request;
        request.bytes = data.bytes->view();
        request.format = *model::codec_format(*data.format);
        request.pixels = true;
        request.origin = resources_.origin;
        request.max_pixels = std::min(request.max_pixels, texels_of(*data.header));
        job.result = client.decode_image(request);
      },
      [&](std::size_t i) {
        codec::ImageResult& result = jobs_[i].result;
        if (stopped)
          result = codec::DecodeError{codec::ErrorKind::timed_out, "others took too long"};
        const auto* error = std::get_if<codec::DecodeError>(&result);
        if (error != nullptr && codec::is_costly(*error) && ++costly == kMostCostly) stopped = true;
      });
  for (std::uint32_t i = 0; i < used_.size(); ++i) finish(i);
}

void SceneTextures::finish(std::uint32_t index) {
  std::string why = "has no image";
  for (const std::uint32_t image : textures_[index].images) {
    const auto job = job_of_.find(image);
    if (job == job_of_.end()) {
      why = obstacle(image);
      continue;
    }
    const codec::ImageResult& result = jobs_[job->second].result;
    if (const auto* error = std::get_if<codec::DecodeError>(&result)) {
      why = fmt::format("has an image that cannot be decoded ({})", printable(error->message));
      continue;
    }
    const auto& decoded = std::get<codec::Image>(result);
    bake::Texture& to = scene_.textures[index];
    to.width = decoded.width;
    to.height = decoded.height;
    to.channels = decoded.channels;
    to.bits = decoded.bits;
    to.pixels = decoded.pixels;
    to.owner = decoded.owner;
    to.missing = decoded.pixels.empty();
    if (!to.missing) return;
  }
  notes_.add(fmt::format("Texture {}", used_[index]),
             fmt::format("{}; a checkerboard is shown instead", why));
}

}  // namespace gltfx
