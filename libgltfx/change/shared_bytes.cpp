// SPDX-License-Identifier: Apache-2.0
#include "change/shared_bytes.hpp"

#include <algorithm>
#include <utility>

#include "base/checked.hpp"

namespace gltfx::change {
namespace {

constexpr std::uint64_t kMostSteps = 1U << 26U;

using Ranges = std::vector<ByteRange>;

// Whether an element begins before the range ends, and ends after the range begins.
bool is_read(const ByteRead& read, const ByteRange& range) {
  const std::uint64_t begin = std::max(range.begin, read.begin);
  if (read.count == 0 || read.size == 0 || range.end <= begin) return false;
  const std::uint64_t step = std::max<std::uint64_t>(read.stride, 1);
  const std::uint64_t element = std::min((begin - read.begin) / step, read.count - 1);
  const std::uint64_t at = saturating_add(read.begin, element * step);
  if (saturating_add(at, read.size) > begin) return true;
  return element + 1 < read.count && saturating_add(at, step) < range.end;
}

std::uint64_t end_of(const ByteRead& read) {
  const Checked length = checked_mul(read.count - 1, read.stride);
  return length ? saturating_add(saturating_add(read.begin, *length), read.size) : UINT64_MAX;
}

}  // namespace

void FileReads::add(const FileReads& more) {
  all = all || more.all;
  parts.insert(parts.end(), more.parts.begin(), more.parts.end());
}

Ranges ranges_read(const FileReads& reads, Ranges ranges) {
  if (reads.all) return ranges;
  std::vector<bool> found(ranges.size());
  std::uint64_t steps = 0;
  for (const ByteRead& read : reads.parts) {
    if (read.count == 0) continue;
    const std::uint64_t end = end_of(read);
    auto at = std::partition_point(ranges.begin(), ranges.end(),
                                   [&](const ByteRange& range) { return range.end <= read.begin; });
    for (; at != ranges.end() && at->begin < end; ++at) {
      if (++steps > kMostSteps) return ranges;
      if (is_read(read, *at)) found[static_cast<std::size_t>(at - ranges.begin())] = true;
    }
  }
  std::size_t i = 0;
  std::erase_if(ranges, [&](const ByteRange&) { return !found[i++]; });
  return ranges;
}

Ranges ranges_touching(Ranges ranges, const Ranges& other) {
  auto at = other.begin();
  std::erase_if(ranges, [&](const ByteRange& range) {
    while (at != other.end() && at->end <= range.begin) ++at;
    return at == other.end() || at->begin >= range.end;
  });
  return ranges;
}

void add_ranges(Ranges& list, const Ranges& more) {
  list.insert(list.end(), more.begin(), more.end());
  std::sort(list.begin(), list.end(),
            [](const ByteRange& a, const ByteRange& b) { return a.begin < b.begin; });
  Ranges merged;
  for (const ByteRange& range : list) {
    if (!merged.empty() && range.begin <= merged.back().end) {
      merged.back().end = std::max(merged.back().end, range.end);
    } else {
      merged.push_back(range);
    }
  }
  list = std::move(merged);
}

Ranges differences(std::string_view one, std::string_view other) {
  Ranges ranges;
  const std::size_t common = std::min(one.size(), other.size());
  const auto begin = one.begin();
  for (std::size_t at = 0; at < common;) {
    const auto [first, unused] = std::mismatch(begin + static_cast<std::ptrdiff_t>(at),
                                               begin + static_cast<std::ptrdiff_t>(common),
                                               other.begin() + static_cast<std::ptrdiff_t>(at));
    at = static_cast<std::size_t>(first - begin);
    if (at == common) break;
    std::size_t end = at + 1;
    while (end < common && one[end] != other[end]) ++end;
    ranges.push_back({at, end});
    at = end;
  }
  if (one.size() != other.size()) {
    add_ranges(ranges, {{common, std::max(one.size(), other.size())}});
  }
  return ranges;
}

MergedFile merge_changes(std::string_view before, const std::vector<FileUser>& users) {
  MergedFile merged{std::string(before), {}};
  std::vector<Ranges> against(users.size());
  for (std::size_t i = 0; i < users.size(); ++i) {
    const std::string_view wanted = users[i].wanted;
    if (!users[i].changes || wanted.data() == before.data()) continue;
    if (wanted.size() > merged.content.size()) merged.content.resize(wanted.size());
    for (const ByteRange& range : differences(before, wanted)) {
      for (std::uint64_t at = range.begin; at < std::min<std::uint64_t>(range.end, wanted.size());
           ++at) {
        const bool first = at >= before.size() || merged.content[at] == before[at];
        if (!first && merged.content[at] != wanted[at]) add_ranges(against[i], {{at, at + 1}});
        merged.content[at] = wanted[at];
      }
    }
  }
  const Ranges changed = differences(before, merged.content);
  for (std::size_t i = 0; i < users.size() && !changed.empty(); ++i) {
    const Ranges unwanted = users[i].wanted.data() == before.data()
                                ? changed
                                : differences(users[i].wanted, merged.content);
    // Bytes that no user changes do not conflict with a user that only reads.
    add_ranges(against[i], ranges_read(users[i].reads, ranges_touching(unwanted, changed)));
    if (!against[i].empty()) merged.conflicts.push_back({i, std::move(against[i])});
  }
  return merged;
}

}  // namespace gltfx::change
