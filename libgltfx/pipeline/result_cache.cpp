// SPDX-License-Identifier: Apache-2.0
#include <gltfx/result_cache.hpp>

#include <filesystem>
#include <system_error>
#include <utility>

#include "pipeline/result_store.hpp"
#include "pipeline/seal.hpp"

namespace gltfx {

std::shared_ptr<ResultCache> ResultCache::open(const std::string& folder, std::string& problem) {
  const auto secret = users_secret();
  if (!secret) {
    problem = secret.error().message;
    return nullptr;
  }
  return open_with(folder, *secret, false, problem);
}

std::shared_ptr<ResultCache> ResultCache::open(const std::string& folder, const std::string& key,
                                               std::string& problem) {
  if (key.size() >= kShortestSecret) return open_with(folder, key, true, problem);
  problem = "a key has at least " + std::to_string(kShortestSecret) + " bytes; this one has " +
            std::to_string(key.size());
  return nullptr;
}

std::shared_ptr<ResultCache> ResultCache::open_with(const std::string& folder,
                                                    std::string_view secret, bool shared,
                                                    std::string& problem) {
  const auto owner = shared ? ResultStore::Owner::shared : ResultStore::Owner::user;
  auto store = ResultStore::open(folder, secret, owner);
  if (!store) {
    problem = store.error().message;
    return nullptr;
  }
  std::error_code error;
  std::string here = std::filesystem::current_path(error).native();
  return std::shared_ptr<ResultCache>(new ResultCache(*std::move(store), std::move(here)));
}

std::size_t ResultCache::foreign_files() const { return store_->foreign_files(); }

ResultCache::ResultCache(std::unique_ptr<ResultStore> store, std::string folder)
    : store_(std::move(store)), folder_(std::move(folder)) {}

ResultCache::~ResultCache() = default;

std::string ResultCache::finish() {
  const auto problem = store_->problem();
  store_->tidy();
  return problem ? problem->message : std::string();
}

}  // namespace gltfx
