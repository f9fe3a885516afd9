// SPDX-License-Identifier: Apache-2.0
#include "model/meshopt_decode.hpp"

#include <cstring>
#include <memory>
#include <utility>

#include "base/parallel.hpp"

namespace gltfx::model {
namespace {

using meshopt::DecodeError;

// What may be decoded of one asset: all of one of a usual size, and what streams of usual data
// hold. A stream of nothing but zeros holds a thousand times its size, and views may share it.
constexpr std::uint64_t kFreeBytes = std::uint64_t{128} << 20U;
constexpr std::uint64_t kBytesPerByte = 8;

// Only numbers as they were; triangles may begin with another of their corners.
bool is_exact(const meshopt::Layout& layout) {
  return layout.filter == meshopt::Filter::none && layout.mode != meshopt::Mode::triangles;
}

void decode(DecodedStream& job) {
  const meshopt::Layout& layout = job.view.layout;
  const auto size = static_cast<std::size_t>(*layout.decoded_size());
  const auto memory = std::make_shared_for_overwrite<std::byte[]>(size);
  const std::span<std::byte> elements(memory.get(), size);
  job.error = meshopt::decode(job.stream.view(), layout, elements);
  if (job.error != DecodeError::none) return;
  job.misfits = meshopt::find_misfits(layout, elements);
  if (job.misfits.count != 0) return;
  meshopt::apply_filter(layout, elements);
  if (!job.plain) {
    job.elements = container::Bytes(elements, memory);
  } else if (is_exact(layout) && job.plain->size() == size) {
    job.differs = std::memcmp(job.plain->view().data(), elements.data(), size) != 0;
  }
}

// What memory there may be is settled here, view by view, whatever the number of threads.
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
