// SPDX-License-Identifier: Apache-2.0
#include "change/draft_place.hpp"

#include <system_error>

namespace gltfx::change {
namespace {

namespace fs = std::filesystem;
using container::Bytes;
using Pieces = std::vector<Bytes>;

}  // namespace

Bytes DraftPlace::hold_file(const Pieces& pieces) const {
  return container::gathered(pieces, folder_);
}

Bytes DraftPlace::hold_asset(const Pieces& pieces) {
  if (output_.empty() || !container::is_large(pieces) || !open_output()) return hold_file(pieces);
  if (auto bytes = container::gathered(pieces, *file_)) return *std::move(bytes);
  file_.reset();  // commit() reports the reason
  return hold_file(pieces);
}

// commit() makes missing folders: here they could be those of an asset that is refused.
bool DraftPlace::open_output() {
  std::error_code error;
  if (!fs::is_directory(output_.parent_path().empty() ? "." : output_.parent_path(), error)) {
    return false;
  }
  const auto seen = state_if_there(output_);
  if (seen) file_.emplace(output_, *seen);
  return file_.has_value();
}

}  // namespace gltfx::change
