// SPDX-License-Identifier: Apache-2.0
#include "container/bytes.hpp"

#include <algorithm>
#include <utility>

#include "container/mapping.hpp"

namespace gltfx::container {
namespace {

constexpr std::size_t kStep = std::size_t{1} << 20U;

}  // namespace

Bytes Bytes::from_string(std::string text) { return from_text(share_text(std::move(text))); }

Bytes Bytes::from_text(const SharedText& text) {
  if (!text) return {};
  return {std::as_bytes(std::span(text->data(), text->size())), text};
}

std::string join(const std::vector<Bytes>& pieces) {
  std::size_t size = 0;
  for (const Bytes& piece : pieces) size += piece.size();
  std::string text;
  text.reserve(size);
  for (const Bytes& piece : pieces) text += piece.text();
  return text;
}

std::optional<Error> write_pieces(FileDraft& draft, const std::vector<Bytes>& pieces) {
  for (const Bytes& piece : pieces) {
    const ReadMeter meter(piece);
    for (std::size_t at = 0; at < piece.size(); at += kStep) {
      const std::string_view step = piece.text().substr(at, kStep);
      if (auto trouble = draft.write(step)) return trouble;
      meter.add(step.size());
    }
  }
  return std::nullopt;
}

bool same_bytes(const Bytes& one, const Bytes& other) {
  if (one.size() != other.size()) return false;
  const ReadMeter meter(one);
  const ReadMeter other_meter(other);
  for (std::size_t at = 0; at < one.size(); at += kStep) {
    const std::string_view step = one.text().substr(at, kStep);
    if (step != other.text().substr(at, kStep)) return false;
    meter.add(step.size());
    other_meter.add(step.size());
  }
  return true;
}

}  // namespace gltfx::container
