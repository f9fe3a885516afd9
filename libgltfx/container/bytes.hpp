// SPDX-License-Identifier: Apache-2.0
/// Read-only bytes with an owner (a mapping, a vector, or a part of either), and bytes combined
/// from those.
#pragma once

#include <cstddef>
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

/// The pieces as one string.
std::string join(const std::vector<Bytes>& pieces);

/// Writes the pieces one after the other. At most a few megabytes of a mapped file are resident at
/// a time. Nothing on success, else an Error.
std::optional<Error> write_pieces(FileDraft& draft, const std::vector<Bytes>& pieces);

/// Whether the bytes are equal; with the same bound on memory.
bool same_bytes(const Bytes& one, const Bytes& other);

}  // namespace gltfx::container
