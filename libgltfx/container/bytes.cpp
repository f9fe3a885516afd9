// SPDX-License-Identifier: Apache-2.0
#include "container/bytes.hpp"

#include <algorithm>
#include <utility>

#include "base/checked.hpp"
#include "base/temporary_file.hpp"
#include "container/file.hpp"
#include "container/mapped_files.hpp"

namespace gltfx::container {
namespace {

constexpr std::size_t kStep = std::size_t{1} << 20U;
constexpr std::size_t kSmall = std::size_t{16} << 20U;

// `file` has write().
template <class File>
std::optional<Error> write_to(File& file, const std::vector<Bytes>& pieces) {
  for (const Bytes& piece : pieces) {
    const ReadMeter meter(piece);
    for (std::size_t at = 0; at < piece.size(); at += kStep) {
      const std::string_view step = piece.text().substr(at, kStep);
      if (auto trouble = file.write(step)) return trouble;
      meter.add(step.size());
    }
  }
  return std::nullopt;
}

template <class File>
std::optional<Bytes> written_to(File& file, const std::vector<Bytes>& pieces) {
  if (write_to(file, pieces)) return std::nullopt;
  Loaded loaded = load_file(adopt_regular(file.reader()));
  if (loaded.error != ResolveError::none) return std::nullopt;
  return std::move(loaded.bytes);
}

}  // namespace

Bytes Bytes::from_string(std::string text) { return from_text(share_text(std::move(text))); }

Bytes Bytes::from_text(const SharedText& text) {
  if (!text) return {};
  return {std::as_bytes(std::span(text->data(), text->size())), text};
}

std::size_t size_of(const std::vector<Bytes>& pieces) {
  std::size_t size = 0;
  for (const Bytes& piece : pieces) size += piece.size();
  return size;
}

std::string join(const std::vector<Bytes>& pieces) {
  std::string text;
  text.reserve(size_of(pieces));
  for (const Bytes& piece : pieces) text += piece.text();
  return text;
}

bool is_large(const std::vector<Bytes>& pieces) { return size_of(pieces) > kSmall; }

Bytes gathered(const std::vector<Bytes>& pieces, const std::filesystem::path& folder) {
  if (pieces.size() == 1) return pieces.front();
  if (is_large(pieces) && !folder.empty()) {
    TemporaryFile file(folder / "draft");
    if (auto bytes = written_to(file, pieces)) return *std::move(bytes);
  }
  return Bytes::from_string(join(pieces));
}

std::optional<Bytes> gathered(const std::vector<Bytes>& pieces, FileDraft& draft) {
  auto bytes = written_to(draft, pieces);
  if (bytes) draft.begin_sync();
  return bytes;
}

std::optional<Error> write_pieces(FileDraft& draft, const std::vector<Bytes>& pieces) {
  return write_to(draft, pieces);
}

bool same_bytes(const std::vector<Bytes>& pieces, const Bytes& other) {
  std::size_t at = 0;
  for (const Bytes& piece : pieces) {
    if (!fits(at, piece.size(), other.size())) return false;
    if (!same_bytes(other.part(at, piece.size()), piece)) return false;
    at += piece.size();
  }
  return at == other.size();
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
