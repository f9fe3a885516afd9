// SPDX-License-Identifier: Apache-2.0
#include "pipeline/edit_bytes.hpp"

#include "change/rewrite.hpp"
#include "pipeline/open_asset.hpp"

namespace gltfx {

EditedAsset to_edit(const model::OpenedAsset& asset) {
  return {{asset.name(), without_zero_padding(asset.container()), asset.resolver()}, {}};
}

Result<EditedAsset> open_to_edit(MemoryAsset asset, const EditOptions& options) {
  if (writes(options) || options.backup) {
    return Error{"an asset in memory is not written: in_place, backup and output are for files"};
  }
  auto opened = open_memory(std::move(asset), options.root);
  if (!opened) return opened.error();
  return to_edit(*opened);
}

Result<std::string> bytes_of(const Draft& draft) {
  const auto pieces = change::rewrite(draft.asset.asset().container());
  if (!pieces) return pieces.error();
  return container::join(*pieces);
}

std::map<std::string, std::string> files_of(const Draft& draft) {
  std::map<std::string, std::string> files;
  for (const change::NewFile& file : draft.files) {
    files.emplace(file.path, container::join(file.pieces));
  }
  for (const change::ReplacedFile& file : draft.replaced) {
    files.emplace(file.path, file.after.text());
  }
  return files;
}

}  // namespace gltfx
