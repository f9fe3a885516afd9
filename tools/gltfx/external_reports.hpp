// SPDX-License-Identifier: Apache-2.0
/// Reports on external assets (glTF 2.1), each written once, after those on all inputs.
#pragma once

#include <gltfx/report.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_set>
#include <vector>

#include "base/hash.hpp"

namespace gltfx::tool {

/// Holds them until the end, since a later input may be the same file. An input has its own report.
class ExternalReports {
 public:
  /// Notes an input of any shard.
  void name(const std::string& path);
  /// Moves the external assets of a report here.
  void take_from(FileReport& report);
  /// Sorted by path. Their position is that after all inputs, also those of other shards.
  std::vector<FileReport> take();

 private:
  struct HashOfPath {
    std::size_t operator()(const Hash128& hash) const { return static_cast<std::size_t>(hash.low); }
  };

  std::unordered_set<Hash128, HashOfPath> named_;
  std::uint64_t inputs_ = 0;
  std::map<std::string, FileReport> waiting_;  ///< by normal path
};

}  // namespace gltfx::tool
