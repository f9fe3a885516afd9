// SPDX-License-Identifier: Apache-2.0
#include "pipeline/kept_pictures.hpp"

#include <gltfx/result_cache.hpp>

#include "codec/client.hpp"
#include "pipeline/byte_list.hpp"
#include "pipeline/cached_picture.hpp"
#include "rules/validation_key.hpp"

namespace gltfx {
namespace {

// Findings may be why there is no picture, but not where a limit is stated.
Hash128 key_of(ValidateOptions options, const BakeOptions& bake) {
  for (Limit& limit : options.limits) {
    limit.from.clear();
    limit.note.clear();
  }
  HashParts parts;
  parts.add("pictures of the page");
  parts.add(picture_key(bake, *options.cache));
  parts.add(validation_key(options, options.cache->folder()));
  return parts.finish();
}

void append(std::string& kept, const PagePicture& picture) {
  append_text(kept, picture.uri);
  append_value(kept, picture.size);
  append_text(kept, picture.problem);
}

bool take(ByteCursor& cursor, PagePicture& picture) {
  std::string_view uri;
  std::string_view problem;
  if (!cursor.take_text(uri) || !cursor.take(picture.size) || !cursor.take_text(problem)) {
    return false;
  }
  picture.uri = uri;
  picture.problem = problem;
  return true;
}

}  // namespace

// With lines that changed, the report that a picture is made with has but some findings.
KeptPictures::KeptPictures(const std::string& path, const ValidateOptions& options,
                           const BakeOptions& bake)
    : bounds_(AssetBounds::of(options)) {
  if (!options.cache || options.changed_lines) return;
  entry_.emplace(path, bounds_, *options.cache, key_of(options, bake));
}

void KeptPictures::look_up() {
  chances_ = codec::transient_errors();
  if (entry_) known_ = entry_->find_unchanged();
}

void KeptPictures::look_up(model::OpenedAsset& asset) {
  if (!entry_ || known_) return;
  resolver_ = asset.resolver();
  known_ = entry_->by_content(asset.container(), resolver_);
  if (!known_) lookups_ = asset.recorded();
}

bool KeptPictures::recall(PageAsset& page) const {
  if (!known_) return false;
  ByteCursor cursor(*known_);
  PagePicture picture;
  PagePicture upgraded;
  if (!take(cursor, picture) || (!cursor.empty() && !take(cursor, upgraded))) return false;
  page.picture = std::move(picture);
  if (!upgraded.uri.empty() || !upgraded.problem.empty()) page.upgraded = std::move(upgraded);
  return true;
}

void KeptPictures::keep(const PageAsset& page) {
  if (!lookups_ || codec::transient_errors() != chances_) return;
  std::string kept;
  append(kept, page.picture);
  if (page.upgraded) append(kept, *page.upgraded);
  entry_->keep(kept, resolver_, *lookups_);
}

}  // namespace gltfx
