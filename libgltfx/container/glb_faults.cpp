// SPDX-License-Identifier: Apache-2.0
#include "container/glb_faults.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/codes.hpp"

namespace gltfx::container::glb_fault {
namespace {

constexpr std::string_view kExportAgain =
    "Export the file again; it was probably cut off while it was copied or written.";

/// Four bytes as the number they stand for, with their letters where they have some.
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

ContainerFault invalid_magic(std::uint32_t magic, std::string_view found) {
  return {
      Code::GLB_INVALID_MAGIC, 0,
      fmt::format("The file begins with {} where a GLB has 0x46546c67 ('glTF').", type_text(magic)),
      found.empty()
          ? "Check that this is a GLB: the name ends in .glb, the content is something else."
          : fmt::format("This is {}.", found)};
}

ContainerFault invalid_version(std::uint32_t version) {
  return {Code::GLB_INVALID_VERSION, 4,
          fmt::format("The header says GLB version {}, only version 2 is known.", version),
          version == 1 ? "Convert the asset from glTF 1.0 to 2.0, or export it again as glTF 2.0."
                       : "Export the asset again as glTF 2.0."};
}

ContainerFault length_too_small(std::uint32_t declared) {
  return {Code::GLB_LENGTH_TOO_SMALL, 8,
          fmt::format("The header says the file has {}; header and JSON chunk alone take more.",
                      bytes_text(declared)),
          "Write the length of the whole file, header included, to byte 8."};
}

ContainerFault length_mismatch(std::uint32_t declared, std::uint64_t actual) {
  return {Code::GLB_LENGTH_MISMATCH, actual,
          fmt::format("The header says the file has {}, it has {}.", bytes_text(declared), actual),
          declared > actual ? std::string(kExportAgain)
                            : std::string("Write the real length of the file to byte 8.")};
}

ContainerFault end_of_header(std::uint64_t actual) {
  return {
      Code::GLB_UNEXPECTED_END_OF_HEADER, actual,
      fmt::format("The file ends after {}, inside the GLB header of 12 bytes.", bytes_text(actual)),
      std::string(kExportAgain)};
}

ContainerFault extra_data(std::uint32_t declared, std::uint64_t actual) {
  return {Code::GLB_EXTRA_DATA, declared,
          fmt::format("The header says the file has {}, but {} more follow; they are ignored.",
                      bytes_text(declared), actual - declared),
          "Remove what follows the last chunk, or count it in the length at byte 8."};
}

ContainerFault end_of_chunk_header(std::uint64_t header_offset, std::uint64_t actual) {
  return {Code::GLB_UNEXPECTED_END_OF_CHUNK_HEADER, actual,
          fmt::format("The file ends {} into the chunk header at byte {}, which takes 8.",
                      bytes_text(actual - header_offset), header_offset),
          std::string(kExportAgain)};
}

ContainerFault end_of_chunk_data(const Chunk& chunk, std::uint32_t declared, std::uint64_t actual) {
  return {
      Code::GLB_UNEXPECTED_END_OF_CHUNK_DATA, actual,
      fmt::format("The chunk {} at byte {} should have {} of data, the file ends after {}.",
                  type_text(chunk.type), chunk.header_offset, bytes_text(declared), chunk.length),
      std::string(kExportAgain)};
}

ContainerFault too_many_chunks(std::uint64_t offset, std::uint64_t actual) {
  return {Code::GLB_TOO_MANY_CHUNKS, offset,
          fmt::format("The file has more than {} chunks; the last {} are not looked at.",
                      kMaxChunks, bytes_text(actual - offset)),
          "Store an asset as one JSON chunk and at most one BIN chunk."};
}

ContainerFault chunk_unaligned(const Chunk& chunk, std::uint32_t length) {
  const unsigned padding = 4U - length % 4U;
  return {
      Code::GLB_CHUNK_LENGTH_UNALIGNED, chunk.header_offset,
      fmt::format("The chunk {} has {}, which is no multiple of 4.", type_text(chunk.type),
                  bytes_text(length)),
      fmt::format("Pad the chunk with {} ({}) and count them in its length.", bytes_text(padding),
                  chunk.type == kChunkJson ? "spaces for JSON" : "zeros for binary data")};
}

ContainerFault chunk_too_big(const Chunk& chunk, std::uint32_t length, std::uint32_t declared) {
  return {Code::GLB_CHUNK_TOO_BIG, chunk.header_offset,
          fmt::format("The chunk {} of {} ends at byte {}, beyond the {} that the header gives the "
                      "file.",
                      type_text(chunk.type), bytes_text(length), chunk.offset + length, declared),
          "Correct the length of the chunk, or the length of the file at byte 8."};
}

ContainerFault unexpected_first(const Chunk& chunk) {
  return {
      Code::GLB_UNEXPECTED_FIRST_CHUNK, chunk.header_offset,
      fmt::format("The first chunk is {}, it must be 0x4e4f534a ('JSON').", type_text(chunk.type)),
      "Put the JSON chunk first."};
}

ContainerFault unexpected_bin(const Chunk& chunk, std::size_t position) {
  return {Code::GLB_UNEXPECTED_BIN_CHUNK, chunk.header_offset,
          fmt::format("The BIN chunk is chunk {}, it must be chunk 2, right behind the JSON chunk.",
                      position),
          "Move the BIN chunk behind the JSON chunk and other chunks behind both."};
}

ContainerFault empty_json(const Chunk& chunk) {
  return {Code::GLB_EMPTY_CHUNK, chunk.header_offset,
          fmt::format("The chunk {} has no data.", type_text(chunk.type)),
          "Write the asset's JSON into it; the least is {\"asset\":{\"version\":\"2.0\"}}."};
}

ContainerFault empty_bin(const Chunk& chunk) {
  return {Code::GLB_EMPTY_BIN_CHUNK, chunk.header_offset, "The BIN chunk has no data.",
          "Leave the chunk out."};
}

ContainerFault duplicate(const Chunk& chunk) {
  return {Code::GLB_DUPLICATE_CHUNK, chunk.header_offset,
          fmt::format("This is not the first chunk {}; it is ignored.", type_text(chunk.type)),
          "Keep one chunk of each type."};
}

ContainerFault unknown_type(const Chunk& chunk) {
  return {
      Code::GLB_UNKNOWN_CHUNK_TYPE, chunk.header_offset,
      fmt::format("The chunk type {} is not known; the chunk is ignored.", type_text(chunk.type)),
      "Store data in buffers; other readers skip chunks that are neither JSON nor BIN."};
}

}  // namespace gltfx::container::glb_fault
