// SPDX-License-Identifier: Apache-2.0
#include "container/glb_errors.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/codes.hpp"

namespace gltfx::container::glb_error {
namespace {

constexpr std::string_view kExportAgain = "export or copy the file again: it is probably truncated";

/// A chunk type as a number, with its letters if it has any.
std::string type_text(std::uint32_t type) {
  std::string letters;
  for (unsigned shift = 0; shift < 32; shift += 8) {
    letters += static_cast<char>((type >> shift) & 0xFFU);
  }
  while (!letters.empty() && letters.back() == '\0') letters.pop_back();
  const bool plain = std::all_of(letters.begin(), letters.end(),
                                 [](char c) { return c >= ' ' && c < '\x7f' && c != '\''; });
  if (letters.empty() || !plain) return fmt::format("0x{:08x}", type);
  return fmt::format("0x{:08x} ('{}')", type, letters);
}

std::string bytes_text(std::uint64_t count) {
  return fmt::format("{} byte{}", count, count == 1 ? "" : "s");
}

}  // namespace

ContainerError invalid_magic(std::uint32_t magic, const Content& found) {
  if (!found.name.empty()) {
    return {Code::GLB_INVALID_MAGIC, 0, fmt::format("The file is {}, not a GLB.", found.name),
            std::string(found.advice.empty() ? "export the file again" : found.advice)};
  }
  return {
      Code::GLB_INVALID_MAGIC, 0,
      fmt::format("The magic of the file is {}; it must be 0x46546c67 ('glTF').", type_text(magic)),
      "export the file again: the name ends in .glb, but the content is not a GLB"};
}

ContainerError invalid_version(std::uint32_t version) {
  return {Code::GLB_INVALID_VERSION, 4,
          fmt::format("The GLB version is {}; it must be 2.", version),
          version == 1 ? "convert the asset from glTF 1.0 to 2.0, or export it again as glTF 2.0"
                       : "export the asset again as glTF 2.0"};
}

ContainerError length_too_small(std::uint64_t declared) {
  return {Code::GLB_LENGTH_TOO_SMALL, 8,
          fmt::format("The file length in the header is {}, which is too small for the header and "
                      "a JSON chunk.",
                      bytes_text(declared)),
          "write the length of the whole file, including the header, to byte 8"};
}

ContainerError length_mismatch(std::uint64_t declared, std::uint64_t actual) {
  return {Code::GLB_LENGTH_MISMATCH, actual,
          fmt::format("The file length in the header is {}, but the file has {}.",
                      bytes_text(declared), actual),
          declared > actual ? std::string(kExportAgain)
                            : std::string("write the actual length of the file to byte 8")};
}

ContainerError end_of_header(std::uint64_t actual, std::uint64_t takes) {
  return {Code::GLB_UNEXPECTED_END_OF_HEADER, actual,
          fmt::format("The file ends after {}, inside the GLB header of {} bytes.",
                      bytes_text(actual), takes),
          std::string(kExportAgain)};
}

ContainerError extra_data(std::uint64_t declared, std::uint64_t actual) {
  return {Code::GLB_EXTRA_DATA, declared,
          fmt::format("The file length in the header is {}, but {} more follow, which are ignored.",
                      bytes_text(declared), actual - declared),
          "remove the data after the last chunk, or correct the length at byte 8"};
}

ContainerError end_of_chunk_header(std::uint64_t header_offset, std::uint64_t actual,
                                   std::uint64_t takes) {
  return {
      Code::GLB_UNEXPECTED_END_OF_CHUNK_HEADER, actual,
      fmt::format("The file ends after {} of the chunk header at byte {}, which takes {} bytes.",
                  bytes_text(actual - header_offset), header_offset, takes),
      std::string(kExportAgain)};
}

ContainerError end_of_chunk_data(const Chunk& chunk, std::uint64_t declared, std::uint64_t actual) {
  return {
      Code::GLB_UNEXPECTED_END_OF_CHUNK_DATA, actual,
      fmt::format("The length of chunk {} at byte {} is {}, but the file ends after {} of them.",
                  type_text(chunk.type), chunk.header_offset, bytes_text(declared), chunk.length),
      std::string(kExportAgain)};
}

ContainerError too_many_chunks(std::uint64_t offset, std::uint64_t actual, std::size_t most) {
  return {Code::GLB_TOO_MANY_CHUNKS, offset,
          fmt::format("The file has more than {} chunks; the last {} are not checked.", most,
                      bytes_text(actual - offset)),
          "remove all chunks except JSON and BIN"};
}

ContainerError chunk_unaligned(const Chunk& chunk, std::uint64_t length) {
  const std::uint64_t padding = 4U - length % 4U;
  return {
      Code::GLB_CHUNK_LENGTH_UNALIGNED, chunk.header_offset,
      fmt::format("The length of chunk {} is {}, which is not a multiple of 4.",
                  type_text(chunk.type), bytes_text(length)),
      fmt::format("pad the chunk with {} ({}) and include them in its length", bytes_text(padding),
                  chunk.type == kChunkJson ? "spaces for JSON" : "zeros for binary data")};
}

ContainerError chunk_too_big(const Chunk& chunk, std::uint64_t length, std::uint64_t declared) {
  return {
      Code::GLB_CHUNK_TOO_BIG, chunk.header_offset,
      fmt::format("The chunk {} of {} ends at byte {}, but the file length in the header is {}.",
                  type_text(chunk.type), bytes_text(length), saturating_add(chunk.offset, length),
                  declared),
      "correct the length of the chunk, or the file length at byte 8"};
}

ContainerError unexpected_first(const Chunk& chunk) {
  return {
      Code::GLB_UNEXPECTED_FIRST_CHUNK, chunk.header_offset,
      fmt::format("The first chunk is {}; it must be 0x4e4f534a ('JSON').", type_text(chunk.type)),
      "write the JSON chunk first"};
}

ContainerError unexpected_bin(const Chunk& chunk, std::size_t position) {
  return {
      Code::GLB_UNEXPECTED_BIN_CHUNK, chunk.header_offset,
      fmt::format("The BIN chunk is chunk {}; it must be chunk 2, directly after the JSON chunk.",
                  position),
      "move the BIN chunk directly after the JSON chunk"};
}

ContainerError empty_json(const Chunk& chunk) {
  return {Code::GLB_EMPTY_CHUNK, chunk.header_offset,
          fmt::format("The chunk {} is empty.", type_text(chunk.type)),
          "write the JSON of the asset to it, at least {\"asset\":{\"version\":\"2.0\"}}"};
}

ContainerError empty_bin(const Chunk& chunk) {
  return {Code::GLB_EMPTY_BIN_CHUNK, chunk.header_offset, "The BIN chunk is empty.",
          "remove the chunk"};
}

ContainerError duplicate(const Chunk& chunk) {
  return {Code::GLB_DUPLICATE_CHUNK, chunk.header_offset,
          fmt::format("The chunk {} is a duplicate, which is ignored.", type_text(chunk.type)),
          "keep one chunk of each type"};
}

ContainerError unknown_type(const Chunk& chunk) {
  return {Code::GLB_UNKNOWN_CHUNK_TYPE, chunk.header_offset,
          fmt::format("The chunk type {} is unknown; the chunk is ignored.", type_text(chunk.type)),
          "store the data in a buffer: loaders skip unknown chunks"};
}

ContainerError layout_of_version_2() {
  return {Code::GLB_INVALID_VERSION, 4,
          "The GLB version is 3, but the file has the layout of version 2.",
          "write the version 2, or headers with lengths of 64 bits"};
}

ContainerError no_json(std::uint64_t offset) {
  return {Code::GLB_NO_JSON_CHUNK, offset, "The GLB has no JSON chunk.",
          "write the JSON of the asset to a chunk of type 0x4e4f534a ('JSON')"};
}

ContainerError bin_before_json(const Chunk& chunk) {
  return {Code::GLB_CHUNK_ORDER, chunk.header_offset,
          "The BIN chunk precedes the JSON chunk; it should follow it.",
          "write the JSON chunk first: readers of streams need it before other chunks"};
}

ContainerError unknown_encoding(const Chunk& chunk) {
  return {Code::GLB_CHUNK_ENCODING_UNKNOWN, saturating_add(chunk.header_offset, 4),
          fmt::format("The encoding of chunk {} is 0x{:08x}; only 0 is known.",
                      type_text(chunk.type), chunk.encoding),
          "write the chunk without an encoding"};
}

ContainerError long_json(const Chunk& chunk) {
  return {Code::GLB_CHUNK_TOO_BIG, chunk.header_offset,
          fmt::format("The JSON chunk has {}; gltfx reads at most 4 GiB of JSON.",
                      bytes_text(chunk.length)),
          "move data from the JSON to buffers"};
}

ContainerError gap(std::uint64_t offset, unsigned char byte) {
  return {
      Code::GLB_CHUNK_GAP, offset,
      fmt::format("The bytes between two chunks begin with 0x{:02x}; they must be zeros.", byte),
      "write zeros from the end of a chunk to the next multiple of 8"};
}

ContainerError numbered_type(const Chunk& chunk) {
  return {Code::GLB_CHUNK_TYPE_NUMBER, chunk.header_offset,
          fmt::format("The type of chunk {} is the number {}; chunk types must be 0x4e4f534a "
                      "('JSON') and 0x004e4942 ('BIN').",
                      chunk.type + 1, chunk.type),
          "write 'JSON' and 'BIN' to the last four bytes of the chunk headers"};
}

ContainerError uncounted_padding(const Chunk& chunk, std::uint64_t length) {
  const std::uint64_t padding = 4U - length % 4U;
  return {
      Code::GLB_CHUNK_LENGTH_UNALIGNED, chunk.header_offset,
      fmt::format("The length of chunk {} is {}, without the {} of padding that follow; it must "
                  "be a multiple of 4.",
                  type_text(chunk.type), bytes_text(length), bytes_text(padding)),
      fmt::format("write {} to byte {}", length + padding, chunk.header_offset)};
}

ContainerError changed_as_text(TextDamage damage) {
  const auto because = [damage] {
    if (damage == TextDamage::line_ends) return "each line feed has become a line break of Windows";
    if (damage == TextDamage::encoded) return "each byte has become a character of UTF-8";
    return "bytes that are not UTF-8 have been replaced";
  };
  return {Code::GLB_CHANGED_AS_TEXT, 0,
          fmt::format("A program has changed the file as if it were text: {}.", because()),
          "copy the original file again, in binary mode"};
}

}  // namespace gltfx::container::glb_error
