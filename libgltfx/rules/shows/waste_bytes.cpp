// SPDX-License-Identifier: Apache-2.0
// Bytes that are stored again, and bytes that nothing refers to.
#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/codes.hpp"
#include "image/header.hpp"
#include "model/fields.hpp"
#include "model/memory_budget.hpp"
#include "model/meshopt_view.hpp"
#include "rules/collector.hpp"
#include "rules/core/use.hpp"
#include "rules/finding.hpp"
#include "rules/shows/shows.hpp"
#include "rules/shows/waste.hpp"

namespace gltfx::validate {
namespace {

using model::RootArray;

// --- Equal bytes ---

struct Piece {
  std::uint32_t index = 0;   ///< of the object
  std::uint64_t format = 0;  ///< pieces of different formats are never equal
  std::string_view bytes;
  std::array<std::uint64_t, 3> sample{};  ///< of the bytes: first, middle, last
  std::uint64_t key = 0;                  ///< the same for all that kind_of() is equal
};

std::array<std::uint64_t, 3> sample_of(std::string_view bytes) {
  std::array<std::uint64_t, 3> sample{};
  const std::size_t size = std::min(bytes.size(), sizeof(std::uint64_t));
  std::memcpy(&sample[0], bytes.data(), size);
  std::memcpy(&sample[1], bytes.data() + (bytes.size() - size) / 2, size);
  std::memcpy(&sample[2], bytes.data() + bytes.size() - size, size);
  return sample;
}

auto kind_of(const Piece& piece) {
  return std::tuple(piece.format, piece.bytes.size(), piece.sample);
}

std::uint64_t key_of(const Piece& piece) {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15;
  std::uint64_t key = piece.format ^ piece.bytes.size() << 40U;
  for (const std::uint64_t each : piece.sample) {
    key = (key ^ each) * kOdd;
    key ^= key >> 29U;
  }
  return key;
}

struct Pair {
  Piece copy, first;
};

// Compares bytes at most four times over: objects may share bytes a thousandfold.
class EqualPieces {
 public:
  /// `stored`: the bytes that all pieces are in.
  explicit EqualPieces(std::uint64_t stored)
      : left_(
            saturating_add(checked_mul(stored, 4).value_or(UINT64_MAX), std::uint64_t{1} << 26U)) {}

  /// By index of the copies.
  std::vector<Pair> find(std::vector<Piece> pieces) {
    for (Piece& piece : pieces) {
      piece.sample = sample_of(piece.bytes);
      piece.key = key_of(piece);
    }
    std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
      return a.key != b.key ? a.key < b.key : a.index < b.index;
    });
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < pieces.size();) {
      std::size_t end = i + 1;
      while (end < pieces.size() && pieces[end].key == pieces[i].key) ++end;
      find_in(pieces, i, end, pairs);
      i = end;
    }
    std::sort(pairs.begin(), pairs.end(),
              [](const Pair& a, const Pair& b) { return a.copy.index < b.copy.index; });
    return pairs;
  }

 private:
  static constexpr std::size_t kMostFirsts = 4;  // with equal samples

  void find_in(const std::vector<Piece>& pieces, std::size_t begin, std::size_t end,
               std::vector<Pair>& pairs) {
    std::vector<const Piece*> firsts{&pieces[begin]};
    for (std::size_t i = begin + 1; i < end; ++i) {
      const auto same = std::find_if(firsts.begin(), firsts.end(), [&](const Piece* first) {
        return kind_of(*first) == kind_of(pieces[i]) && is_equal(first->bytes, pieces[i].bytes);
      });
      if (same != firsts.end()) {
        pairs.push_back({pieces[i], **same});
      } else if (firsts.size() < kMostFirsts) {
        firsts.push_back(&pieces[i]);
      }
    }
  }

  bool is_equal(std::string_view a, std::string_view b) {
    if (a.data() == b.data()) return true;
    return left_.take(Checked(a.size())) && a == b;
  }

  model::MemoryBudget left_;
};

// The number of bytes in the pieces, each counted once.
std::uint64_t bytes_in(std::vector<std::string_view> pieces) {
  const std::less<> before;
  std::sort(pieces.begin(), pieces.end(),
            [&](std::string_view a, std::string_view b) { return before(a.data(), b.data()); });
  std::uint64_t bytes = 0;
  const char* end = nullptr;
  for (const std::string_view each : pieces) {
    const char* own_end = each.data() + each.size();
    if (end != nullptr && !before(end, own_end)) continue;
    const bool overlaps = end != nullptr && before(each.data(), end);
    bytes += static_cast<std::uint64_t>(own_end - (overlaps ? end : each.data()));
    end = own_end;
  }
  return bytes;
}

bool overlap(std::string_view a, std::string_view b) {
  const std::less<> before;
  return before(a.data(), b.data() + b.size()) && before(b.data(), a.data() + a.size());
}

// "image 1 equals image 0, image 2 equals image 0 and so on".
std::string places(const Context& context, RootArray array, const std::vector<Pair>& pairs) {
  constexpr std::size_t kMost = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, pairs.size()); ++i) {
    text += fmt::format("{}{} equals {}", i == 0 ? "" : ", ",
                        object_label(context, array, pairs[i].copy.index),
                        object_label(context, array, pairs[i].first.index));
  }
  return pairs.size() > kMost ? text + " and so on" : text;
}

// --- Images ---

void check_images(DataPhase& phase) {
  const Context& context = phase.context;
  const auto& images = phase.resources.images;
  if (images.size() < 2) return;
  std::vector<Piece> pieces;
  std::vector<std::string_view> stored;
  for (std::uint32_t i = 0; i < images.size(); ++i) {
    if (!images[i].bytes || images[i].bytes->size() == 0) continue;
    stored.push_back(images[i].bytes->text());
    pieces.push_back({i, 0, stored.back()});
  }
  const std::vector<Pair> pairs = EqualPieces(bytes_in(std::move(stored))).find(std::move(pieces));
  if (pairs.empty()) return;
  const auto& objects = context.asset.elements(RootArray::images);
  std::set<std::string> files;
  std::uint64_t bytes = 0;
  std::uint64_t memory = 0;
  for (const Pair& pair : pairs) {
    const std::string uri = model::string_member(context.document, objects[pair.copy.index], "uri");
    const bool again = uri.empty() ? !overlap(pair.copy.bytes, pair.first.bytes)
                                   : uri != model::string_member(context.document,
                                                                 objects[pair.first.index], "uri");
    if (again && (uri.empty() || files.insert(uri).second)) bytes += pair.copy.bytes.size();
    const auto& header = images[pair.copy.index].header;
    if (!header) continue;
    constexpr std::uint64_t kTexelBytes = 4;
    const Checked texels = checked_mul(image::texels_of(*header), kTexelBytes);
    memory = saturating_add(memory, texels.value_or(UINT64_MAX));
  }
  constexpr std::uint64_t kWorthMemory = 65536;
  if (bytes < kWorthBytes && memory < kWorthMemory) return;
  report_waste(phase, RootArray::images, pairs.front().copy.index, Code::DUPLICATE_IMAGES,
               fmt::format("{} of {} images {} the bytes of an earlier one ({}): {} bytes are "
                           "stored again, and the copies take {} bytes of memory.",
                           pairs.size(), images.size(), pairs.size() == 1 ? "has" : "have",
                           places(context, RootArray::images, pairs), bytes, memory),
               "`gltfx convert --dedup` stores each image once");
}

// --- Accessors ---

// The elements, if they are stored without gaps.
std::optional<std::string_view> elements_of(const DataPhase& phase,
                                            const model::Accessor& accessor) {
  const model::BufferView* view = phase.context.views.view_of(accessor);
  const std::uint64_t size = model::element_size(accessor.format);
  const bool plain = view != nullptr && view->node != json::kNoNode && accessor.count &&
                     accessor.sparse == json::kNoNode && size > 0 &&
                     model::packed_stride(accessor.format) == size &&
                     view->byte_stride.value_or(size) == size &&
                     phase.context.document.find(view->node, "extensions") == json::kNoNode;
  if (!plain) return std::nullopt;
  const Checked length = checked_mul(*accessor.count, size);
  if (!length) return std::nullopt;
  const auto bytes = phase.resources.part(phase.context.document, *view,
                                          accessor.byte_offset.value_or(0), *length);
  if (!bytes || bytes->size() == 0) return std::nullopt;
  return bytes->text();
}

// Format and target of the view: vertices and keyframes are not stored together.
std::uint64_t format_key(const Context& context, const model::Accessor& accessor) {
  const model::Format& format = accessor.format;
  return static_cast<std::uint64_t>(context.views.view_of(accessor)->target) << 40U |
         static_cast<std::uint64_t>(format.type) << 32U |
         static_cast<std::uint64_t>(format.component) << 1U | (format.normalized ? 1U : 0U);
}

void check_accessors(DataPhase& phase) {
  const Context& context = phase.context;
  const auto& accessors = context.views.accessors;
  if (accessors.size() < 2) return;
  std::vector<Piece> pieces;
  for (std::uint32_t i = 0; i < accessors.size(); ++i) {
    const auto elements = elements_of(phase, accessors[i]);
    if (!elements) continue;
    pieces.push_back({i, format_key(context, accessors[i]), *elements});
  }
  const std::uint64_t all = phase.resources.buffer_bytes();
  std::vector<Pair> pairs = EqualPieces(all).find(std::move(pieces));
  std::erase_if(pairs, [](const Pair& pair) { return overlap(pair.copy.bytes, pair.first.bytes); });
  std::vector<std::string_view> copies;
  for (const Pair& pair : pairs) copies.push_back(pair.copy.bytes);
  const std::uint64_t bytes = bytes_in(std::move(copies));
  if (!is_worth(phase, bytes)) return;
  report_waste(
      phase, RootArray::accessors, pairs.front().copy.index, Code::DUPLICATE_ACCESSORS,
      fmt::format("{} of {} accessors {} the elements of an earlier one ({}): {} bytes, {:.0f} % "
                  "of all buffers, are stored again.",
                  pairs.size(), accessors.size(), pairs.size() == 1 ? "has" : "have",
                  places(context, RootArray::accessors, pairs), bytes,
                  100 * static_cast<double>(bytes) / static_cast<double>(all)),
      "`gltfx convert --dedup` stores equal elements once");
}

// --- Bytes without a buffer view ---

struct Range {
  std::uint64_t begin = 0, end = 0;
};

std::vector<std::vector<Range>> ranges_of(const DataPhase& phase) {
  std::vector<std::vector<Range>> ranges(phase.resources.buffers.size());
  const auto add = [&](std::uint64_t buffer, std::uint64_t begin, std::uint64_t length) {
    ranges[static_cast<std::size_t>(buffer)].push_back({begin, saturating_add(begin, length)});
  };
  for (const model::BufferView& view : phase.context.views.buffer_views) {
    if (view.node == json::kNoNode) continue;
    if (view.buffer) add(*view.buffer, view.byte_offset.value_or(0), view.byte_length.value_or(0));
    if (phase.context.document.find(view.node, "extensions") == json::kNoNode) continue;
    const auto stream = model::read_meshopt_view(phase.context.asset, view.node);
    if (stream) add(stream->buffer, stream->byte_offset, stream->byte_length);
  }
  return ranges;
}

// Bytes below `size` outside of the ranges, without padding.
std::uint64_t bytes_outside(std::vector<Range>& ranges, std::uint64_t size) {
  constexpr std::uint64_t kPadding = 255;  // buffer views may be aligned for a GPU
  std::sort(ranges.begin(), ranges.end(),
            [](const Range& a, const Range& b) { return a.begin < b.begin; });
  std::uint64_t bytes = 0;
  std::uint64_t end = 0;
  const auto skip_to = [&](std::uint64_t begin) {
    if (begin > end && begin - end > kPadding) bytes += begin - end;
  };
  for (const Range& range : ranges) {
    skip_to(std::min(range.begin, size));
    end = std::max(end, range.end);
  }
  skip_to(size);
  return bytes;
}

// A file beside the asset, which others may read, too.
bool is_beside(const Context& context, json::NodeId buffer) {
  const json::NodeId uri = context.document.find(buffer, "uri");
  return uri != json::kNoNode && context.document.is_string(uri) &&
         !context.document.string(uri).starts_with("data:");
}

void check_unused_bytes(DataPhase& phase) {
  const Context& context = phase.context;
  if (context.views.buffer_views.empty() || !unseen_user(context).empty()) return;
  std::vector<std::vector<Range>> ranges = ranges_of(phase);
  std::uint64_t bytes = 0;
  std::optional<std::size_t> first;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const json::NodeId object = context.asset.elements(RootArray::buffers)[i];
    if (ranges[i].empty() || object == json::kNoNode || !phase.resources.buffers[i]) continue;
    const auto declared = model::unsigned_member(context.document, object, "byteLength");
    if (!declared || is_beside(context, object)) continue;
    const std::uint64_t own = bytes_outside(
        ranges[i], std::min<std::uint64_t>(*declared, phase.resources.buffers[i]->size()));
    bytes += own;
    if (own > 0 && !first) first = i;
  }
  if (!first || !is_worth(phase, bytes)) return;
  report_waste(phase, RootArray::buffers, *first, Code::UNUSED_BYTES,
               fmt::format("{} of {} bytes are outside of all buffer views.", bytes,
                           phase.resources.buffer_bytes()),
               "export again; no option of `gltfx convert` removes bytes that nothing ever used");
}

}  // namespace

void check_waste_bytes(DataPhase& phase) {
  const auto wants = [&](Code code) { return is_enabled(phase.context.options, code); };
  if (wants(Code::DUPLICATE_IMAGES)) check_images(phase);
  if (wants(Code::DUPLICATE_ACCESSORS)) check_accessors(phase);
  if (wants(Code::UNUSED_BYTES)) check_unused_bytes(phase);
}

}  // namespace gltfx::validate
