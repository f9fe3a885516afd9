// SPDX-License-Identifier: Apache-2.0
// AVIF (AV1 Image File Format 1.1) to the items of its meta box: boxes of ISO/IEC 14496-12, items
// and properties of ISO/IEC 23008-12. The checks: boxes are inside the file, there is a primary
// item of AV1 or a grid of such items, and it has an extent. Not checked, with the reason:
// - the places of the data of items, the AV1 in them: they must be decoded, which `--pixels` does;
// - profiles, essential flags, properties of other items, brands beyond the first known: readers
//   ignore them;
// - tracks of animations: their presence is reported.
#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "image/cursor.hpp"

namespace gltfx::image {
namespace {

using Bytes = std::span<const std::byte>;
using namespace std::literals;

struct Box {
  std::string_view type;  // four letters
  Bytes content;
};

std::string_view text_of(Bytes bytes, std::size_t offset, std::size_t length) {
  return {reinterpret_cast<const char*>(bytes.data()) + offset, length};
}

// Removes and returns the box at the start of `bytes`; nothing at their end, or if the box is
// longer than the bytes.
std::optional<Box> next_box(Bytes& bytes) {
  Cursor at(bytes);
  std::uint64_t size = at.be32();
  at.skip(4);
  if (size == 1) {
    size = std::uint64_t{at.be32()} << 32U;
    size |= at.be32();
  } else if (size == 0) {
    size = bytes.size();
  }
  if (!at.ok() || size < at.position() || size > bytes.size()) return std::nullopt;
  const Bytes whole = bytes.first(static_cast<std::size_t>(size));
  bytes = bytes.subspan(whole.size());
  return Box{text_of(whole, 4, 4), whole.subspan(at.position())};
}

template <typename Use>
void for_each_box(Bytes bytes, const Use& use) {
  while (const auto box = next_box(bytes)) use(*box);
}

// Boxes that begin with a version and 24 flags.
struct Full {
  Cursor at;
  std::uint8_t version;
  std::uint32_t flags;

  explicit Full(Bytes content)
      : at(content), version(at.u8()), flags(std::uint32_t{at.be16()} << 8U) {
    flags |= at.u8();
  }
  Bytes rest(Bytes content) const { return content.subspan(at.position()); }
  // A number of 16 bits, or of 32 bits from version `wide_from` on.
  std::uint32_t id(std::uint8_t wide_from) { return version < wide_from ? at.be16() : at.be32(); }
};

// The items of a meta box.
struct Items {
  std::uint32_t primary = 0;
  std::map<std::uint32_t, std::string_view> types;              // by item
  std::vector<Box> properties;                                  // numbered from 1
  std::map<std::uint32_t, std::vector<std::uint16_t>> of_item;  // properties
  std::multimap<std::uint32_t, std::uint32_t> auxiliary;        // of an item
  bool premultiplied = false;
  bool data = false;  // some data is in the meta box

  const Box* property(std::uint32_t item, std::string_view type) const {
    const auto found = of_item.find(item);
    if (found == of_item.end()) return nullptr;
    for (const std::uint16_t number : found->second) {
      if (number < 1 || number > properties.size()) continue;
      if (properties[number - 1U].type == type) return &properties[number - 1U];
    }
    return nullptr;
  }
};

void read_types(Bytes content, Items& items) {
  Full full(content);
  full.id(1);  // the number of entries, which their end gives as well
  for_each_box(full.rest(content), [&](const Box& box) {
    if (box.type != "infe") return;
    Full entry(box.content);
    if (entry.version < 2) return;  // has no type
    const std::uint32_t id = entry.id(3);
    entry.at.skip(2);
    const std::size_t begin = entry.at.position();
    if (box.content.size() >= begin + 4) items.types[id] = text_of(box.content, begin, 4);
  });
}

void read_references(Bytes content, Items& items) {
  Full full(content);
  for_each_box(full.rest(content), [&](const Box& box) {
    Cursor at(box.content);
    const auto id = [&] { return full.version == 0 ? at.be16() : at.be32(); };
    const std::uint32_t from = id();
    const std::uint32_t count = at.be16();
    for (std::uint32_t i = 0; i < count && at.ok(); ++i) {
      const std::uint32_t to = id();
      if (box.type == "auxl") items.auxiliary.emplace(to, from);
    }
    if (box.type == "prem") items.premultiplied = true;
  });
}

void read_associations(Bytes content, Items& items) {
  Full full(content);
  const bool wide = (full.flags & 1U) != 0;
  const std::uint32_t count = full.at.be32();
  for (std::uint32_t i = 0; i < count && full.at.ok(); ++i) {
    auto& numbers = items.of_item[full.id(1)];
    const std::uint32_t properties = full.at.u8();
    for (std::uint32_t k = 0; k < properties && full.at.ok(); ++k) {
      const std::uint16_t number = wide ? full.at.be16() & 0x7FFFU : full.at.u8() & 0x7FU;
      numbers.push_back(number);
    }
  }
}

void read_properties(Bytes content, Items& items) {
  for_each_box(content, [&](const Box& box) {
    if (box.type == "ipma") read_associations(box.content, items);
    if (box.type != "ipco") return;
    for_each_box(box.content, [&](const Box& property) { items.properties.push_back(property); });
  });
}

Items read_items(Bytes meta) {
  Items items;
  for_each_box(meta, [&](const Box& box) {
    if (box.type == "pitm") {
      Full full(box.content);
      items.primary = full.id(1);
    }
    if (box.type == "iinf") read_types(box.content, items);
    if (box.type == "iref") read_references(box.content, items);
    if (box.type == "iprp") read_properties(box.content, items);
    if (box.type == "idat") items.data = true;
  });
  return items;
}

// --- The header of the primary item ---

// av1C: after a byte of marker and version, and one of profile and level.
void read_depth(const Box& configuration, Header& header) {
  Cursor at(configuration.content);
  at.skip(2);
  const std::uint8_t flags = at.u8();
  const bool deep = (flags & 0x40U) != 0, deeper = (flags & 0x20U) != 0;
  header.bits = !deep ? 8 : deeper ? 12 : 10;
  if ((flags & 0x10U) != 0) header.channels = Channels::luminance;
}

// pixi: a number of channels, and the bits of each.
void read_channels(const Box& pixels, Header& header) {
  Full full(pixels.content);
  const std::uint8_t channels = full.at.u8();
  header.bits = full.at.u8();
  header.channels = channels == 1 ? Channels::luminance : Channels::rgb;
}

// colr: code points of ITU-T H.273, or an ICC profile.
void read_color(const Box& color, Header& header) {
  Cursor at(color.content);
  const bool coded = at.at("nclx"sv);
  at.skip(4);
  header.icc_profile = !coded;
  if (!coded) {
    header.primaries = header.transfer = Tag::custom;
    return;
  }
  constexpr std::uint16_t kBt709 = 1, kUnspecified = 2, kLinear = 8, kSrgb = 13;
  const std::uint16_t primaries = at.be16(), transfer = at.be16();
  if (primaries != kBt709 && primaries != kUnspecified) header.primaries = Tag::custom;
  if (transfer == kLinear) header.transfer = Tag::linear;
  if (transfer != kLinear && transfer != kSrgb && transfer != kUnspecified) {
    header.transfer = Tag::custom;
  }
}

bool is_alpha(const Items& items, std::uint32_t item) {
  const Box* type = items.property(item, "auxC");
  if (type == nullptr) return false;
  Cursor at(type->content);
  at.skip(4);
  return at.at("urn:mpeg:mpegB:cicp:systems:auxiliary:alpha"sv) ||
         at.at("urn:mpeg:hevc:2015:auxid:1"sv);
}

void add_alpha(const Items& items, Header& header) {
  const auto [first, last] = items.auxiliary.equal_range(items.primary);
  const bool alpha = std::any_of(
      first, last, [&](const auto& reference) { return is_alpha(items, reference.second); });
  if (!alpha) return;
  header.channels =
      header.channels == Channels::luminance ? Channels::luminance_alpha : Channels::rgba;
  if (items.premultiplied) {
    remark(header, "The AVIF has premultiplied alpha, which readers of textures do not undo.",
           true);
  }
}

void read_item(const Items& items, Header& header) {
  const auto property = [&](std::string_view type) { return items.property(items.primary, type); };
  const auto type = items.types.find(items.primary);
  if (type == items.types.end() || (type->second != "av01" && type->second != "grid")) {
    return doubt(header, "The primary item of the AVIF is no AV1 image.");
  }
  if (const Box* configuration = property("av1C")) read_depth(*configuration, header);
  if (const Box* pixels = property("pixi")) read_channels(*pixels, header);
  if (const Box* color = property("colr")) read_color(*color, header);
  if (const Box* extent = property("ispe")) {
    Full full(extent->content);
    header.width = full.at.be32();
    header.height = full.at.be32();
  }
  if (header.width == 0 || header.height == 0) {
    return doubt(header, "The primary item of the AVIF has no extent.");
  }
  if (header.bits != 8 && header.bits != 10 && header.bits != 12) {
    return doubt(
        header, fmt::format("The AVIF has {} bits per channel; AV1 has 8, 10 or 12.", header.bits));
  }
  add_alpha(items, header);
  if (property("irot") != nullptr || property("imir") != nullptr || property("clap") != nullptr) {
    remark(header, "The AVIF is to be rotated, mirrored or cropped for display.", true);
  }
}

bool has_brand(Bytes content, std::string_view brand) {
  for (std::size_t at = 0; at + 4 <= content.size(); at += 4) {
    // The second four bytes are a version.
    if (at != 4 && text_of(content, at, 4) == brand) return true;
  }
  return false;
}

}  // namespace

bool is_avif(std::span<const std::byte> bytes) {
  Cursor at(bytes);
  at.skip(4);
  if (!at.at("ftyp"sv)) return false;
  at.skip(4);
  if (at.at("avif"sv) || at.at("avis"sv)) return true;
  const auto box = next_box(bytes);  // another brand is first, such as "mif1"
  return box && (has_brand(box->content, "avif") || has_brand(box->content, "avis"));
}

HeaderResult read_avif(std::span<const std::byte> bytes) {
  Header header;
  header.format = Format::avif;
  header.primaries = header.transfer = Tag::srgb;
  const std::size_t size = bytes.size();
  std::optional<Items> items;
  bool data = false;
  while (const auto box = next_box(bytes)) {
    if (box->type == "moov") header.animated = true;
    data = data || box->type == "mdat";
    if (box->type != "meta" || items || box->content.size() < 4) continue;
    items = read_items(box->content.subspan(4));
  }
  if (!items) {
    return bytes.empty() ? HeaderResult(invalid("The AVIF has no image items."))
                         : HeaderResult(unexpected_end());
  }
  if (!bytes.empty()) {
    doubt(header, fmt::format("The AVIF is truncated: its last box exceeds its {} bytes.", size));
  }
  if (!data && !items->data) doubt(header, "The AVIF has no image data.");
  read_item(*items, header);
  return header;
}

}  // namespace gltfx::image
