// SPDX-License-Identifier: Apache-2.0
// What the container room says of a GLB. Examples are whole files in base64.
#include "validate/rules/families.hpp"

namespace gltfx::validate {
namespace {

// {"asset":{"version":"2.0"}} in a GLB of one chunk.
constexpr std::string_view kGood =
    "base64:Z2xURgIAAAAwAAAAHAAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0g";

constexpr RuleDescription kRules[] = {
    {"GLB_CHUNK_LENGTH_UNALIGNED", Severity::error,
     "A GLB chunk is not a multiple of four bytes long",
     "Every chunk of a GLB begins and ends on a four-byte boundary, so that readers can map "
     "it. A chunk of another length moves all that follows.",
     "Pad JSON chunks with spaces and BIN chunks with zero bytes, and count the padding in the"
     " length.",
     "base64:Z2xURgIAAAAvAAAAGwAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0=", kGood, Fix::none,
     true},
    {"GLB_CHUNK_TOO_BIG", Severity::error,
     "A GLB chunk reaches beyond the declared end of the file",
     "The length in the GLB header bounds all chunks. One that is larger makes readers run "
     "into whatever follows, or stop.",
     "Write the chunk with its true length, or correct the total length in the header.",
     "base64:Z2xURgIAAAAwAAAAIAAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0gICAgIA==", kGood,
     Fix::none, true},
    {"GLB_DUPLICATE_CHUNK", Severity::error, "A GLB has two chunks of one type",
     "There is one JSON chunk and at most one BIN chunk; readers use the first and drop the "
     "other without a word.",
     "Keep one chunk of each type.",
     "base64:Z2xURgIAAABUAAAAHAAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0gHAAAAEpTT057ImFzc"
     "2V0Ijp7InZlcnNpb24iOiIyLjAifX0g",
     kGood, Fix::none, true},
    {"GLB_EMPTY_BIN_CHUNK", Severity::info, "The BIN chunk of a GLB is empty",
     "A chunk without content says nothing and costs eight bytes.", "Leave the BIN chunk out.",
     "base64:Z2xURgIAAAA4AAAAHAAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0gAAAAAEJJTgA=", kGood,
     Fix::none, true},
    {"GLB_EMPTY_CHUNK", Severity::error, "The JSON chunk of a GLB is empty",
     "Without JSON text there is no asset.", "Write the JSON text into the chunk.",
     "base64:Z2xURgIAAAAUAAAAAAAAAEpTT04=", kGood, Fix::none, true},
    {"GLB_EXTRA_DATA", Severity::warning, "Bytes follow behind the declared end of a GLB",
     "Readers stop at the length the header gives; what follows is lost, and is often the rest"
     " of a damaged file.",
     "Correct the length in the header, or cut the file there.",
     "base64:Z2xURgIAAAAwAAAAHAAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0gAAAAAA==", kGood,
     Fix::none, true},
    {"GLB_INVALID_MAGIC", Severity::error, "A .glb file does not begin with the letters glTF",
     "The first four bytes tell readers that this is a GLB. Without them nobody opens the "
     "file.",
     "Export the file again, or rename it to .gltf when it is JSON text.",
     "base64:aGxURgIAAAAwAAAAHAAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0g", kGood, Fix::none,
     true},
    {"GLB_INVALID_VERSION", Severity::error, "The GLB container is not of version 2",
     "Version 1 belongs to glTF 1.0 and is laid out differently; others do not exist.",
     "Convert the asset to glTF 2.0.",
     "base64:Z2xURgMAAAAwAAAAHAAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0g", kGood, Fix::none,
     true},
    {"GLB_LENGTH_MISMATCH", Severity::error,
     "The length in the GLB header is not the length of the file",
     "A file that is shorter than it says was cut off on its way; readers refuse it.",
     "Export or copy the file again.",
     "base64:Z2xURgIAAAA4AAAAHAAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0g", kGood, Fix::none,
     true},
    {"GLB_LENGTH_TOO_SMALL", Severity::error,
     "The length in the GLB header leaves no room for a chunk",
     "The header alone takes twelve bytes; a JSON chunk must follow.",
     "Write the length of the whole file into bytes 8 to 11.", "base64:Z2xURgIAAAAMAAAA", kGood,
     Fix::none, true},
    {"GLB_TOO_MANY_CHUNKS", Severity::error, "A GLB has thousands of chunks",
     "An asset needs two. Files with thousands are made to keep a reader busy.",
     "Remove the chunks that hold neither the JSON text nor binary data.",
     "base64:Z2xURgIAAABAgAAAHAAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0g{{"
     "AAAAAFhYWFgAAAAAWFhYWAAAAABYWFhY*1366}}",
     kGood},
    {"GLB_UNEXPECTED_BIN_CHUNK", Severity::error, "The BIN chunk of a GLB is not the second chunk",
     "Readers look for binary data right behind the JSON chunk and nowhere else.",
     "Move the BIN chunk behind the JSON chunk, other chunks behind both.",
     "base64:Z2xURgIAAABIAAAAHAAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0gBAAAAFhYWFgAAAAAB"
     "AAAAEJJTgABAgME",
     kGood, Fix::none, true},
    {"GLB_UNEXPECTED_END_OF_CHUNK_DATA", Severity::error, "A GLB ends inside a chunk",
     "The file was cut off: part of the data is missing.", "Export or copy the file again.",
     "base64:Z2xURgIAAAA0AAAAIAAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0g", kGood, Fix::none,
     true},
    {"GLB_UNEXPECTED_END_OF_CHUNK_HEADER", Severity::error, "A GLB ends inside a chunk header",
     "A chunk header takes eight bytes; the file was cut off or carries stray bytes at its "
     "end.",
     "Export the file again, or cut the stray bytes and correct the length.",
     "base64:Z2xURgIAAAA0AAAAHAAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0gAAAAAA==", kGood,
     Fix::none, true},
    {"GLB_UNEXPECTED_END_OF_HEADER", Severity::error, "A GLB ends inside its header",
     "The header of a GLB takes twelve bytes; the file is shorter.",
     "Export or copy the file again.", "base64:Z2xURgIAAAA=", kGood, Fix::none, true},
    {"GLB_UNEXPECTED_FIRST_CHUNK", Severity::error,
     "The first chunk of a GLB is not the JSON chunk",
     "Readers take the first chunk for the JSON text.", "Write the JSON chunk first.",
     "base64:Z2xURgIAAAA8AAAABAAAAEJJTgABAgMEHAAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0g",
     kGood, Fix::none, true},
    {"GLB_UNKNOWN_CHUNK_TYPE", Severity::warning, "A GLB has a chunk of an unknown type",
     "Readers skip such a chunk, and tools that rewrite the file drop it.",
     "Keep application data in extras or in a buffer view instead.",
     "base64:Z2xURgIAAAA8AAAAHAAAAEpTT057ImFzc2V0Ijp7InZlcnNpb24iOiIyLjAifX0gBAAAAFhYWFgAAAAA",
     kGood, Fix::none, true},
};

}  // namespace

const Family& glb_family() {
  static const Family family{"glb", kRules, {}, {}};
  return family;
}

}  // namespace gltfx::validate
