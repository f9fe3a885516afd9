// SPDX-License-Identifier: Apache-2.0
/// What became of one file, in a ResultCache.
///
/// Three values are kept of it. By the path: the states of all files and the key of the result. By
/// the asset's bytes: the names of the files it refers to. By the bytes of all of them: the result.
#pragma once

#include <gltfx/result_cache.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_state.hpp"
#include "base/hash.hpp"
#include "container/container.hpp"
#include "container/resolver.hpp"

namespace gltfx {

/// Calls in this order: as_it_was(); with the container opened after it, by_content(); with the
/// result that was made of it, keep().
class CacheEntry {
 public:
  /// `options`: the key of all that the result depends on besides files. Path and cache outlive it.
  CacheEntry(const std::string& path, ResultCache& cache, const Hash128& options);

  /// The result of an earlier run when neither the asset nor a file it refers to changed since, as
  /// far as the file system tells. Otherwise waits until a later change of the asset can be seen by
  /// its times (some hundredths of a second for a file that was just written).
  std::optional<std::string> as_it_was();
  /// The result of an earlier run over the same bytes, wherever they lay.
  std::optional<std::string> by_content(const container::Container& opened,
                                        const container::Resolver& resolver);
  /// Nothing is kept where a file could not be read or changed meanwhile. `lookups`: of the
  /// resolver while the result was made.
  void keep(std::string_view result, const container::Resolver& resolver,
            const container::LookupLog& lookups);

 private:
  struct Companion {
    std::string path;  ///< as the resolver takes it
    FileState state;
  };

  bool companions_of(const std::vector<std::string>& names, const container::Resolver& resolver,
                     HashParts& content, std::vector<Companion>& companions) const;
  bool settled(const std::vector<Companion>& companions) const;
  std::string snapshot(const std::vector<Companion>& companions, const Hash128& result) const;

  const std::string& path_;
  ResultStore& store_;
  Hash128 options_key_, path_key_, asset_key_;
  std::optional<FileState> state_;  ///< of the asset before it was opened
  std::int64_t begin_ = 0;          ///< nanoseconds since 1970
};

}  // namespace gltfx
