// SPDX-License-Identifier: Apache-2.0
#include "rules/payload/metadata/data_texture.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "container/uri.hpp"
#include "model/fields.hpp"
#include "model/image_codec.hpp"
#include "model/texture.hpp"
#include "rules/collector.hpp"
#include "rules/finding.hpp"
#include "rules/payload/texture_slots.hpp"

namespace gltfx::validate {
namespace {

constexpr std::uint64_t kMostTexels = std::uint64_t{1} << 26U;        // of all images together
constexpr std::uint64_t kMostImageBytes = std::uint64_t{240} << 20U;  // decoded, per image

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
  if (found.channel_count > there) {
    report_member(phase.sink(), phase.context(), path, object, "channels",
                  Code::DATA_TEXTURE_CHANNEL_MISSING,
                  fmt::format("{} channels are read, but {} has {}.", found.channel_count,
                              image_label(phase.context(), *found.image), there));
    return;
  }
  for (const double channel : listed_channels(phase.document(), object)) {
    if (channel >= 0 && channel < there && channel == static_cast<unsigned>(channel)) {
      found.channels.push_back(static_cast<unsigned>(channel));
      continue;
    }
    found.channels.clear();
    if (channel < there) return;  // not an index, which the schema walk reports
    report_member(phase.sink(), phase.context(), path, object, "channels",
                  Code::DATA_TEXTURE_CHANNEL_MISSING,
                  fmt::format("Channel {} is read, but {} has {}.", channel,
                              image_label(phase.context(), *found.image), there));
    return;
  }
}

// Whether the file of an image is missing, which is reported at the image.
bool is_missing(const Context& context, json::NodeId image) {
  const container::Uri uri =
      container::classify_uri(model::string_member(context.document, image, "uri"));
  if (uri.kind != container::UriKind::relative_path) return false;
  const container::ResolveError error = context.files.open(uri).error;
  return error != container::ResolveError::none && error != container::ResolveError::no_root;
}

void report_unreadable(MetadataPhase& phase, json::NodeId object, const Path& path,
                       std::string message) {
  report_member(phase.sink(), phase.context(), path, object, "index", Code::DATA_TEXTURE_UNREADABLE,
                std::move(message));
}

// The image of a texture if it has a header; otherwise reports the reason.
std::optional<std::uint32_t> readable_image(MetadataPhase& phase, json::NodeId object,
                                            const Path& path, json::NodeId texture) {
  const Context& context = phase.context();
  const std::vector<std::uint32_t> images = model::read_texture(context.asset, texture).images;
  if (images.empty()) {
    const bool silent = context.document.find(texture, "source") == json::kNoNode &&
                        context.document.find(texture, "extensions") == json::kNoNode;
    if (silent) report_unreadable(phase, object, path, "The texture has no image.");
    return std::nullopt;
  }
  const model::ImageData& data = phase.data.resources.images[images.front()];
  if (data.header && data.header->doubt.empty()) return images.front();
  const json::NodeId image = context.asset.elements(model::RootArray::images)[images.front()];
  if (data.bytes || is_missing(context, image)) {
    report_unreadable(
        phase, object, path,
        fmt::format("{} cannot be read.", capitalized(image_label(context, images.front()))));
  }
  return std::nullopt;
}

const std::string* color_slot(MetadataPhase& phase, std::uint32_t image) {
  if (!phase.color_slots) {
    phase.color_slots.emplace();
    const Animated animated(phase.context());
    for (const TextureSlot& slot : texture_slots(phase.context(), animated)) {
      if (!slot.srgb || slot.effective.colors() == 0) continue;
      for (const std::uint32_t shown : slot.images) {
        phase.color_slots->emplace(shown, slot.use->pointer);
      }
    }
  }
  const auto found = phase.color_slots->find(image);
  return found == phase.color_slots->end() ? nullptr : &found->second;
}

// Reports numbers in R, G and B that readers would convert as colors.
void check_linear(MetadataPhase& phase, json::NodeId object, const Path& path,
                  const DataTexture& texture) {
  const bool colors = std::any_of(texture.channels.begin(), texture.channels.end(),
                                  [](unsigned channel) { return channel < 3; });
  if (!colors) return;
  const model::ImageData& data = phase.data.resources.images[*texture.image];
  const bool declared = data.ktx2 && data.ktx2->transfer == image::kKtx2TransferSrgb;
  const std::string* slot = declared ? nullptr : color_slot(phase, *texture.image);
  if (!declared && slot == nullptr) return;
  const std::string label = capitalized(image_label(phase.context(), *texture.image));
  report_member(phase.sink(), phase.context(), path, object, "index",
                Code::DATA_TEXTURE_COLOR_SPACE,
                declared ? fmt::format("{} is sRGB; data must be linear.", label)
                         : fmt::format("{} is data, but {} reads it as sRGB.", label,
                                       member_label(phase.context(), *slot)));
}

codec::ImageResult decode(MetadataPhase& phase, std::uint32_t index) {
  codec::ImageRequest request = model::image_request(phase.data.resources, index);
  request.pixels = true;
  ++phase.report.images_wanted;
  auto result = codec::Client::shared().decode_image(request);
  if (std::holds_alternative<codec::Image>(result)) ++phase.report.images_decoded;
  return result;
}

void report_undecodable(MetadataPhase& phase, const TexelRequest& request,
                        const codec::DecodeError& error) {
  if (error.kind != codec::ErrorKind::malformed) return;
  const Context& context = phase.context();
  report_at(phase.sink(), request.pointer + "/index",
            finding_on(context, context.document.find(request.object, "index"),
                       Code::DATA_TEXTURE_UNREADABLE,
                       fmt::format("The texels of {} cannot be decoded: {}",
                                   image_label(context, request.image), printable(error.message))));
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
  found.image = readable_image(phase, object, path, texture);
  if (!found.image) return found;
  check_channels(phase, object, path, *phase.data.resources.images[*found.image].header, found);
  check_linear(phase, object, path, found);
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
  std::optional<codec::ImageResult> result;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const std::uint32_t index = requests[i].image;
    if (i == 0 || requests[i - 1].image != index) {
      result.reset();
      const auto& header = phase.data.resources.images[index].header;
      const bool sound = header && header->doubt.empty();
      const std::uint64_t texels = sound ? image::texels_of(*header) : 0;
      if (!sound || texels > left) continue;
      if (texels * stored_channels(header->channels) > kMostImageBytes) continue;
      left -= texels;
      result = decode(phase, index);
    }
    if (!result) continue;
    const auto* image = std::get_if<codec::Image>(&*result);
    if (image == nullptr) {
      report_undecodable(phase, requests[i], std::get<codec::DecodeError>(*result));
    } else if (image->bits == 8 && phase.data.budget.take(image->texels(), 1)) {
      requests[i].use(*image);
    }
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
