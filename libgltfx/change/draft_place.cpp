// SPDX-License-Identifier: Apache-2.0
#include "change/draft_place.hpp"

#include <algorithm>
#include <system_error>

namespace gltfx::change {
namespace {

namespace fs = std::filesystem;
using container::Bytes;
using Pieces = std::vector<Bytes>;

}  // namespace

DraftPlace::~DraftPlace() {
  file_.reset();
  std::error_code ignored;
  for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) fs::remove(*folder, ignored);
}

Bytes DraftPlace::hold_file(const Pieces& pieces) const {
  return container::gathered(pieces, folder_);
}

Bytes DraftPlace::hold_asset(const Pieces& pieces) {
  if (output_.empty() || !container::is_large(pieces) || !open_output()) return hold_file(pieces);
  if (auto bytes = container::gathered(pieces, *file_)) return *std::move(bytes);
  file_.reset();  // commit() says why
  return hold_file(pieces);
}

bool DraftPlace::open_output() {
  std::error_code error;
  for (fs::path folder = output_.parent_path(); !folder.empty() && !fs::exists(folder, error);
       folder = folder.parent_path()) {
    made_.insert(made_.begin(), folder);
  }
  for (const fs::path& folder : made_) {
    if (!fs::create_directory(folder, error)) return false;
  }
  const auto seen = state_if_there(output_);
  if (seen) file_.emplace(output_, *seen);
  return file_.has_value();
}

}  // namespace gltfx::change
