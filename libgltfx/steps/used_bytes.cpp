// SPDX-License-Identifier: Apache-2.0
#include "steps/used_bytes.hpp"

#include <algorithm>

#include "change/shared_bytes.hpp"
#include "model/asset.hpp"

namespace gltfx::steps {

using change::BufferUser;
using change::ByteRange;

ByteRanges without(const ByteRanges& ranges, const ByteRanges& taken) {
  ByteRanges left;
  auto next = taken.begin();
  for (ByteRange range : ranges) {
    while (next != taken.end() && next->end <= range.begin) ++next;
    for (auto at = next; at != taken.end() && at->begin < range.end; ++at) {
      if (at->begin > range.begin) left.push_back({range.begin, at->begin});
      range.begin = std::min(at->end, range.end);
    }
    if (range.begin < range.end) left.push_back(range);
  }
  return left;
}

std::uint64_t size_of(const ByteRanges& ranges) {
  std::uint64_t size = 0;
  for (const ByteRange& range : ranges) size += range.end - range.begin;
  return size;
}

UsedBytes::UsedBytes(const model::OpenedAsset& asset, const schema::Set& schemas)
    : graph(asset.document(), schemas),
      users(change::buffer_users(graph)),
      buffers(model::Asset(asset.document()).count(model::RootArray::buffers)) {
  if (!users) return;
  for (const BufferUser& user : *users) ranges_[user.buffer].push_back(user.bytes);
  for (auto& [buffer, ranges] : ranges_) change::add_ranges(ranges, {});
}

ByteRanges UsedBytes::of(const std::vector<std::uint64_t>& wanted) const {
  ByteRanges all;
  for (const std::uint64_t buffer : wanted) {
    const auto found = ranges_.find(buffer);
    if (found != ranges_.end()) all.insert(all.end(), found->second.begin(), found->second.end());
  }
  if (wanted.size() > 1) change::add_ranges(all, {});
  return all;
}

}  // namespace gltfx::steps
