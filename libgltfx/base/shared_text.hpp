// SPDX-License-Identifier: Apache-2.0
/// Immutable shared text.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace gltfx {

/// Immutable text with shared ownership, followed by a NUL. Null: there is none.
using SharedText = std::shared_ptr<const std::string_view>;

/// Takes over the memory of `text`.
SharedText share_text(std::string text);

/// Room for a text of known length, to be filled and then shared.
class TextRoom {
 public:
  /// Check operator bool: no text can be that long. Throws std::bad_alloc.
  explicit TextRoom(std::size_t size);

  explicit operator bool() const { return bytes_ != nullptr; }
  char* data() { return bytes_.get(); }
  std::size_t size() const { return size_; }
  SharedText share() &&;

 private:
  struct Free {
    std::size_t bytes;  ///< as allocated
    void operator()(char* memory) const noexcept;
  };
  std::unique_ptr<char, Free> bytes_;
  std::size_t size_;
};

}  // namespace gltfx
