// SPDX-License-Identifier: Apache-2.0
/// The parts of a Set: all of them, or those of an image, each read at first use. A document needs
/// a tenth of the built-in parts.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "schema/text_index.hpp"

namespace gltfx::schema {

/// Thread-safe. `read_part(bytes, texts, part)` reads a T.
template <class T>
class Lazy {
 public:
  explicit Lazy(std::vector<T> all) : all_(std::move(all)), made_(all_.size()) {
    for (std::size_t i = 0; i < all_.size(); ++i) made_[i] = &all_[i];
  }
  /// `bytes` and `texts` must outlive this; part i ends before byte `ends[i]`.
  Lazy(std::string_view bytes, std::vector<std::uint32_t> ends, Texts texts)
      : bytes_(bytes), texts_(texts), ends_(std::move(ends)), made_(ends_.size()) {}
  ~Lazy() {
    if (!all_.empty()) return;
    for (const auto& made : made_) const std::unique_ptr<const T> last(made.load());
  }
  Lazy(const Lazy&) = delete;
  Lazy& operator=(const Lazy&) = delete;

  std::size_t size() const { return made_.size(); }
  const T& operator[](std::size_t i) const {
    const T* made = made_[i].load(std::memory_order_acquire);
    return made != nullptr ? *made : read(i);
  }

 private:
  const T& read(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends_[i - 1];
    auto part = std::make_unique<T>();
    read_part(bytes_.substr(begin, ends_[i] - begin), texts_, *part);
    const T* made = nullptr;  // another thread may be first
    if (made_[i].compare_exchange_strong(made, part.get())) return *part.release();
    return *made;
  }

  std::vector<T> all_;
  std::string_view bytes_;
  Texts texts_;
  std::vector<std::uint32_t> ends_;
  mutable std::vector<std::atomic<const T*>> made_;  ///< null: not read yet
};

}  // namespace gltfx::schema
