// SPDX-License-Identifier: Apache-2.0
// Features of containers, URIs and images.
#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

#include "container/percent.hpp"
#include "container/uri.hpp"
#include "image/features.hpp"
#include "model/fields.hpp"
#include "rules/targets/features.hpp"

namespace gltfx::validate {
namespace {

using json::NodeId;
using model::RootArray;

bool is_power_of_two(std::uint32_t number) { return number != 0 && (number & (number - 1)) == 0; }

class FileFeatures {
 public:
  FileFeatures(const Context& context, const model::ResourceData& resources, Features& features)
      : context_(context),
        document_(context.document),
        resources_(resources),
        features_(features) {}

  void find() {
    find_asset();
    if (context_.container.format == container::Format::glb) find_chunks();
    for (const NodeId buffer : context_.asset.elements(RootArray::buffers)) {
      if (buffer != json::kNoNode) find_buffer(buffer);
    }
    const auto& images = context_.asset.elements(RootArray::images);
    for (std::size_t i = 0; i < images.size(); ++i) {
      if (images[i] != json::kNoNode) find_image(images[i], resources_.images[i]);
    }
    for (const NodeId texture : context_.asset.elements(RootArray::textures)) {
      if (texture != json::kNoNode) find_repeated(texture);
    }
  }

 private:
  void note_if(bool has, std::string_view name, NodeId node) { features_.note_if(has, name, node); }

  void find_asset() {
    const NodeId asset = model::object_member(document_, document_.root(), "asset");
    const std::string least = model::string_member(document_, asset, "minVersion");
    note_if(least == "2.0", "asset.min-version-2.0", asset);
    note_if(least == "2.1", "asset.min-version-2.1", asset);
    note_if(model::string_member(document_, asset, "version") == "2.1", "asset.version-2.1", asset);
    if (document_.key_id("extras") != json::kNoKey) features_.note("extras", document_.root());
  }

  void find_chunks() {
    const auto& chunks = context_.container.chunks;
    features_.note("container.glb", json::kNoNode);
    note_if(chunks.size() == 1, "container.glb-no-bin", json::kNoNode);
    for (std::size_t i = 1; i < chunks.size(); ++i) {
      note_if(i > 1 || chunks[i].type != container::kChunkBin, "container.glb-extra-chunk",
              json::kNoNode);
    }
  }

  void find_buffer(NodeId buffer) {
    const NodeId value = document_.find(buffer, "uri");
    if (value == json::kNoNode || !document_.is_string(value)) return;
    const std::string_view raw = document_.raw(value);
    note_if(raw.starts_with("\"data:application/gltf-buffer"), "uri.data-gltf-buffer", buffer);
    if (raw.starts_with("\"data:")) return features_.note("uri.data-buffer", buffer);
    note_if(context_.container.format == container::Format::glb, "container.glb-external-buffer",
            buffer);
    find_uri(document_.string(value), buffer, "uri.percent-encoded");
  }

  void find_uri(const std::string& uri, NodeId node, std::string_view encoded) {
    const std::size_t colon = uri.find(':');
    const bool scheme = colon != std::string::npos && colon < uri.find('/');
    note_if(scheme, "uri.absolute", node);
    note_if(uri.find('/') != std::string::npos && !scheme, "uri.subfolder", node);
    const std::string path = "/" + uri + "/";
    note_if(path.find("/./") != std::string::npos || path.find("/../") != std::string::npos,
            "uri.dot-segment", node);
    note_if(uri.find(' ') != std::string::npos, "uri.space", node);
    note_if(std::any_of(uri.begin(), uri.end(), [](char c) { return (c & 0x80) != 0; }),
            "uri.non-ascii", node);
    note_if(container::percent_decode(uri) != uri, encoded, node);
  }

  void find_image(NodeId image, const model::ImageData& data) {
    note_if(document_.find(image, "bufferView") != json::kNoNode, "image.buffer-view", image);
    const NodeId value = document_.find(image, "uri");
    if (value != json::kNoNode && document_.is_string(value)) {
      const bool is_data = document_.raw(value).starts_with("\"data:");
      note_if(is_data, "uri.data-image", image);
      if (!is_data) find_uri(document_.string(value), image, "uri.percent-encoded-image");
      if (!is_data && data.header && document_.find(image, "mimeType") == json::kNoNode) {
        find_untyped(image, data.header->format);
      }
    }
    if (data.ktx2) {
      note_if(data.ktx2->model == image::Ktx2Model::etc1s, "image.ktx2-etc1s", image);
      note_if(data.ktx2->model == image::Ktx2Model::uastc, "image.ktx2-uastc", image);
    }
    if (data.header) find_header(image, *data.header);
  }

  // Without a sampler, or without a member of it, a texture is repeated.
  void find_repeated(NodeId texture) {
    const auto image = context_.asset.index(texture, "source", RootArray::images);
    if (!image || !resources_.images[*image].header) return;
    const image::Header& header = *resources_.images[*image].header;
    if (is_power_of_two(header.width) && is_power_of_two(header.height)) return;
    const auto sampler = context_.asset.index(texture, "sampler", RootArray::samplers);
    constexpr std::uint64_t kClamp = 33071;
    for (const std::string_view wrap : {"wrapS", "wrapT"}) {
      const bool clamped =
          sampler &&
          model::unsigned_member(document_, context_.asset.elements(RootArray::samplers)[*sampler],
                                 wrap) == kClamp;
      note_if(!clamped, "image.non-power-of-two-repeated", texture);
    }
  }

  void find_untyped(NodeId image, image::Format format) {
    note_if(format == image::Format::webp, "image.webp-no-mime-type", image);
    note_if(format == image::Format::avif, "image.avif-no-mime-type", image);
    note_if(format == image::Format::ktx2, "image.ktx2-no-mime-type", image);
  }

  void find_header(NodeId image, const image::Header& header) {
    note_if(!is_power_of_two(header.width) || !is_power_of_two(header.height),
            "image.non-power-of-two", image);
    for (const std::string_view name : image::features_of(header)) features_.note(name, image);
  }

  const Context& context_;
  const json::Document& document_;
  const model::ResourceData& resources_;
  Features& features_;
};

}  // namespace

void find_file_features(const Context& context, const model::ResourceData& resources,
                        Features& features) {
  FileFeatures(context, resources, features).find();
}

}  // namespace gltfx::validate
