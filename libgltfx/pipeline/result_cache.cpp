// SPDX-License-Identifier: Apache-2.0
#include <gltfx/result_cache.hpp>

#include <filesystem>
#include <system_error>
#include <utility>

#include "pipeline/result_store.hpp"

namespace gltfx {

std::shared_ptr<ResultCache> ResultCache::open(const std::string& folder, std::string& problem) {
  auto store = ResultStore::open(folder);
  if (!store) {
    problem = store.error().message;
    return nullptr;
  }
  std::error_code fault;
  std::string here = std::filesystem::current_path(fault).native();
  return std::shared_ptr<ResultCache>(new ResultCache(*std::move(store), std::move(here)));
}

ResultCache::ResultCache(std::unique_ptr<ResultStore> store, std::string folder)
    : store_(std::move(store)), folder_(std::move(folder)) {}

ResultCache::~ResultCache() = default;

std::string ResultCache::finish() {
  const auto problem = store_->problem();
  store_->tidy();
  return problem ? problem->message : std::string();
}

}  // namespace gltfx
