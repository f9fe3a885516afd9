// SPDX-License-Identifier: Apache-2.0
#include "upgrade/additions.hpp"

#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace gltfx::upgrade {
namespace {

std::string key_of(const ImageJob& job) {
  std::string key = "image";
  for (const ChannelSource& channel : job.channels) {
    const std::string image = channel.image ? std::to_string(*channel.image) : std::string();
    fmt::format_to(std::back_inserter(key), " {}.{}*{}+{}", image, channel.channel, channel.scale,
                   channel.offset);
  }
  return key;
}

std::string key_of(const Additions::Texture& texture) {
  const std::string sampler = texture.sampler ? std::to_string(*texture.sampler) : std::string();
  return fmt::format("texture {} {}", texture.image, sampler);
}

// The position of a value in a list, which gets it unless it has it.
template <typename T>
std::uint64_t place_in(std::vector<T>& list, const T& value,
                       std::map<std::string, std::uint64_t>& known) {
  const auto [place, is_new] = known.emplace(key_of(value), list.size());
  if (is_new) list.push_back(value);
  return place->second;
}

}  // namespace

Additions::Additions(const json::Document& document) {
  for (const auto member : document.members(document.root())) {
    if (!document.is_array(member.value)) continue;
    counts_[std::string(document.key(member.key_id))] = document.array_size(member.value);
  }
}

std::uint64_t Additions::old_count(const std::string& array) const {
  const auto found = counts_.find(array);
  return found == counts_.end() ? 0 : found->second;
}

std::uint64_t Additions::add_image(const ImageJob& job) {
  return old_count("images") + place_in(images_, job, known_);
}

std::uint64_t Additions::add_texture(const ImageJob& job, std::optional<std::uint64_t> sampler) {
  return old_count("textures") + place_in(textures_, Texture{add_image(job), sampler}, known_);
}

std::uint64_t Additions::add_accessor(Accessor accessor) {
  accessors_.push_back(std::move(accessor));
  return old_count("accessors") + accessors_.size() - 1;
}

std::uint64_t Additions::add_element(const std::string& array, std::string json) {
  std::vector<std::string>& list = elements_[array];
  list.push_back(std::move(json));
  return old_count(array) + list.size() - 1;
}

}  // namespace gltfx::upgrade
