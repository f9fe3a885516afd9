// SPDX-License-Identifier: Apache-2.0
#include "change/glb_writer.hpp"

#include <string>
#include <utility>

#include "change/rewrite.hpp"
#include "container/chunk_reader.hpp"

namespace gltfx::change {
namespace {

using container::Bytes;

std::string little_endian(std::uint64_t value, unsigned size) {
  std::string bytes;
  for (unsigned i = 0; i < size; ++i) bytes += static_cast<char>((value >> (8U * i)) & 0xFFU);
  return bytes;
}

std::string header_of_chunk(std::uint32_t version, std::uint32_t type, std::uint32_t encoding,
                            std::uint64_t length) {
  if (version == 3) {
    return little_endian(type, 4) + little_endian(encoding, 4) + little_endian(length, 8);
  }
  return little_endian(length, 4) + little_endian(type, 4);
}

std::uint64_t padding(std::uint64_t size, std::uint64_t alignment) {
  return (alignment - size % alignment) % alignment;
}

// In version 3, up to 7 characters of white space that end at a multiple of 8 count as padding,
// which must be blanks.
std::string padded_json_3(std::string_view json, std::uint64_t alignment) {
  std::string text(without_padding(json, alignment));
  text.append(padding(text.size(), alignment), ' ');
  const std::size_t end = text.find_last_not_of(" \t\r\n") + 1;
  const bool counts = text.size() % kAlignmentOf3 == 0 && text.size() - end < kAlignmentOf3;
  if (counts && text.find_first_not_of(' ', end) != std::string::npos) text.append(alignment, ' ');
  return text;
}

}  // namespace

std::uint64_t declared_length(std::string_view glb) { return container::number_at(glb, 8, 8); }

void GlbWriter::put(Bytes bytes) {
  if (bytes.empty()) return;
  size_ += bytes.size();
  pieces_.push_back(std::move(bytes));
}

void GlbWriter::align() {
  if (version_ == 3) put(Bytes::from_string(std::string(padding(size_, kAlignmentOf3), '\0')));
}

void GlbWriter::chunk(std::uint32_t type, std::uint32_t encoding, std::vector<Bytes> data) {
  if (version_ == 2) {
    const char blank = type == container::kChunkJson ? ' ' : '\0';
    const std::uint64_t more = padding(container::size_of(data), kAlignmentOf2);
    data.push_back(Bytes::from_string(std::string(more, blank)));
  }
  align();
  put(Bytes::from_string(header_of_chunk(version_, type, encoding, container::size_of(data))));
  for (Bytes& piece : data) put(std::move(piece));
}

void GlbWriter::json(std::string_view text, std::uint64_t old_length) {
  std::string json;
  if (version_ == 3) {
    const std::uint64_t alignment = old_length % 8 == 0 ? 8 : old_length % 4 == 0 ? 4 : 1;
    json = padded_json_3(text, alignment);
  } else {
    json = without_padding(text);
  }
  chunk(container::kChunkJson, 0, {Bytes::from_string(std::move(json))});
}

std::optional<std::vector<Bytes>> GlbWriter::finish(std::uint64_t uncounted) && {
  const std::uint64_t total = size_ - uncounted;
  if (version_ == 2 && total > UINT32_MAX) return std::nullopt;
  pieces_.front() = Bytes::from_string("glTF" + little_endian(version_, 4) +
                                       little_endian(total, version_ == 3 ? 8 : 4));
  return std::move(pieces_);
}

}  // namespace gltfx::change
