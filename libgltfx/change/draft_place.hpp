// SPDX-License-Identifier: Apache-2.0
/// Where the bytes of a draft lie until they are proven and written.
#pragma once

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "base/replace_file.hpp"
#include "container/bytes.hpp"

namespace gltfx::change {

/// Not thread-safe.
class DraftPlace {
 public:
  /// In memory.
  DraftPlace() = default;
  /// Large contents are kept in an unnamed file in `folder`, a large asset in the draft of `output`
  /// if the folder of that exists. Empty `output`: nothing is written, or a file is replaced.
  DraftPlace(std::filesystem::path folder, std::filesystem::path output)
      : folder_(std::move(folder)), output_(std::move(output)) {}

  /// The pieces in one stretch of memory, those of a file or of the asset itself.
  container::Bytes hold_file(const std::vector<container::Bytes>& pieces) const;
  container::Bytes hold_asset(const std::vector<container::Bytes>& pieces);
  /// The draft of `output`, where it holds the asset; else null.
  FileDraft* asset_file() { return file_ ? &*file_ : nullptr; }

 private:
  bool open_output();

  std::filesystem::path folder_, output_;
  std::optional<FileDraft> file_;
};

}  // namespace gltfx::change
