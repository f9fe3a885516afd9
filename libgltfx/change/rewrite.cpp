// SPDX-License-Identifier: Apache-2.0
#include "change/rewrite.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/codes.hpp"
#include "change/glb_writer.hpp"
#include "container/bytes.hpp"

namespace gltfx::change {
namespace {

using container::Bytes;
using container::Chunk;
using container::Container;
using Pieces = std::vector<Bytes>;

constexpr const char* kTooLong = "the new file exceeds the maximum size of a GLB (4 GiB)";

// Errors with which the chunks can still be found: wrong lengths are corrected, the rest is kept.
constexpr std::array<Code, 13> kHarmless{Code::GLB_CHUNK_ENCODING_UNKNOWN,
                                         Code::GLB_CHUNK_GAP,
                                         Code::GLB_CHUNK_LENGTH_UNALIGNED,
                                         Code::GLB_CHUNK_ORDER,
                                         Code::GLB_CHUNK_TOO_BIG,
                                         Code::GLB_CHUNK_TYPE_NUMBER,
                                         Code::GLB_DUPLICATE_CHUNK,
                                         Code::GLB_EMPTY_BIN_CHUNK,
                                         Code::GLB_EXTRA_DATA,
                                         Code::GLB_LENGTH_MISMATCH,
                                         Code::GLB_LENGTH_TOO_SMALL,
                                         Code::GLB_UNEXPECTED_BIN_CHUNK,
                                         Code::GLB_UNKNOWN_CHUNK_TYPE};

bool is_harmless(const container::ContainerError& error) {
  return std::find(kHarmless.begin(), kHarmless.end(), error.code) != kHarmless.end();
}

Pieces changed_bin(const Bytes& bin, const BinChange& change) {
  if (change.whole) return *change.whole;
  Pieces data;
  std::size_t at = 0;
  auto patch = change.patches.begin();
  const auto keep_to = [&](std::size_t end) {
    for (; patch != change.patches.end() && patch->offset < end; ++patch) {
      data.push_back(bin.part(at, patch->offset - at));
      data.push_back(Bytes::from_string(patch->bytes));
      at = patch->offset + patch->bytes.size();
    }
    data.push_back(bin.part(at, end - at));
  };
  for (const ByteRange& range : change.cut) {
    keep_to(range.begin);
    at = range.end;
  }
  keep_to(bin.size());
  data.push_back(Bytes::from_string(change.more));
  return data;
}

bool is_json_of_asset(const Container& container, const Chunk& chunk) {
  return chunk.type == container::kChunkJson && chunk.offset == container.json_offset;
}

std::uint64_t end_of(const Chunk& chunk) { return chunk.offset + chunk.length; }

// The end of the bytes that the header of the file counts. In version 2 these end with the last
// chunk; in version 3 padding may follow it.
std::uint64_t counted_end(const Container& container) {
  const std::uint64_t last = end_of(container.chunks.back());
  if (container.glb_version != 3U) return last;
  const std::uint64_t declared = declared_length(container.bytes.text());
  return std::clamp<std::uint64_t>(declared, last, container.bytes.size());
}

/// Writes a GLB anew in its version.
class GlbRewriter {
 public:
  GlbRewriter(const Container& container, std::string_view json, const BinChanges& bins)
      : container_(container), json_(json), bins_(bins), writer_(*container.glb_version) {}

  // Chunks that do not change stay with the bytes between them.
  Result<Pieces> run() {
    const std::vector<Chunk>& chunks = container_.chunks;
    for (std::size_t i = 0; i < chunks.size(); ++i) {
      if (!changes(i)) continue;
      keep_to(chunks[i].header_offset);
      put(i);
      if (i + 1 < chunks.size()) writer_.align();
      kept_ = i + 1 < chunks.size() ? chunks[i + 1].header_offset : end_of(chunks[i]);
    }
    const std::uint64_t counted = counted_end(container_);
    if (kept_ == end_of(chunks.back()) && counted > kept_) {
      writer_.align();
      kept_ = counted;
    }
    keep_to(container_.bytes.size());
    return finish(container_.bytes.size() - counted);
  }

  Result<Pieces> run_sound() {
    for (std::size_t i = 0; i < container_.chunks.size(); ++i) put(i);
    return finish(0);
  }

 private:
  bool changes(std::size_t position) const {
    return bins_.contains(position) || is_json_of_asset(container_, container_.chunks[position]) ||
           (position == 0 && bins_.contains(kNewBin));
  }

  void keep_to(std::uint64_t end) {
    writer_.put(container_.bytes.part(kept_, end - kept_));
    kept_ = end;
  }

  void put(std::size_t position) {
    const Chunk& chunk = container_.chunks[position];
    const Bytes data = container_.bytes.part(chunk.offset, chunk.length);
    const auto change = bins_.find(position);
    if (is_json_of_asset(container_, chunk)) {
      writer_.json(json_, chunk.length);
    } else if (change == bins_.end()) {
      writer_.chunk(chunk.type, chunk.encoding, {data});
    } else if (!change->second.drop) {
      writer_.chunk(chunk.type, chunk.encoding, changed_bin(data, change->second));
    }
    const auto added = position == 0 ? bins_.find(kNewBin) : bins_.end();
    if (added != bins_.end()) {
      writer_.chunk(container::kChunkBin, 0, changed_bin({}, added->second));
    }
  }

  Result<Pieces> finish(std::uint64_t uncounted) {
    auto pieces = std::move(writer_).finish(uncounted);
    if (!pieces) return Error{kTooLong};
    return *std::move(pieces);
  }

  const Container& container_;
  const std::string_view json_;
  const BinChanges& bins_;
  GlbWriter writer_;
  std::uint64_t kept_ = header_size(*container_.glb_version);  ///< old bytes before it are done
};

bool is_too_long(std::string_view json, std::uint32_t version) {
  return version == 2 && json.size() > UINT32_MAX;
}

}  // namespace

std::optional<std::string> find_glb_obstacle(const Container& container) {
  for (const auto* errors : {&container.errors, &container.late_errors}) {
    for (const container::ContainerError& error : *errors) {
      const bool hides_text =
          error.code == Code::GLB_CHUNK_ENCODING_UNKNOWN && container.json == nullptr;
      if (container.cut_short || hides_text || !is_harmless(error)) return error.message;
    }
  }
  return std::nullopt;
}

// White space that is not all blanks stays longer than padding is: it would be taken for that.
std::string_view without_padding(std::string_view json, std::size_t alignment) {
  const std::size_t end = json.find_last_not_of(" \t\r\n") + 1;
  const bool blank = json.find_first_not_of(' ', end) == std::string_view::npos;
  const std::size_t least = blank ? end : end + alignment;
  for (std::size_t i = 1; i < alignment && json.ends_with(' ') && json.size() > least; ++i) {
    json.remove_suffix(1);
  }
  return json;
}

Result<Pieces> rewrite_glb(const Container& container, std::string_view json,
                           const BinChanges& bins) {
  if (is_too_long(json, *container.glb_version)) return Error{kTooLong};
  return GlbRewriter(container, json, bins).run();
}

Result<Pieces> rewrite_sound(const Container& container, std::string_view json,
                             const BinChanges& bins) {
  if (is_too_long(json, *container.glb_version)) return Error{kTooLong};
  return GlbRewriter(container, json, bins).run_sound();
}

bool is_copied(const Container& container, const Chunk& chunk, std::uint32_t version) {
  if (is_json_of_asset(container, chunk)) return false;
  if (version == 3) return !container.bin || chunk.header_offset != container.bin->header_offset;
  return chunk.encoding == 0 && chunk.type != container::kChunkJson &&
         chunk.type != container::kChunkBin;
}

Result<Pieces> convert_glb(const Container& container, std::string_view json,
                           const BinChanges& bins, std::uint32_t version) {
  if (is_too_long(json, version)) return Error{kTooLong};
  GlbWriter writer(version);
  writer.json(json, kAlignmentOf2);
  for (const auto& [position, bin] : bins) {
    if (bin.whole) writer.chunk(container::kChunkBin, 0, *bin.whole);
  }
  for (const Chunk& chunk : container.chunks) {
    if (!is_copied(container, chunk, version)) continue;
    writer.chunk(chunk.type, chunk.encoding, {container.bytes.part(chunk.offset, chunk.length)});
  }
  auto pieces = std::move(writer).finish(0);
  if (!pieces) return Error{kTooLong};
  return *std::move(pieces);
}

Result<Pieces> make_glb(std::string_view json, Pieces bin, std::uint32_t version) {
  if (is_too_long(json, version)) return Error{kTooLong};
  GlbWriter writer(version);
  writer.json(json, version == 3 ? kAlignmentOf3 : kAlignmentOf2);
  if (!bin.empty()) writer.chunk(container::kChunkBin, 0, std::move(bin));
  auto pieces = std::move(writer).finish(0);
  if (!pieces) return Error{kTooLong};
  return *std::move(pieces);
}

Result<Pieces> rewrite(const Container& container) {
  if (container.format == container::Format::glb) return rewrite_glb(container, *container.json);
  return Pieces{Bytes::from_text(container.json)};
}

}  // namespace gltfx::change
