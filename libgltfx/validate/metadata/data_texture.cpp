// SPDX-License-Identifier: Apache-2.0
#include "validate/metadata/data_texture.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/fields.hpp"
#include "model/image_codec.hpp"
#include "model/texture.hpp"
#include "validate/collector.hpp"
#include "validate/rules/finding.hpp"
#include "validate/rules/texture_slots.hpp"

namespace gltfx::validate {
namespace {

constexpr std::uint64_t kMostTexels = std::uint64_t{1} << 26U;

unsigned stored_channels(image::Channels channels) {
  switch (channels) {
    case image::Channels::luminance:
    case image::Channels::red:
      return 1;
    case image::Channels::luminance_alpha:
    case image::Channels::red_green:
      return 2;
    case image::Channels::rgb:
      return 3;
    default:
      return 4;
  }
}

std::vector<double> listed_channels(const json::Document& document, json::NodeId object) {
  const json::NodeId list = document.find(object, "channels");
  if (list == json::kNoNode) return {0};
  std::vector<double> channels;
  if (document.kind(list) != json::Kind::number_array) return channels;
  for (json::NumberCursor at(document, list); at.valid(); at.advance()) {
    channels.push_back(at.number().value);
  }
  return channels;
}

void check_filters(MetadataPhase& phase, json::NodeId object, const Path& path,
                   json::NodeId texture, bool nearest) {
  const Context& context = phase.context();
  const auto sampler = context.asset.index(texture, "sampler", model::RootArray::samplers);
  if (!sampler) return;
  const json::NodeId node = context.asset.elements(model::RootArray::samplers)[*sampler];
  for (const std::string_view member : {"magFilter", "minFilter"}) {
    const auto filter = model::unsigned_member(context.document, node, member);
    if (!filter || *filter == 9728 || (!nearest && *filter == 9729)) continue;
    report_member(phase.sink(), context, path, object, "index", Code::DATA_TEXTURE_FILTER_INVALID,
                  fmt::format("{} of {} is {}; it must be {}.", member,
                              object_label(context, model::RootArray::samplers, *sampler), *filter,
                              nearest ? "9728 (NEAREST)" : "9728 (NEAREST) or 9729 (LINEAR)"));
  }
}

void check_channels(MetadataPhase& phase, json::NodeId object, const Path& path,
                    const image::Header& header, DataTexture& found) {
  const unsigned there = stored_channels(header.channels);
  for (const double channel : listed_channels(phase.document(), object)) {
    if (channel >= 0 && channel < there && channel == static_cast<unsigned>(channel)) {
      found.channels.push_back(static_cast<unsigned>(channel));
      continue;
    }
    found.channels.clear();
    if (channel < there) return;  // no index, which the schema says
    report_member(phase.sink(), phase.context(), path, object, "channels",
                  Code::DATA_TEXTURE_CHANNEL_MISSING,
                  fmt::format("Channel {} is read, but {} has {}.", channel,
                              image_label(phase.context(), *found.image), there));
    return;
  }
}

std::optional<codec::Image> decode(MetadataPhase& phase, std::uint32_t index) {
  codec::ImageRequest request = model::image_request(phase.data.resources, index);
  request.pixels = true;
  ++phase.report.images_wanted;
  auto result = codec::Client::shared().decode_image(request);
  auto* image = std::get_if<codec::Image>(&result);
  if (image == nullptr) return std::nullopt;
  ++phase.report.images_decoded;
  return image->bits == 8 ? std::optional(std::move(*image)) : std::nullopt;
}

}  // namespace

DataTexture check_data_texture(MetadataPhase& phase, json::NodeId object, const Path& path,
                               bool nearest) {
  const Context& context = phase.context();
  DataTexture found;
  found.channel_count = listed_channels(context.document, object).size();
  const auto index = context.asset.index(object, "index", model::RootArray::textures);
  if (!index) return found;
  const json::NodeId texture = context.asset.elements(model::RootArray::textures)[*index];
  check_filters(phase, object, path, texture, nearest);
  const std::vector<std::uint32_t> images = model::read_texture(context.asset, texture).images;
  if (images.empty()) return found;
  const auto& header = phase.data.resources.images[images.front()].header;
  if (!header) return found;
  found.image = images.front();
  check_channels(phase, object, path, *header, found);
  return found;
}

std::optional<std::uint64_t> texcoord_set(const json::Document& document, json::NodeId object) {
  const json::NodeId member = document.find(object, "texCoord");
  return member == json::kNoNode ? 0 : document.unsigned_integer(member);
}

std::vector<std::uint64_t> texcoord_sets(const Context& context, json::NodeId primitive) {
  const json::NodeId attributes = model::object_member(context.document, primitive, "attributes");
  std::vector<std::uint64_t> sets;
  if (attributes == json::kNoNode) return sets;
  for (const model::Attribute& each : model::read_attributes(context.asset, attributes)) {
    if (each.semantic.kind == model::SemanticKind::texcoord) sets.push_back(each.semantic.set);
  }
  std::sort(sets.begin(), sets.end());
  return sets;
}

void report_missing_texcoord(MetadataPhase& phase, std::uint64_t set, json::NodeId place,
                             const Path& path) {
  phase.sink().report(path, finding_on(phase.context(), place, Code::DATA_TEXTURE_TEXCOORD_MISSING,
                                       fmt::format("The primitive has no TEXCOORD_{}.", set)));
}

void read_texels(MetadataPhase& phase, std::vector<TexelRequest> requests) {
  if (pixel_level(phase.context().options) == PixelLevel::headers) return;
  std::stable_sort(requests.begin(), requests.end(),
                   [](const auto& a, const auto& b) { return a.image < b.image; });
  std::uint64_t left = kMostTexels;
  std::optional<codec::Image> image;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const std::uint32_t index = requests[i].image;
    if (i == 0 || requests[i - 1].image != index) {
      image.reset();
      const auto& header = phase.data.resources.images[index].header;
      const bool sound = header && header->doubt.empty();
      if (!sound || image::texels_of(*header) > left) continue;
      left -= image::texels_of(*header);
      image = decode(phase, index);
    }
    if (image && phase.data.budget.take(image->texels(), 1)) requests[i].use(*image);
  }
}

void for_each_texel_block(const codec::Image& image, const std::vector<unsigned>& channels,
                          const std::function<void(std::span<const std::byte>, std::size_t)>& use) {
  const bool all = std::all_of(channels.begin(), channels.end(),
                               [&](unsigned channel) { return channel < image.channels; });
  if (!all || channels.empty()) return;
  constexpr std::size_t kBlockTexels = 4800;
  std::vector<std::byte> block(kBlockTexels * channels.size());
  const auto texels = static_cast<std::size_t>(image.texels());
  for (std::size_t done = 0; done < texels; done += kBlockTexels) {
    const std::size_t some = std::min(kBlockTexels, texels - done);
    std::byte* to = block.data();
    for (std::size_t i = 0; i < some; ++i) {
      const std::byte* texel = image.pixels.data() + (done + i) * image.channels;
      for (const unsigned channel : channels) *to++ = texel[channel];
    }
    use(std::span(block).first(some * channels.size()), some);
  }
}

}  // namespace gltfx::validate
