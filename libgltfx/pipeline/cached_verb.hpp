// SPDX-License-Identifier: Apache-2.0
/// A cache around a verb that knows nothing of it: what became of one file, in a ResultCache.
///
/// Three values are kept of it. By the path: the states of all files and the key of the result. By
/// the asset's bytes: the names of the files it refers to. By the bytes of all of them: the result.
#pragma once

#include <gltfx/result_cache.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/file_state.hpp"
#include "base/hash.hpp"
#include "codec/client.hpp"
#include "container/container.hpp"
#include "container/resolver.hpp"
#include "pipeline/open_asset.hpp"

namespace gltfx {

/// Calls in this order: find_unchanged(); with the container opened after it, by_content(); with
/// the result that was made of it, keep().
class CacheEntry {
 public:
  /// `options`: the key of all that the result depends on besides files. Path, bounds and cache
  /// outlive it.
  CacheEntry(const std::string& path, const AssetBounds& bounds, ResultCache& cache,
             const Hash128& options);

  /// The result of an earlier run when neither the asset nor a file it refers to changed since, as
  /// far as the file system tells. Otherwise waits until a later change of the asset can be seen by
  /// its times (some hundredths of a second for a file that was just written).
  std::optional<std::string> find_unchanged();
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

  std::optional<FileState> state_now() const;

  const std::string& path_;
  const AssetBounds& bounds_;
  ResultStore& store_;
  Hash128 options_key_, path_key_, asset_key_;
  std::optional<FileState> state_;  ///< of the asset before it was opened
  std::int64_t begin_ = 0;          ///< nanoseconds since 1970
};

/// What the verb says of the file at `path`, or said in an earlier run; `key` as CacheEntry has it.
/// A Verb has a type Report, and
///
///     Result<model::OpenedAsset> open() const;
///     Report refuse(std::string why) const;  // it cannot be opened
///     Report run(model::OpenedAsset asset) const;
///     std::optional<std::string> pack(const Report&) const;  // nothing: it is not kept
///     std::optional<Report> unpack(const std::string& kept, model::OpenedAsset* asset) const;
///
/// `asset` is the one that was opened, which the report may take; null: none was.
template <class Verb>
typename Verb::Report cached(const std::string& path, const AssetBounds& bounds, ResultCache& cache,
                             const Hash128& key, const Verb& verb) {
  CacheEntry kept(path, bounds, cache, key);
  if (const auto bytes = kept.find_unchanged()) {
    if (auto report = verb.unpack(*bytes, nullptr)) return *std::move(report);
  }
  auto opened = verb.open();
  if (!opened) return verb.refuse(opened.error().message);
  const container::Resolver resolver = opened->resolver();
  if (const auto bytes = kept.by_content(opened->container(), resolver)) {
    if (auto report = verb.unpack(*bytes, &*opened)) return *std::move(report);
  }
  const auto lookups = std::make_shared<container::LookupLog>();
  opened->record(lookups);
  // A report that a missing or interrupted decoder shaped may differ in the next run, even where
  // no finding says so.
  const std::uint64_t chances = codec::transient_errors();
  auto report = verb.run(*std::move(opened));
  if (codec::transient_errors() != chances) return report;
  if (const auto packed = verb.pack(report)) kept.keep(*packed, resolver, *lookups);
  return report;
}

}  // namespace gltfx
