// SPDX-License-Identifier: Apache-2.0
/// New contents of buffers, wherever these are: in the BIN chunk of a GLB, in files, or in data
/// URIs.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "container/container.hpp"
#include "container/resolver.hpp"
#include "edit/new_file.hpp"
#include "edit/rewrite.hpp"
#include "json/edit.hpp"

namespace gltfx::edit {

/// Whole contents by the index of the buffer. They may be longer than the old ones, never shorter.
using BufferContents = std::map<std::uint32_t, std::string>;

/// What they come to.
struct ChangedBuffers {
  BinChange bin;
  std::vector<ReplacedFile> files;
};

/// Puts new contents where the old ones are; data URIs change by `editor`. An Error where the bytes
/// of a buffer cannot be found, or two buffers are one file.
Result<ChangedBuffers> change_buffers(const json::Document& document,
                                      const container::Container& container,
                                      const container::Resolver& resolver, BufferContents contents,
                                      json::Editor& editor);

}  // namespace gltfx::edit
