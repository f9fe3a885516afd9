// SPDX-License-Identifier: Apache-2.0
/// The report on one file in a ResultCache.
///
/// Three values are kept of it. By the path: the states of all files and the key of the report. By
/// the asset's bytes: the names of the files it refers to. By the bytes of all of them: the report.
#pragma once

#include <gltfx/report.hpp>
#include <gltfx/result_cache.hpp>
#include <gltfx/validate.hpp>

#include <optional>
#include <string>
#include <vector>

#include "base/file_state.hpp"
#include "base/hash.hpp"
#include "container/container.hpp"
#include "container/resolver.hpp"

namespace gltfx {

/// Calls in this order: as_it_was(); with the container opened after it, by_content(); with the
/// report that was made of it, keep().
class KeptReport {
 public:
  /// All of them must outlive it.
  KeptReport(const std::string& path, const ValidateOptions& options);

  /// The report of an earlier run when neither the asset nor a file it refers to changed since, as
  /// far as the file system tells. Otherwise waits until a later change of the asset can be seen by
  /// its times (some hundredths of a second for a file that was just written).
  std::optional<FileReport> as_it_was();
  /// The report of an earlier run over the same bytes, wherever they lay.
  std::optional<FileReport> by_content(const container::Container& opened,
                                       const container::Resolver& resolver);
  /// `lookups`: of the resolver while the report was made.
  void keep(const FileReport& report, const container::Resolver& resolver,
            const container::LookupLog& lookups);

 private:
  struct Companion {
    std::string path;  ///< as the resolver takes it
    FileState state;
  };

  std::optional<FileReport> report_of(const Hash128& key) const;
  bool companions_of(const std::vector<std::string>& names, const container::Resolver& resolver,
                     HashParts& content, std::vector<Companion>& companions) const;
  bool settled(const std::vector<Companion>& companions) const;
  std::string snapshot(const std::vector<Companion>& companions, const Hash128& report) const;

  const std::string& path_;
  ResultStore& store_;
  Hash128 options_key_, path_key_, asset_key_;
  std::optional<FileState> state_;  ///< of the asset before it was opened
  std::int64_t begin_ = 0;          ///< nanoseconds since 1970
};

}  // namespace gltfx
