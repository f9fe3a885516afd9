// SPDX-License-Identifier: Apache-2.0
/// Read-only bytes with an owner (a mapping, a vector, or a part of either), and bytes combined
/// from those.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/replace_file.hpp"
#include "base/shared_text.hpp"

namespace gltfx::container {

/// Cheap to copy; keeps what it points into alive.
class Bytes {
 public:
  Bytes() = default;
  Bytes(std::span<const std::byte> view, std::shared_ptr<const void> owner)
      : view_(view), owner_(std::move(owner)) {}

  /// Takes over the memory of `text`.
  static Bytes from_string(std::string text);
  /// Shares the memory of `text`; empty for null.
  static Bytes from_text(const SharedText& text);

  std::span<const std::byte> view() const { return view_; }
  std::string_view text() const {
    return {reinterpret_cast<const char*>(view_.data()), view_.size()};
  }
  std::size_t size() const { return view_.size(); }
  bool empty() const { return view_.empty(); }
  const std::shared_ptr<const void>& owner() const { return owner_; }
  /// A part of these bytes with the same owner. Precondition: it is inside.
  Bytes part(std::size_t offset, std::size_t length) const {
    return {view_.subspan(offset, length), owner_};
  }

 private:
  std::span<const std::byte> view_;
  std::shared_ptr<const void> owner_;
};

/// Of all of them.
std::size_t size_of(const std::vector<Bytes>& pieces);

/// All of them in one text.
std::string join(const std::vector<Bytes>& pieces);

/// Whether they are more than one should copy to memory that the system cannot take back.
bool is_large(const std::vector<Bytes>& pieces);

/// The same in one stretch of memory: what is large lies in a file without a name in `folder`,
/// which is mapped, unless the folder is empty or can take no file.
Bytes gathered(const std::vector<Bytes>& pieces, const std::filesystem::path& folder);
/// The same in the file of an empty draft, which is mapped. Nothing: it cannot be written.
std::optional<Bytes> gathered(const std::vector<Bytes>& pieces, FileDraft& draft);

/// Writes one behind the other. Of a mapped file a few megabytes are resident at a time. Nothing
/// when all is written, else why it is not.
std::optional<Error> write_pieces(FileDraft& draft, const std::vector<Bytes>& pieces);

/// Whether the bytes are equal; with the same bound on memory.
bool same_bytes(const Bytes& one, const Bytes& other);
bool same_bytes(const std::vector<Bytes>& pieces, const Bytes& other);

}  // namespace gltfx::container
