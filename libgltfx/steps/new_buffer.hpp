// SPDX-License-Identifier: Apache-2.0
/// Bytes that a step makes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "change/change.hpp"
#include "container/bytes.hpp"
#include "model/opened_asset.hpp"

namespace gltfx::steps {

/// A buffer behind those of the asset, whose file exists only between steps: the layout of the last
/// step (`steps/layout.hpp`) moves its bytes to where the asset has its own.
class NewBuffer {
 public:
  explicit NewBuffer(const model::OpenedAsset& asset);

  std::uint64_t index() const { return index_; }
  bool empty() const { return pieces_.empty(); }
  /// Returns the offset of the bytes in the buffer, a multiple of 8. Precondition: there are some.
  std::uint64_t add(container::Bytes bytes);
  std::uint64_t add(std::string bytes);

  /// Gives the buffer to a change, unless it is empty. Precondition: no other buffer was added to
  /// the change.
  void add_to(change::Change& change);

  /// Whether a document refers to a path for the file of such a buffer.
  static bool is_own(const std::string& path);

 private:
  std::uint64_t index_;
  std::uint64_t size_ = 0;
  std::vector<container::Bytes> pieces_;
  std::string path_;
};

}  // namespace gltfx::steps
