// SPDX-License-Identifier: Apache-2.0
#include "steps/dedup_content.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "steps/geometry_input.hpp"
#include "steps/stored_size.hpp"

namespace gltfx::steps {
namespace {

using container::Bytes;
using json::NodeId;
using model::RootArray;

// The size of an element without padding.
std::uint64_t stored_element(const model::AccessorData& data) {
  return std::uint64_t{data.components()} * model::component_size(data.format().component);
}

std::string text_of(const Hash128& hash) { return fmt::format("{:x}.{:x}", hash.high, hash.low); }

// A multiple of all bytes, and a minimum for small assets that share many bytes.
std::uint64_t readable(const StepInput& input, const model::ResourceData& resources) {
  constexpr std::uint64_t kTimes = 8, kLeast = std::uint64_t{256} << 20U;
  std::uint64_t bytes = stored_size(input.asset);
  for (const auto& [view, decoded] : resources.decoded_views) bytes += decoded.bytes.size();
  return kLeast + kTimes * bytes;
}

}  // namespace

DedupContent::DedupContent(const StepInput& input, const graph::Graph& graph,
                           const model::Asset& elements)
    : input_(input),
      elements_(elements),
      document_(input.asset.document()),
      bytes_(elements, input.asset.container(), input.asset.resolver()),
      resources_(load_plain_buffers(input, elements)),
      budget_(readable(input, resources_)) {
  const auto users = change::buffer_users(graph);
  if (!users) return;
  users_known_ = true;
  for (const change::BufferUser& user : *users) {
    users_[graph.tree().root_element(user.object)].push_back(user);
  }
}

bool DedupContent::take(std::optional<std::uint64_t> bytes) {
  if (bytes && budget_.take(Checked(*bytes))) return true;
  exhausted_ = true;
  return false;
}

// `place`: a key that is unique for these bytes.
std::optional<std::string> DedupContent::hash_of(const Bytes& bytes, std::string place) {
  const auto [known, is_new] = hashes_.try_emplace(std::move(place));
  if (!is_new) return known->second;
  if (take(bytes.size())) {
    known->second = text_of(hash_bytes(bytes.text()));
    return known->second;
  }
  hashes_.erase(known);
  return std::nullopt;
}

std::optional<std::string> DedupContent::hash_of_image(std::uint64_t index) {
  const auto bytes = bytes_.image(index);
  if (!bytes) {
    input_.unread.push_back(
        {fmt::format("/images/{}", index), half_sentence(bytes.error().message)});
    return std::nullopt;
  }
  const NodeId image = elements_.elements(RootArray::images)[index];
  const NodeId uri = document_.find(image, "uri");
  if (uri != json::kNoNode) return hash_of(*bytes, std::string(document_.raw(uri)));
  const auto view = elements_.index(image, "bufferView", RootArray::buffer_views);
  return hash_of(*bytes, fmt::format("view {}", view.value_or(UINT32_MAX)));
}

bool DedupContent::same_images(std::uint64_t one, std::uint64_t other) {
  const auto ours = bytes_.image(one);
  const auto theirs = bytes_.image(other);
  return ours && theirs && take(ours->size()) && container::same_bytes(*ours, *theirs);
}

const std::vector<change::BufferUser>& DedupContent::buffer_users(NodeId element) const {
  const auto found = users_.find(element);
  return found == users_.end() ? no_users_ : found->second;
}

std::optional<Bytes> DedupContent::bytes_of(const change::BufferUser& user) {
  if (user.buffer >= elements_.count(RootArray::buffers)) return std::nullopt;
  const auto bytes = bytes_.buffer(user.buffer);
  if (!bytes || user.bytes.end > bytes->size()) return std::nullopt;
  return bytes->part(user.bytes.begin, user.bytes.end - user.bytes.begin);
}

// Whether the location of a view without bytes counts. It does not if an extension provides the
// bytes.
bool DedupContent::has_place_of_its_own(NodeId view, const change::BufferUser& user) const {
  return user.object != view || buffer_users(view).size() < 2;
}

std::optional<std::string> DedupContent::hash_of_view(NodeId view) {
  std::string hash;
  for (const change::BufferUser& user : buffer_users(view)) {
    if (const auto bytes = bytes_of(user)) {
      const auto part = hash_of(*bytes, fmt::format("buffer {} from {} to {}", user.buffer,
                                                    user.bytes.begin, user.bytes.end));
      if (!part) return std::nullopt;
      hash += *part;
    } else if (has_place_of_its_own(view, user)) {
      return std::nullopt;
    }
    hash += ';';
  }
  return hash;
}

bool DedupContent::same_views(NodeId one, NodeId other) {
  const auto& ours = buffer_users(one);
  const auto& theirs = buffer_users(other);
  if (ours.size() != theirs.size()) return false;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const auto here = bytes_of(ours[i]);
    const auto there = bytes_of(theirs[i]);
    if (here.has_value() != there.has_value()) return false;
    if (!here) continue;
    if (!take(here->size()) || !container::same_bytes(*here, *there)) return false;
  }
  return true;
}

bool DedupContent::has_elements(std::uint32_t index) const {
  const model::Views& views = input_.asset.views();
  const model::Accessor& accessor = views.accessors[index];
  const model::BufferView* view = views.view_of(accessor);
  return view && !resources_.unread_views.contains(view->node) && accessor.count &&
         accessor.format.known() && model::is_core_component(accessor.format.component) &&
         document_.find(accessor.node, "extensions") == json::kNoNode;
}

std::optional<model::AccessorData> DedupContent::open(std::uint32_t accessor) const {
  return model::AccessorData::open(elements_, input_.asset.views(), resources_,
                                   input_.asset.views().accessors[accessor],
                                   model::Malformed::unusable);
}

std::optional<std::string> DedupContent::hash_of_accessor(std::uint32_t index) {
  if (!has_elements(index)) return std::nullopt;
  const auto data = open(index);
  if (!data) return std::nullopt;
  const model::Accessor& accessor = input_.asset.views().accessors[index];
  const auto [known, is_new] = accessor_hashes_.try_emplace(
      {*accessor.buffer_view, accessor.sparse, accessor.byte_offset.value_or(0), data->count(),
       static_cast<unsigned>(accessor.format.type),
       static_cast<unsigned>(accessor.format.component)});
  if (!is_new) return known->second;
  const std::uint64_t stride = stored_element(*data);
  if (!take(checked_mul(stride, data->count()))) {
    accessor_hashes_.erase(known);
    return std::nullopt;
  }
  HashParts parts;
  std::vector<std::byte> block(data->block_elements() * stride);
  std::uint64_t replaced = 0;
  for (std::uint64_t first = 0; first < data->count(); first += data->block_elements()) {
    const auto count = static_cast<std::size_t>(
        std::min<std::uint64_t>(data->block_elements(), data->count() - first));
    data->read(block.data(), first, count, replaced);
    const auto size = static_cast<std::size_t>(count * stride);
    parts.add(hash_bytes({reinterpret_cast<const char*>(block.data()), size}));
  }
  known->second = text_of(parts.finish());
  return known->second;
}

bool DedupContent::same_accessors(std::uint32_t one, std::uint32_t other) {
  const auto ours = open(one);
  const auto theirs = open(other);
  if (!ours || !theirs || ours->count() != theirs->count()) return false;
  const std::uint64_t stride = stored_element(*ours);
  if (!take(checked_mul(stride, ours->count()))) return false;
  std::vector<std::byte> here(ours->block_elements() * stride), there(here.size());
  std::uint64_t replaced_here = 0, replaced_there = 0;
  for (std::uint64_t first = 0; first < ours->count(); first += ours->block_elements()) {
    const auto count = static_cast<std::size_t>(
        std::min<std::uint64_t>(ours->block_elements(), ours->count() - first));
    ours->read(here.data(), first, count, replaced_here);
    theirs->read(there.data(), first, count, replaced_there);
    if (here != there) return false;
  }
  return true;
}

}  // namespace gltfx::steps
