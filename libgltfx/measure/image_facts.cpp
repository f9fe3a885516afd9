// SPDX-License-Identifier: Apache-2.0
#include "measure/image_facts.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "container/uri.hpp"
#include "image/gpu_memory.hpp"
#include "image/ktx2.hpp"
#include "model/texture.hpp"

namespace gltfx::measure {
namespace {

using image::Ktx2;
using model::RootArray;

std::string encoding_name(const Ktx2& file) {
  switch (file.model) {
    case image::Ktx2Model::etc1s:
      return "ETC1S";
    case image::Ktx2Model::uastc:
      return "UASTC";
    case image::Ktx2Model::astc:
      return "ASTC";
    case image::Ktx2Model::other:
      break;
  }
  return fmt::format("Vulkan format {}", file.vk_format);
}

void read_ktx2(const Ktx2& file, ImageFacts& facts) {
  facts.width = file.width;
  facts.height = file.height;
  facts.levels = std::max(file.level_count, 1U);
  facts.encoding = encoding_name(file);
  if (file.contents) facts.channels = image::channels_name(*file.contents);
  if (file.described) facts.bits = image::header_of(file).bits;
  facts.gpu_bytes = image::gpu_bytes(file);
}

void read_pixels(const model::ImageData& data, ImageFacts& facts) {
  if (data.format) facts.format = image::media_type(*data.format);
  if (data.ktx2) return read_ktx2(*data.ktx2, facts);
  if (!data.header) return;
  facts.width = data.header->width;
  facts.height = data.header->height;
  facts.bits = data.header->bits;
  facts.channels = image::channels_name(data.header->channels);
  facts.gpu_bytes = image::gpu_bytes(*data.header);
}

class Reader {
 public:
  Reader(const model::Asset& asset, const model::ResourceData& resources,
         std::vector<std::string>& problems)
      : asset_(asset), resources_(resources), problems_(problems) {
    for (std::size_t i = 0; i < resources.images.size(); ++i) read_image(i);
    for (const json::NodeId texture : asset.elements(RootArray::textures)) {
      textures_.push_back(texture == json::kNoNode ? std::vector<std::uint32_t>()
                                                   : model::read_texture(asset, texture).images);
      for (const std::uint32_t image : textures_.back()) ++facts_[image].textures;
    }
  }

  void take(const schema::SlotUse& use) {
    const auto texture = asset_.index(use.texture_info, "index", RootArray::textures);
    if (!texture || use.slot == nullptr) return;
    for (const std::uint32_t image : textures_[*texture]) {
      ImageFacts& facts = facts_[image];
      facts.slots.push_back(use.pointer.substr(use.pointer.rfind('/') + 1));
      const std::string_view space = use.slot->srgb ? "sRGB" : "linear";
      if (facts.color_space.empty()) facts.color_space = space;
      if (facts.color_space != space) facts.color_space = "both";
    }
  }

  std::vector<ImageFacts> finish() {
    for (ImageFacts& facts : facts_) {
      std::sort(facts.slots.begin(), facts.slots.end());
      facts.slots.erase(std::unique(facts.slots.begin(), facts.slots.end()), facts.slots.end());
    }
    return std::move(facts_);
  }

 private:
  void read_image(std::size_t index) {
    ImageFacts& facts = facts_.emplace_back();
    const json::NodeId object = asset_.elements(RootArray::images)[index];
    if (object == json::kNoNode) return;
    const json::Document& document = asset_.document();
    facts.name = asset_.name(object);
    const json::NodeId uri = document.find(object, "uri");
    if (uri != json::kNoNode && document.is_string(uri)) {
      container::Uri parts = container::classify_uri(document.string(uri));
      if (parts.kind != container::UriKind::data) facts.uri = std::move(parts.normalized);
    }
    const model::ImageData& data = resources_.images[index];
    if (!data.bytes) return;  // reported where it was opened
    read_pixels(data, facts);
    if (facts.width > 0) return;
    problems_.push_back(
        fmt::format("Image {} is in no format that is known here, or broken.", index));
  }

  const model::Asset& asset_;
  const model::ResourceData& resources_;
  std::vector<std::string>& problems_;
  std::vector<ImageFacts> facts_;
  std::vector<std::vector<std::uint32_t>> textures_;  // images, by texture
};

}  // namespace

std::vector<ImageFacts> image_facts(const model::Asset& asset, const model::ResourceData& resources,
                                    const std::vector<schema::SlotUse>& slots,
                                    std::vector<std::string>& problems) {
  Reader reader(asset, resources, problems);
  for (const schema::SlotUse& use : slots) reader.take(use);
  return reader.finish();
}

}  // namespace gltfx::measure
