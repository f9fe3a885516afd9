// SPDX-License-Identifier: Apache-2.0
#include "container/glb.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "base/checked.hpp"
#include "base/text.hpp"
#include "container/chunk_reader.hpp"
#include "container/content.hpp"
#include "container/glb_errors.hpp"

namespace gltfx::container {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;
constexpr std::uint64_t kHeaderSize = 12;
constexpr std::uint64_t kChunkHeaderSize = 8;

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint32_t>(number_at(bytes, at, 4));
}

/// repaired: known mistakes of writers are corrected, and reported instead of the resulting errors.
enum class GlbReading : std::uint8_t { literal, repaired };

/// One pass over the chunk headers. A step returns false when there is nothing left to read.
class GlbReader : ChunkReader {
 public:
  GlbReader(const Source& source, Container& out, GlbReading reading)
      : ChunkReader(source, out), is_repaired_(reading == GlbReading::repaired) {}

  /// Whether the file has a known mistake.
  bool has_repaired() const { return is_numbered_ || is_uncounted_; }

  std::optional<Copied> run() {
    if (!read_header()) return std::move(failure_);
    while (at_ < source_.size()) {
      if (!read_chunk()) return std::move(failure_);
    }
    out_.ends_in_empty_chunk = !out_.chunks.empty() && out_.chunks.back().length == 0;
    if (at_ != declared_) late(glb_error::length_mismatch(declared_, source_.size()));
    return std::nullopt;
  }

 private:
  bool read_header() {
    if (source_.size() < kHeaderSize) {
      return stop_short(glb_error::end_of_header(source_.size(), kHeaderSize));
    }
    SharedText header;
    if (!copy(0, kHeaderSize, header)) return false;
    const std::uint32_t magic = little_endian(*header, 0);
    const std::uint32_t version = little_endian(*header, 4);
    declared_ = little_endian(*header, 8);
    if (magic != kMagic) {
      SharedText head;
      if (!copy(0, std::min(source_.size(), std::uint64_t{kSniffBytes}), head)) return false;
      const Content found = name_content(*head, source_.size());
      early(glb_error::invalid_magic(magic, found.image ? Content() : found));
      return false;
    }
    out_.glb_version = version;
    if (version == 3) return false;  // read by read_glb_3()
    if (version != 2) {
      early(glb_error::invalid_version(version));
      return false;
    }
    if (declared_ <= kHeaderSize) early(glb_error::length_too_small(declared_));
    return true;
  }

  bool read_chunk() {
    const std::uint64_t size = source_.size();
    if (at_ == declared_) {
      early(glb_error::extra_data(declared_, size));
      return false;
    }
    if (out_.chunks.size() == kMaxChunks) {
      early(glb_error::too_many_chunks(at_, size, kMaxChunks));
      return false;
    }
    if (!fits(at_, kChunkHeaderSize, size)) {
      return stop_short(glb_error::end_of_chunk_header(at_, size, kChunkHeaderSize));
    }
    SharedText header;
    if (!copy(at_, kChunkHeaderSize, header)) return false;
    std::uint32_t length = little_endian(*header, 0);
    std::uint32_t type = little_endian(*header, 4);
    if (is_repaired_ && !repair(length, type)) return false;
    return take_chunk(length, type);
  }

  bool repair(std::uint32_t& length, std::uint32_t& type) {
    const Chunk chunk{type, 0, at_, at_ + kChunkHeaderSize, length};
    bool numbered = false;
    if (!has_number(chunk, numbered)) return false;
    if (numbered) {
      if (!std::exchange(is_numbered_, true)) early(glb_error::numbered_type(chunk));
      type = type == 0 ? kChunkJson : kChunkBin;
    }
    bool uncounted = false;
    if (length % 4 != 0 && !has_padding(chunk, type == kChunkJson ? ' ' : '\0', uncounted)) {
      return false;
    }
    if (!uncounted) return true;
    is_uncounted_ = true;
    early(glb_error::uncounted_padding(chunk, length));
    length += 4 - length % 4;
    return true;
  }

  // Whether the type is the position of the chunk, and the data is text if that type requires it.
  // False: unreadable.
  bool has_number(const Chunk& chunk, bool& found) {
    found = chunk.type == 1 && out_.chunks.size() == 1;
    if (chunk.type != 0 || !out_.chunks.empty() || !fits(chunk.offset, 1, source_.size())) {
      return true;
    }
    SharedText first;
    if (!copy(chunk.offset, 1, first)) return false;
    found = *first == "{";
    return true;
  }

  // Whether blanks follow the data that the header counts, and a chunk or the end of the file
  // follows these. False: unreadable.
  bool has_padding(const Chunk& chunk, char blank, bool& found) {
    const std::uint64_t end = chunk.offset + chunk.length;
    const std::uint32_t padding = 4U - chunk.length % 4;
    const bool last = end + padding == source_.size();
    const std::uint32_t more = last ? 0 : kChunkHeaderSize;
    if (!fits(end, padding + more, source_.size())) return true;
    SharedText bytes;
    if (!copy(end, padding + more, bytes)) return false;
    const std::uint32_t type = last ? kChunkBin : little_endian(*bytes, padding + 4);
    found = bytes->substr(0, padding) == std::string(padding, blank) &&
            (type == kChunkBin || type == kChunkJson || (type == 1 && out_.chunks.empty()));
    return true;
  }

  bool take_chunk(std::uint32_t length, std::uint32_t type) {
    Chunk chunk;
    chunk.type = type;
    chunk.header_offset = at_;
    chunk.offset = at_ + kChunkHeaderSize;
    chunk.length = std::min<std::uint64_t>(length, source_.size() - chunk.offset);
    check_chunk(chunk, length);
    const bool whole = chunk.length == length;
    if (!keep_chunk(chunk, whole)) return false;
    if (!whole) return stop_short(glb_error::end_of_chunk_data(chunk, length, source_.size()));
    at_ = chunk.offset + chunk.length;
    return true;
  }

  void check_chunk(const Chunk& chunk, std::uint32_t length) {
    if (length % 4 != 0) early(glb_error::chunk_unaligned(chunk, length));
    if (!fits(chunk.offset, length, declared_)) {
      early(glb_error::chunk_too_big(chunk, length, declared_));
    }
    if (out_.chunks.empty() && chunk.type != kChunkJson) early(glb_error::unexpected_first(chunk));
    if (chunk.type == kChunkBin && !out_.bin && out_.chunks.size() > 1) {
      early(glb_error::unexpected_bin(chunk, out_.chunks.size() + 1));
    }
    check_use(chunk, length);
  }

  void check_use(const Chunk& chunk, std::uint32_t length) {
    if (chunk.type == kChunkJson) {
      if (length == 0) early(glb_error::empty_json(chunk));
      if (seen_json_) early(glb_error::duplicate(chunk));
    } else if (chunk.type == kChunkBin) {
      if (length == 0) early(glb_error::empty_bin(chunk));
      if (out_.bin) early(glb_error::duplicate(chunk));
    } else {
      early(glb_error::unknown_type(chunk));
    }
  }

  bool keep_chunk(const Chunk& chunk, bool whole) {
    out_.chunks.push_back(chunk);
    if (chunk.type == kChunkBin && !out_.bin) out_.bin = chunk;
    if (chunk.type != kChunkJson || std::exchange(seen_json_, true)) return true;
    // A truncated JSON text would only add a second message about the same cause.
    if (!whole || chunk.length == 0) return true;
    if (!copy(chunk.offset, chunk.length, out_.json)) return false;
    out_.json_offset = chunk.offset;
    return true;
  }

  std::uint64_t at_ = kHeaderSize;
  std::uint64_t declared_ = 0;
  bool seen_json_ = false;
  bool is_repaired_;
  bool is_numbered_ = false;
  bool is_uncounted_ = false;
};

std::uint64_t count_of(std::string_view text, std::string_view part) {
  std::uint64_t found = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos;
       at = text.find(part, at + part.size())) {
    ++found;
  }
  return found;
}

// Whether each line feed follows a carriage return, and the length in the header confirms that
// these were added.
bool has_new_line_ends(std::string_view bytes) {
  std::string header;
  for (std::size_t i = 0; i < bytes.size() && header.size() < kHeaderSize; ++i) {
    if (bytes[i] != '\r' || !bytes.substr(i + 1).starts_with('\n')) header += bytes[i];
  }
  const std::uint64_t ends = count_of(bytes, "\r\n");
  return ends > 0 && header.size() == kHeaderSize && ends == count_of(bytes, "\n") &&
         little_endian(header, 8) == bytes.size() - ends;
}

// If all bytes are UTF-8, and some outside of the JSON are not ASCII, a program has converted them.
TextDamage damage_of(std::string_view bytes, std::uint64_t json_end) {
  if (has_new_line_ends(bytes)) return TextDamage::line_ends;
  const std::string_view headers = bytes.substr(0, kHeaderSize + kChunkHeaderSize);
  if (headers.find("\xEF\xBF\xBD") != std::string_view::npos) return TextDamage::replaced;
  const std::size_t brace = std::min(bytes.find('{'), bytes.size());
  bool replaced = false;
  bool other = false;
  for (std::size_t at = 0; at < bytes.size();) {
    const CodePoint point = decode_utf8(bytes, at);
    const bool cut = bytes.size() - at < 4;
    if (!point.valid) {
      if (cut) break;
      return TextDamage::none;
    }
    const bool outside = at < brace || at >= json_end;
    if (point.value == 0xFFFD && outside) replaced = true;
    if (point.value >= 0x80 && point.value < 0x100 && outside) other = true;
    at += point.size;
  }
  if (replaced) return TextDamage::replaced;
  return other ? TextDamage::encoded : TextDamage::none;
}

constexpr std::uint64_t kMostText = std::uint64_t{64} << 20U;

// Replaces the errors of a literal reading by those of a repaired reading, and keeps the literal
// one.
void take_cause(Container& container, Container cause) {
  auto literal = std::make_shared<Container>(std::move(container));
  container = std::move(cause);
  container.literal = std::move(literal);
}

}  // namespace

std::optional<Copied> read_glb(const Source& source, Container& container) {
  const Format format = container.format;
  auto failure = GlbReader(source, container, GlbReading::literal).run();
  if (!failure && container.glb_version == 3U) return read_glb_3(source, container);
  if (failure || (container.errors.empty() && container.late_errors.empty())) return failure;
  Container repaired;
  repaired.format = format;
  GlbReader reader(source, repaired, GlbReading::repaired);
  failure = reader.run();
  if (failure) return failure;
  if (reader.has_repaired()) {
    take_cause(container, std::move(repaired));
    return std::nullopt;
  }
  const bool no_magic = !container.glb_version;
  if (no_magic) return std::nullopt;
  const Copied text = source.copy(0, std::min(source.size(), kMostText));
  if (text.error != ResolveError::none) return text;
  const bool has_json = !container.chunks.empty() && container.chunks.front().type == kChunkJson;
  const Chunk json = has_json ? container.chunks.front() : Chunk{0, 0, 0, source.size(), 0};
  const TextDamage damage = damage_of(*text.text, json.offset + json.length);
  if (damage == TextDamage::none) return std::nullopt;
  Container damaged;
  damaged.format = format;
  damaged.errors.push_back(glb_error::changed_as_text(damage));
  take_cause(container, std::move(damaged));
  return std::nullopt;
}

}  // namespace gltfx::container
