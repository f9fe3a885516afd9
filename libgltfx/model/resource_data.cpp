// SPDX-License-Identifier: Apache-2.0
#include "model/resource_data.hpp"

#include <memory>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/text.hpp"
#include "model/buffer_chunk.hpp"
#include "model/fields.hpp"
#include "model/meshopt_view.hpp"

namespace gltfx::model {
namespace {

using container::Bytes;

using Kind = MissingData::Kind;

std::string_view name_of(Kind kind) {
  if (kind == Kind::image) return "Image";
  return kind == Kind::buffer ? "Buffer" : "Buffer view";
}

class Loader {
 public:
  Loader(const container::Container& container, container::OpenedFiles& files, const Asset& asset,
         const Views& views)
      : container_(container), files_(files), asset_(asset), views_(views) {}

  LoadedResources run(unsigned jobs, const std::vector<bool>* wanted) {
    loaded_.data.origin = files_.resolver().origin();
    const auto& buffers = asset_.elements(RootArray::buffers);
    for (std::size_t i = 0; i < buffers.size(); ++i) {
      loaded_.data.buffers.push_back(load_buffer(buffers[i], i));
    }
    decode_views(jobs);
    const auto& images = asset_.elements(RootArray::images);
    for (std::size_t i = 0; i < images.size(); ++i) {
      const bool left_out = wanted != nullptr && !(*wanted)[i];
      loaded_.data.images.push_back(left_out ? ImageData() : load_image(images[i], i));
    }
    return std::move(loaded_);
  }

 private:
  const json::Document& document() const { return asset_.document(); }

  void note(Kind kind, std::size_t index, std::string why) {
    loaded_.missing.push_back({kind, index, std::move(why)});
  }

  std::optional<Bytes> load_buffer(json::NodeId object, std::size_t index) {
    if (object == json::kNoNode) return std::nullopt;
    const auto length = unsigned_member(document(), object, "byteLength");
    const auto chunk = chunk_of(container_, document(), object, index, version_);
    auto bytes = chunk
                     ? std::optional(container_.bytes.part(static_cast<std::size_t>(chunk->offset),
                                                           static_cast<std::size_t>(chunk->length)))
                     : fetch(Kind::buffer, object, index);
    if (!bytes || !length || bytes->size() >= *length) return bytes;
    note(Kind::buffer, index, "is shorter than its byteLength");
    return std::nullopt;
  }

  // The bytes that `uri` names. Without a URI there is nothing to fetch or report.
  std::optional<Bytes> fetch(Kind kind, json::NodeId object, std::size_t index) {
    const json::NodeId member = document().find(object, "uri");
    if (member == json::kNoNode || !document().is_string(member)) return std::nullopt;
    std::string buffer;
    auto bytes = container::fetch(files_, document().string(member, buffer));
    if (bytes) return *std::move(bytes);
    note(kind, index, fmt::format("cannot be loaded: {}", without_stop(bytes.error().message)));
    return std::nullopt;
  }

  void decode_views(unsigned jobs) {
    for (DecodedStream& stream : decode_streams(asset_, views_, loaded_.data, jobs)) {
      if (!stream.problem().empty()) note(Kind::buffer_view, stream.index, stream.problem());
      if (stream.elements.empty()) continue;
      const bool rounded = stream.view.layout.filter != meshopt::Filter::none;
      auto& views = stream.plain ? loaded_.data.unread_views : loaded_.data.decoded_views;
      views.emplace(views_.buffer_views[stream.index].node,
                    DecodedView{std::move(stream.elements), rounded});
    }
  }

  ImageData load_image(json::NodeId object, std::size_t index) {
    ImageData image;
    if (object == json::kNoNode) return image;
    image.bytes = fetch(Kind::image, object, index);
    const auto view = asset_.index(object, "bufferView", RootArray::buffer_views);
    if (!image.bytes && view) {
      const BufferView& source = views_.buffer_views[*view];
      image.bytes = loaded_.data.part(document(), source, 0, source.byte_length.value_or(0));
    }
    if (image.bytes) read_head(image);
    return image;
  }

  static void read_head(ImageData& image) {
    const image::Sniffed sniffed = image::sniff(image.bytes->view());
    if (sniffed.known) image.format = sniffed.format;
    if (image.format == image::Format::ktx2) {
      image.ktx2 = std::make_shared<const image::Ktx2>(image::read_ktx2(image.bytes->view()));
      if (image.ktx2->is_sound()) image.header = image::header_of(*image.ktx2);
      return;
    }
    const auto header = image::read_header(image.bytes->view());
    if (const auto* read = std::get_if<image::Header>(&header)) image.header = *read;
  }

  const container::Container& container_;
  container::OpenedFiles& files_;
  const Asset& asset_;
  const Views& views_;
  schema::Version version_ = schema::stated_version(asset_.document());
  LoadedResources loaded_;
};

}  // namespace

std::string MissingData::sentence() const {
  return fmt::format("{} {} {}.", name_of(kind), index, why);
}

std::optional<std::uint64_t> start_of(const json::Document& document, json::NodeId object,
                                      const std::optional<std::uint64_t>& byte_offset) {
  if (byte_offset) return byte_offset;
  if (document.has_value(object, "byteOffset")) return std::nullopt;
  return 0;
}

std::optional<container::Bytes> ResourceData::part(const json::Document& document,
                                                   const BufferView& view, std::uint64_t offset,
                                                   std::uint64_t length) const {
  if (!view.byte_length || !fits(offset, length, *view.byte_length)) return std::nullopt;
  if (const DecodedView* own = decoded(view)) {
    if (!fits(offset, length, own->bytes.size())) return std::nullopt;
    return own->bytes.part(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
  }
  if (!view.buffer || *view.buffer >= buffers.size()) return std::nullopt;
  const std::optional<container::Bytes>& bytes = buffers[*view.buffer];
  const auto start = start_of(document, view.node, view.byte_offset);
  if (!bytes || !start) return std::nullopt;
  const Checked begin = checked_add(*start, offset);
  if (!begin || !fits(*begin, length, bytes->size())) return std::nullopt;
  return bytes->part(static_cast<std::size_t>(*begin), static_cast<std::size_t>(length));
}

std::uint64_t ResourceData::buffer_bytes() const {
  std::uint64_t bytes = 0;
  for (const auto& buffer : buffers) {
    if (buffer) bytes = saturating_add(bytes, buffer->size());
  }
  return bytes;
}

const DecodedView* ResourceData::decoded(const BufferView& view) const {
  const auto found = decoded_views.find(view.node);
  return found == decoded_views.end() ? nullptr : &found->second;
}

LoadedResources load_resources(const container::Container& container, container::OpenedFiles& files,
                               const Asset& asset, const Views& views, unsigned jobs,
                               const std::vector<bool>* images) {
  return Loader(container, files, asset, views).run(jobs, images);
}

}  // namespace gltfx::model
