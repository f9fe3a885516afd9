// SPDX-License-Identifier: Apache-2.0
// What a build without libsodium, and without a user whose key it could keep, has in place of the
// cache.
#include <gltfx/result_cache.hpp>

#include "pipeline/result_store.hpp"

namespace gltfx {

ResultStore::~ResultStore() = default;
std::optional<std::string> ResultStore::find(const Hash128&) const { return std::nullopt; }
void ResultStore::add(std::span<const Value>) {}
Hash128 ResultStore::hash(std::string_view) const { return {}; }

std::shared_ptr<ResultCache> ResultCache::open(const std::string&, std::string& problem) {
  problem = "this build keeps no results";
  return nullptr;
}
std::shared_ptr<ResultCache> ResultCache::open(const std::string& folder, const std::string&,
                                               std::string& problem) {
  return open(folder, problem);
}
ResultCache::~ResultCache() = default;
std::string ResultCache::finish() { return {}; }
std::size_t ResultCache::foreign_files() const { return 0; }

}  // namespace gltfx
