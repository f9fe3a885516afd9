// SPDX-License-Identifier: Apache-2.0
// GLBs of version 3 (the draft of glTF 2.1): lengths of 64 bits, chunks at multiples of 8, and any
// number and order of them.
#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "base/checked.hpp"
#include "container/chunk_reader.hpp"
#include "container/glb.hpp"
#include "container/glb_errors.hpp"

namespace gltfx::container {
namespace {

constexpr std::uint64_t kHeader3 = 16;
constexpr std::uint64_t kChunkHeader3 = 16;
constexpr std::uint64_t kAlignment3 = 8;         // of the starts of chunks
constexpr std::uint64_t kMostJson = UINT32_MAX;  // positions in a text are 32 bits wide

/// One pass over the chunk headers. A step returns false when there is nothing left to read.
class Glb3Reader : ChunkReader {
 public:
  Glb3Reader(const Source& source, Container& out) : ChunkReader(source, out) {}

  std::optional<Copied> run() {
    bool more = read_header();
    while (more && at_ < std::min(declared_, source_.size())) more = read_chunk();
    if (failure_) return std::move(failure_);
    if (more) compare_lengths();
    if (has_header_ && !seen_json_ && !out_.cut_short) early(glb_error::no_json(kHeader3));
    const auto& chunks = out_.chunks;
    out_.ends_in_empty_chunk = !chunks.empty() && chunks.back().length == 0;
    const bool implicit = chunks.size() > 1 && chunks[0].type == kChunkJson &&
                          chunks[1].type == kChunkBin && chunks[1].encoding == 0;
    if (implicit) out_.bin = chunks[1];
    return std::nullopt;
  }

 private:
  bool read_header() {
    if (source_.size() < kHeader3) {
      return stop_short(glb_error::end_of_header(source_.size(), kHeader3));
    }
    SharedText length;
    if (!copy(8, 8, length)) return false;
    declared_ = number_at(*length, 0, 8);
    // A 32-bit length, and the length of the JSON chunk.
    if (declared_ > UINT32_MAX && number_at(*length, 0, 4) == source_.size() && has_text_at_20()) {
      early(glb_error::layout_of_version_2());
      return false;
    }
    has_header_ = true;
    if (declared_ < kHeader3) early(glb_error::length_too_small(declared_));
    return true;
  }

  // In version 2, the text of the JSON chunk begins where version 3 has its encoding, which is 0.
  bool has_text_at_20() {
    SharedText text;
    return fits(20, 4, source_.size()) && copy(20, 4, text) && number_at(*text, 0, 4) != 0;
  }

  void compare_lengths() {
    if (declared_ > source_.size()) {
      ContainerError error = glb_error::length_mismatch(declared_, source_.size());
      error.offset = 8;
      late(std::move(error));
    } else if (declared_ < source_.size()) {
      early(glb_error::extra_data(declared_, source_.size()));
    }
  }

  bool read_chunk() {
    const std::uint64_t size = source_.size();
    if (out_.chunks.size() == kMaxChunksOfVersion3) {
      early(glb_error::too_many_chunks(at_, size, kMaxChunksOfVersion3));
      return false;
    }
    if (!fits(at_, kChunkHeader3, size)) {
      return stop_short(glb_error::end_of_chunk_header(at_, size, kChunkHeader3));
    }
    SharedText header;
    if (!copy(at_, kChunkHeader3, header)) return false;
    Chunk chunk;
    chunk.type = static_cast<std::uint32_t>(number_at(*header, 0, 4));
    chunk.encoding = static_cast<std::uint32_t>(number_at(*header, 4, 4));
    chunk.header_offset = at_;
    chunk.offset = at_ + kChunkHeader3;
    const std::uint64_t length = number_at(*header, 8, 8);
    chunk.length = std::min(length, size - chunk.offset);
    if (!fits(chunk.offset, length, declared_)) {
      early(glb_error::chunk_too_big(chunk, length, declared_));
    }
    check_use(chunk);
    const bool whole = chunk.length == length;
    if (!keep_chunk(chunk, whole)) return false;
    if (!whole) return stop_short(glb_error::end_of_chunk_data(chunk, length, size));
    return skip_gap(chunk.offset + chunk.length);
  }

  // Chunks of other types and their encodings concern those who know them, as those of chunks that
  // nothing refers to.
  void check_use(const Chunk& chunk) {
    if (chunk.type == kChunkJson && !seen_json_) {
      if (chunk.encoding != 0) early(glb_error::unknown_encoding(chunk));
      if (chunk.length == 0) early(glb_error::empty_json(chunk));
    }
    if (chunk.type != kChunkBin) return;
    if (!seen_json_ && !first_bin_) first_bin_ = chunk;
    if (chunk.length > 0) return;
    ContainerError error = glb_error::empty_bin(chunk);
    error.severity = Severity::warning;
    early(std::move(error));
  }

  // The first JSON chunk is that of the asset.
  bool keep_chunk(const Chunk& chunk, bool whole) {
    out_.chunks.push_back(chunk);
    if (chunk.type != kChunkJson || std::exchange(seen_json_, true)) return true;
    if (first_bin_) early(glb_error::bin_before_json(*first_bin_));
    if (!whole || chunk.length == 0 || chunk.encoding != 0) return true;
    if (chunk.length > kMostJson) {
      early(glb_error::long_json(chunk));
      return true;
    }
    if (!copy(chunk.offset, chunk.length, out_.json)) return false;
    out_.json_offset = chunk.offset;
    return true;
  }

  // To the start of the next chunk, or to the end of the file, which need not be aligned.
  bool skip_gap(std::uint64_t end) {
    at_ = std::min((end + kAlignment3 - 1) / kAlignment3 * kAlignment3, source_.size());
    const std::uint64_t stop = std::min(at_, std::max(declared_, end));
    if (stop == end) return true;
    SharedText zeros;
    if (!copy(end, stop - end, zeros)) return false;
    const std::size_t other = zeros->find_first_not_of('\0');
    if (other != std::string::npos && !std::exchange(has_gap_, true)) {
      early(glb_error::gap(end + other, static_cast<unsigned char>((*zeros)[other])));
    }
    return true;
  }

  std::uint64_t at_ = kHeader3;
  std::uint64_t declared_ = 0;
  std::optional<Chunk> first_bin_;  // before the JSON
  bool has_header_ = false;
  bool seen_json_ = false;
  bool has_gap_ = false;
};

// What readers of version 2 see.
std::shared_ptr<const Container> as_version_2(const Container& container) {
  auto literal = std::make_shared<Container>();
  literal->format = container.format;
  literal->glb_version = container.glb_version;
  literal->errors.push_back(glb_error::invalid_version(3));
  return literal;
}

}  // namespace

std::optional<Copied> read_glb_3(const Source& source, Container& container) {
  auto failure = Glb3Reader(source, container).run();
  if (!failure) container.literal = as_version_2(container);
  return failure;
}

}  // namespace gltfx::container
