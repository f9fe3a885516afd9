// SPDX-License-Identifier: Apache-2.0
#include "upgrade/channel_move.hpp"

#include "upgrade/texture_source.hpp"

namespace gltfx::upgrade {
namespace {

constexpr std::string_view kLetters = "rgba";

std::uint8_t channel_of(char letter) { return static_cast<std::uint8_t>(kLetters.find(letter)); }

// Whether two channels are equal in every texel, as far as that is known.
bool are_equal(const Picture& picture, std::uint8_t one, std::uint8_t other) {
  if (one == 0 && kLetters[other] == 'a' && picture.alpha_is_red) return true;
  const codec::ChannelStatistics a = picture.statistics(one);
  const codec::ChannelStatistics b = picture.statistics(other);
  return a.constant() && b.constant() && a.least == b.least;
}

}  // namespace

ChannelMove judge_channel_move(const model::Asset& asset, std::uint64_t texture,
                               std::string_view swizzle, Pictures* pictures) {
  ChannelMove move;
  if (pictures == nullptr) {
    move.problem = "the pixels of its image are not available";
    return move;
  }
  TextureSource source = texture_source(asset, texture, *pictures);
  if (!source.problem.empty()) {
    move.problem = std::move(source.problem);
    return move;
  }
  const Picture& picture = pictures->picture(source.image);
  const std::uint8_t from = channel_of(swizzle.front());
  const std::uint8_t to = channel_of(swizzle.back());
  const codec::ChannelStatistics moved = picture.statistics(from);
  if (moved.constant()) {
    move.constant = static_cast<double>(moved.least) / static_cast<double>(picture.image.full());
  }
  move.note = std::move(source.note);
  move.target_varies = !picture.statistics(to).constant();
  move.sampler = source.sampler;
  move.image = source.image;
  move.kind = are_equal(picture, from, to) ? ChannelMove::Kind::reuse : ChannelMove::Kind::repack;
  for (ChannelSource& channel : move.job.channels) channel = ChannelSource::constant(1);
  move.job.channels[to] = ChannelSource::of(source.image, from);
  return move;
}

}  // namespace gltfx::upgrade
