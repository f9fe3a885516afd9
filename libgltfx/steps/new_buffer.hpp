// SPDX-License-Identifier: Apache-2.0
/// New bytes of a step.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "change/change.hpp"
#include "container/bytes.hpp"
#include "model/opened_asset.hpp"

namespace gltfx::steps {

/// A buffer after those of the asset. Its file exists only between steps: the layout
/// (`steps/layout.hpp`) moves its bytes into the buffers of the asset.
class NewBuffer {
 public:
  explicit NewBuffer(const model::OpenedAsset& asset);

  std::uint64_t index() const { return index_; }
  bool empty() const { return pieces_.empty(); }
  /// Returns the offset of the bytes in the buffer, a multiple of 8. Precondition: `bytes` is not
  /// empty.
  std::uint64_t add(container::Bytes bytes);
  std::uint64_t add(std::string bytes);

  /// Moves the buffer into a change, unless it is empty. Precondition: the change has no other new
  /// buffer.
  void add_to(change::Change& change);

  /// The path of the file of such a buffer: a name that is not in `taken`, and then is.
  static std::string own_path(std::set<std::string>& taken, std::uint64_t number);
  /// Whether a path is the file of such a buffer.
  static bool is_own(const std::string& path);

 private:
  std::uint64_t index_;
  std::uint64_t size_ = 0;
  std::vector<container::Bytes> pieces_;
  std::string path_;
};

}  // namespace gltfx::steps
