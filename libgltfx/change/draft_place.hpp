// SPDX-License-Identifier: Apache-2.0
/// Where the bytes of a draft lie until they are proven and written.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "base/replace_file.hpp"
#include "container/bytes.hpp"

namespace gltfx::change {

/// Not thread-safe.
class DraftPlace {
 public:
  /// In memory.
  DraftPlace() = default;
  /// What is large lies in a file without a name in `folder`. An asset that goes to `output` lies
  /// in the draft of that file; empty: it goes nowhere, or in the place of a file.
  DraftPlace(std::filesystem::path folder, std::filesystem::path output)
      : folder_(std::move(folder)), output_(std::move(output)) {}
  /// Folders that were made for `output` go again where they are empty.
  ~DraftPlace();
  DraftPlace(const DraftPlace&) = delete;
  DraftPlace& operator=(const DraftPlace&) = delete;

  /// The pieces in one stretch of memory, those of a file or of the asset itself.
  container::Bytes hold_file(const std::vector<container::Bytes>& pieces) const;
  container::Bytes hold_asset(const std::vector<container::Bytes>& pieces);
  /// The draft of `output`, where it holds the asset; else null.
  FileDraft* asset_file() { return file_ ? &*file_ : nullptr; }

 private:
  bool open_output();

  std::filesystem::path folder_, output_;
  std::vector<std::filesystem::path> made_;  ///< folders, the outermost first
  std::optional<FileDraft> file_;
};

}  // namespace gltfx::change
