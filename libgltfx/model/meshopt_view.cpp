// SPDX-License-Identifier: Apache-2.0
#include "model/meshopt_view.hpp"

#include <cstring>
#include <utility>

#include "base/checked.hpp"
#include "base/parallel.hpp"
#include "model/fields.hpp"

namespace gltfx::model {
namespace {

constexpr std::array<std::string_view, 3> kStreamModes{"ATTRIBUTES", "TRIANGLES", "INDICES"};
constexpr std::array<std::string_view, 5> kFilters{"NONE", "OCTAHEDRAL", "QUATERNION",
                                                   "EXPONENTIAL", "COLOR"};

template <typename Enum, std::size_t Count>
std::optional<Enum> named(const std::array<std::string_view, Count>& names, std::string_view name,
                          std::size_t count = Count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (names[i] == name) return static_cast<Enum>(i);
  }
  return std::nullopt;
}

// The older extension has neither the second version of attribute streams nor the last filter.
bool is_older(std::string_view extension) { return extension == kMeshoptExtensions[0]; }

std::optional<meshopt::Layout> read_layout(const json::Document& document, json::NodeId object,
                                           std::string_view extension) {
  const auto count = unsigned_member(document, object, "count");
  const auto stride = unsigned_member(document, object, "byteStride");
  const auto mode = named<meshopt::Mode>(kStreamModes, string_member(document, object, "mode"));
  const bool filtered = document.find(object, "filter") != json::kNoNode;
  const auto filter = named<meshopt::Filter>(
      kFilters, filtered ? string_member(document, object, "filter") : std::string(kFilters[0]),
      is_older(extension) ? kFilters.size() - 1 : kFilters.size());
  if (!count || !stride || !mode || !filter) return std::nullopt;
  const meshopt::Layout layout{*count, *stride, *mode, *filter, is_older(extension) ? 0U : 1U};
  return layout.sound() ? std::optional(layout) : std::nullopt;
}

using meshopt::DecodeError;

// Limit of decoded bytes of an asset: enough for usual sizes and usual compression. A stream of
// zeros decodes to a thousand times its size, and views may share it.
constexpr std::uint64_t kFreeBytes = std::uint64_t{128} << 20U;
constexpr std::uint64_t kBytesPerByte = 8;

// Whether numbers are unchanged; triangles may begin with another corner.
bool is_exact(const meshopt::Layout& layout) {
  return layout.filter == meshopt::Filter::none && layout.mode != meshopt::Mode::triangles;
}

void decode(DecodedStream& job) {
  const meshopt::Layout& layout = job.view.layout;
  const auto size = static_cast<std::size_t>(*layout.decoded_size());
  const std::shared_ptr<std::byte[]> memory(new std::byte[size]);
  const std::span<std::byte> elements(memory.get(), size);
  job.error = meshopt::decode(job.stream.view(), layout, elements);
  if (job.error != DecodeError::none) return;
  job.misfits = meshopt::find_misfits(layout, elements);
  if (job.misfits.count != 0) return;
  meshopt::apply_filter(layout, elements);
  const bool is_copy = job.plain && job.plain->size() == size;
  if (is_copy && std::memcmp(job.plain->view().data(), elements.data(), size) == 0) return;
  job.differs = is_copy && is_exact(layout);
  job.elements = container::Bytes(elements, memory);
}

// The memory of each view is decided here, in order, so that it does not depend on the number of
// threads.
std::vector<DecodedStream> collect(const Asset& asset, const Views& views,
                                   const ResourceData& resources) {
  std::vector<DecodedStream> jobs;
  std::uint64_t left = kFreeBytes;
  for (const auto& buffer : resources.buffers) {
    if (buffer) left += buffer->size() * kBytesPerByte;
  }
  for (std::uint32_t i = 0; i < views.buffer_views.size(); ++i) {
    const BufferView& host = views.buffer_views[i];
    auto view = read_meshopt_view(asset, host.node);
    if (!view) continue;
    auto stream = stream_bytes(*view, resources);
    if (!stream) continue;
    DecodedStream job{i, *view, *std::move(stream), {}};
    if (host.byte_length) job.plain = resources.part(asset.document(), host, 0, *host.byte_length);
    job.error = meshopt::check_size(job.stream.view(), view->layout);
    const auto size = view->layout.decoded_size();
    job.affordable = size && *size <= left;
    if (job.affordable && job.error == DecodeError::none) left -= *size;
    jobs.push_back(std::move(job));
  }
  return jobs;
}

}  // namespace

std::optional<MeshoptView> read_meshopt_view(const Asset& asset, json::NodeId buffer_view) {
  const json::Document& document = asset.document();
  for (const std::string_view extension : kMeshoptExtensions) {
    const json::NodeId object = extension_object(document, buffer_view, extension);
    if (object == json::kNoNode) continue;
    const auto buffer = asset.index(object, "buffer", RootArray::buffers);
    const auto length = unsigned_member(document, object, "byteLength");
    const auto offset = start_of(document, object, unsigned_member(document, object, "byteOffset"));
    const auto layout = read_layout(document, object, extension);
    if (!buffer || !length || !offset || !layout) return std::nullopt;
    return MeshoptView{extension, object, *buffer, *offset, *length, *layout};
  }
  return std::nullopt;
}

std::optional<container::Bytes> stream_bytes(const MeshoptView& view,
                                             const ResourceData& resources) {
  const auto& bytes = resources.buffers[view.buffer];
  if (!bytes || !fits(view.byte_offset, view.byte_length, bytes->size())) return std::nullopt;
  return bytes->part(static_cast<std::size_t>(view.byte_offset),
                     static_cast<std::size_t>(view.byte_length));
}

std::string DecodedStream::problem() const {
  if (error != DecodeError::none) return "has a stream that cannot be decoded";
  if (!affordable) return "has a stream of more elements than may be decoded";
  return misfits.count != 0 ? "has elements that its filter cannot take" : "";
}

std::vector<DecodedStream> decode_streams(const Asset& asset, const Views& views,
                                          const ResourceData& resources, unsigned jobs) {
  std::vector<DecodedStream> streams = collect(asset, views, resources);
  parallel_ordered(
      streams.size(), jobs,
      [&](std::size_t i) {
        if (streams[i].error == DecodeError::none && streams[i].affordable) decode(streams[i]);
      },
      [](std::size_t) {});
  return streams;
}

}  // namespace gltfx::model
