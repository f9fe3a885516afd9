// SPDX-License-Identifier: Apache-2.0
// What decodes as base64 encodes to the same text again: no two texts mean the same bytes.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "container/base64.hpp"
#include "container/uri.hpp"

namespace {

using namespace gltfx::container;

void require(bool promise) {
  if (!promise) std::abort();
}

std::string encode(const std::string& bytes) {
  constexpr std::string_view kAlphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  std::uint32_t bits = 0;
  unsigned held = 0;
  for (const char c : bytes) {
    bits = (bits << 8U | static_cast<unsigned char>(c)) & 0xFFFFFFU;
    for (held += 8; held >= 6; held -= 6) text += kAlphabet[(bits >> (held - 6)) & 63U];
  }
  if (held > 0) text += kAlphabet[(bits << (6 - held)) & 63U];
  while (text.size() % 4 != 0) text += '=';
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string input(reinterpret_cast<const char*>(data), size);
  if (const auto bytes = decode_base64(input)) {
    require(encode(*bytes) == input);
  } else {
    require(!bytes.error().message.empty());
  }
  require(encode_base64(input) == encode(input));
  require(*decode_base64(encode(input)) == input);
  const auto uri = split_data_uri(input);
  require(!uri || classify_uri(input).kind == UriKind::data);
  if (!uri) return 0;
  require(input.ends_with(uri->payload));
  if (const auto payload = decode_payload(*uri)) require(payload->size() <= uri->payload.size());
  return 0;
}
