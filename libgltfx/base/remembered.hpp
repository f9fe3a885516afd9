// SPDX-License-Identifier: Apache-2.0
/// Results that cost much, of arguments that seldom change.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

namespace gltfx {

/// The last results of one thread: make it thread_local.
template <class Key, class Value, std::size_t kCount>
class Remembered {
 public:
  /// The result for a key, else that of make(). It lives as long as a pointer to it.
  template <class Make>
  std::shared_ptr<const Value> get(const Key& key, const Make& make) {
    for (const Entry& entry : entries_) {
      if (entry.value && entry.key == key) return entry.value;
    }
    std::shared_ptr<const Value> value = std::make_shared<const Value>(make());
    entries_[oldest_] = {key, value};
    oldest_ = (oldest_ + 1) % kCount;
    return value;
  }

 private:
  struct Entry {
    Key key;
    std::shared_ptr<const Value> value;
  };
  std::array<Entry, kCount> entries_;
  std::size_t oldest_ = 0;
};

}  // namespace gltfx
