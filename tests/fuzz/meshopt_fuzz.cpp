// SPDX-License-Identifier: Apache-2.0
// Any bytes as a stream of any layout. Our decoders take nothing that the library refuses, and
// where both decode they give the same. Four bytes are the layout, the others the stream.
#include <cstdlib>
#include <vector>

#include <meshoptimizer.h>

#include "model/meshopt.hpp"

namespace {

using namespace gltfx::model::meshopt;
using Elements = std::vector<std::byte>;

constexpr std::size_t kHeader = 4;
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 20U;

void require(bool promise) {
  if (!promise) std::abort();
}

Layout layout_of(const std::uint8_t* data) {
  Layout layout;
  layout.mode = static_cast<Mode>(data[0] % 3);
  layout.filter = static_cast<Filter>(data[0] / 3 % 5);
  layout.stride = data[1] == 0 ? 256U : data[1];
  layout.count = data[2] + 256U * data[3];
  layout.newest_version = data[0] < 128 ? 1 : 0;
  return layout;
}

bool library_decodes(std::span<const std::byte> stream, const Layout& layout, Elements& to) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(stream.data());
  const auto count = static_cast<std::size_t>(layout.count);
  const auto stride = static_cast<std::size_t>(layout.stride);
  if (layout.mode == Mode::attributes) {
    return meshopt_decodeVertexBuffer(to.data(), count, stride, bytes, stream.size()) == 0;
  }
  if (layout.mode == Mode::triangles) {
    return meshopt_decodeIndexBuffer(to.data(), count, stride, bytes, stream.size()) == 0;
  }
  return meshopt_decodeIndexSequence(to.data(), count, stride, bytes, stream.size()) == 0;
}

DecodeError own(std::span<const std::byte> stream, const Layout& layout, Elements& to) {
  if (layout.mode == Mode::triangles) return decode_triangles(stream, layout, to);
  if (layout.mode == Mode::indices) return decode_indices(stream, layout, to);
  return decode_attributes(stream, layout, to);
}

void compare(std::span<const std::byte> stream, const Layout& layout) {
  if (check_size(stream, layout) != DecodeError::none || stream.front() == std::byte{0xa1}) return;
  Elements ours(static_cast<std::size_t>(*layout.decoded_size())), theirs(ours.size());
  const bool taken = own(stream, layout, ours) == DecodeError::none;
  const bool library = library_decodes(stream, layout, theirs);
  if (layout.mode == Mode::attributes) require(taken == library);
  if (!taken) return;
  require(library && ours == theirs);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < kHeader) return 0;
  const Layout layout = layout_of(data);
  if (!layout.sound() || *layout.decoded_size() > kMostBytes) return 0;
  // Memory of its own, so that reading outside is seen.
  const auto* first = reinterpret_cast<const std::byte*>(data);
  const Elements stream(first + kHeader, first + size);
  compare(stream, layout);
  Elements elements(static_cast<std::size_t>(*layout.decoded_size()));
  if (decode(stream, layout, elements) != DecodeError::none) return 0;
  const Misfits misfits = find_misfits(layout, elements);
  require(misfits.count <= layout.count && (misfits.count == 0 || misfits.first < layout.count));
  if (misfits.count == 0) apply_filter(layout, elements);
  return 0;
}
