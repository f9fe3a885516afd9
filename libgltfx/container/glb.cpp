// SPDX-License-Identifier: Apache-2.0
#include "container/glb.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/checked.hpp"
#include "container/content.hpp"
#include "container/glb_errors.hpp"

namespace gltfx::container {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;
constexpr std::uint64_t kHeaderSize = 12;
constexpr std::uint64_t kChunkHeaderSize = 8;

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < 4; ++i) {
    value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8U * i);
  }
  return value;
}

/// One pass over the chunk headers. A step returns false when there is nothing left to read.
class GlbReader {
 public:
  GlbReader(const Source& source, Container& out) : source_(source), out_(out) {}

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
  void early(ContainerError error) { out_.errors.push_back(std::move(error)); }
  void late(ContainerError error) { out_.late_errors.push_back(std::move(error)); }

  bool stop_short(ContainerError error) {
    out_.cut_short = true;
    late(std::move(error));
    return false;
  }

  bool copy(std::uint64_t offset, std::uint64_t length, SharedText& text) {
    Copied copied = source_.copy(offset, length);
    if (copied.error != ResolveError::none) {
      failure_ = std::move(copied);
      return false;
    }
    text = std::move(copied.text);
    return true;
  }

  bool read_header() {
    if (source_.size() < kHeaderSize) return stop_short(glb_error::end_of_header(source_.size()));
    SharedText header;
    if (!copy(0, kHeaderSize, header)) return false;
    const std::uint32_t magic = little_endian(*header, 0);
    const std::uint32_t version = little_endian(*header, 4);
    declared_ = little_endian(*header, 8);
    if (magic != kMagic) {
      SharedText head;
      if (!copy(0, std::min(source_.size(), std::uint64_t{kSniffBytes}), head)) return false;
      const Content found = name_content(*head);
      early(glb_error::invalid_magic(magic, found.image ? std::string_view() : found.name));
      return false;
    }
    out_.glb_version = version;
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
      early(glb_error::too_many_chunks(at_, size));
      return false;
    }
    if (!fits(at_, kChunkHeaderSize, size)) {
      return stop_short(glb_error::end_of_chunk_header(at_, size));
    }
    SharedText header;
    if (!copy(at_, kChunkHeaderSize, header)) return false;
    return take_chunk(little_endian(*header, 0), little_endian(*header, 4));
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
    // Half a JSON text would only add a second message about the same cut.
    if (!whole || chunk.length == 0) return true;
    if (!copy(chunk.offset, chunk.length, out_.json)) return false;
    out_.json_offset = chunk.offset;
    return true;
  }

  const Source& source_;
  Container& out_;
  std::optional<Copied> failure_;
  std::uint64_t at_ = kHeaderSize;
  std::uint32_t declared_ = 0;
  bool seen_json_ = false;
};

}  // namespace

std::optional<Copied> read_glb(const Source& source, Container& container) {
  return GlbReader(source, container).run();
}

}  // namespace gltfx::container
