// SPDX-License-Identifier: Apache-2.0
/// A cache around a verb that knows nothing of it.
#pragma once

#include <gltfx/result_cache.hpp>

#include <memory>
#include <string>
#include <utility>

#include "codec/chance.hpp"
#include "pipeline/cache_entry.hpp"
#include "pipeline/open_asset.hpp"

namespace gltfx {

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
typename Verb::Report cached(const std::string& path, ResultCache& cache, const Hash128& key,
                             const Verb& verb) {
  CacheEntry kept(path, cache, key);
  if (const auto bytes = kept.as_it_was()) {
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
  const std::uint64_t chances = codec::errors_by_chance();
  auto report = verb.run(*std::move(opened));
  if (codec::errors_by_chance() != chances) return report;
  if (const auto packed = verb.pack(report)) kept.keep(*packed, resolver, *lookups);
  return report;
}

}  // namespace gltfx
