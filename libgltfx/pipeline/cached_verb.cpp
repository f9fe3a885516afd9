// SPDX-License-Identifier: Apache-2.0
#include "pipeline/cached_verb.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <filesystem>
#include <set>

#include "pipeline/byte_list.hpp"
#include "pipeline/result_store.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;

// Two changes within this time may get the same time stamp. Linux has a tick of 10 ms at most.
constexpr std::int64_t kTick = 20'000'000;
constexpr std::int64_t kSecond = 1'000'000'000;

std::int64_t now() {
  timespec time{};
  ::clock_gettime(CLOCK_REALTIME, &time);
  return std::int64_t{time.tv_sec} * kSecond + time.tv_nsec;
}

void wait_until(std::int64_t time) {
  timespec until{};
  until.tv_sec = static_cast<std::time_t>(time / kSecond);
  until.tv_nsec = static_cast<long>(time % kSecond);
  while (::clock_nanosleep(CLOCK_REALTIME, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

Hash128 key_of(std::string_view kind, const Hash128& context, const HashParts& parts) {
  HashParts all;
  all.add(kind);
  all.add(context);
  all.add(parts.finish());
  return all.finish();
}

Hash128 path_key(const std::string& path, const std::string& folder, const Hash128& context) {
  HashParts parts;
  if (!path.starts_with('/')) parts.add(folder);
  parts.add(path);
  return key_of("path", context, parts);
}

}  // namespace

CacheEntry::CacheEntry(const std::string& path, const AssetBounds& bounds, ResultCache& cache,
                       const Hash128& options)
    : path_(path),
      bounds_(bounds),
      store_(cache.store()),
      options_key_(options),
      path_key_(path_key(path, cache.folder(), options)) {}

std::optional<std::string> CacheEntry::find_unchanged() {
  state_ = state_now();
  if (!state_) return std::nullopt;
  if (const auto bytes = store_.find(path_key_)) {
    ByteCursor cursor(*bytes);
    Hash128 result;
    FileState known;
    bool same = cursor.take(result) && cursor.take(known) && known == *state_;
    const fs::path folder = fs::path(path_).parent_path();
    while (same && !cursor.empty()) {
      std::string_view name;
      same = cursor.take_text(name) && cursor.take(known);
      const auto companion = same ? file_state(folder / name) : Result<FileState>(FileState());
      same = same && companion && *companion == known;
    }
    if (same) {
      if (auto kept = store_.find(result)) return kept;
    }
  }
  if (now() < state_->status_change + kTick && now() >= state_->status_change) {
    wait_until(state_->status_change + kTick);
  }
  begin_ = now();
  return std::nullopt;
}

std::optional<std::string> CacheEntry::by_content(const container::Container& opened,
                                                  const container::Resolver& resolver) {
  HashParts asset;
  asset.add(fs::path(path_).filename().native());
  asset.add(store_.hash(opened.bytes.text()));
  asset_key_ = key_of("asset", options_key_, asset);
  const auto bytes = store_.find(asset_key_);
  if (!bytes) return std::nullopt;
  std::vector<std::string> names;
  for (ByteCursor cursor(*bytes); !cursor.empty();) {
    std::string_view name;
    if (!cursor.take_text(name)) return std::nullopt;
    names.emplace_back(name);
  }
  HashParts content;
  std::vector<Companion> companions;
  if (!companions_of(names, resolver, content, companions)) return std::nullopt;
  const Hash128 key = key_of("content", asset_key_, content);
  auto result = store_.find(key);
  if (result && settled(companions)) {
    const ResultStore::Value value{path_key_, snapshot(companions, key)};
    store_.add({&value, 1});
  }
  return result;
}

bool CacheEntry::companions_of(const std::vector<std::string>& names,
                               const container::Resolver& resolver, HashParts& content,
                               std::vector<Companion>& companions) const {
  for (const std::string& name : names) {
    const container::Resolved file = resolver.open(name);
    if (file.error != container::ResolveError::none) return false;
    content.add(name);
    content.add(store_.hash(file.bytes.text()));
    companions.push_back({name, file.state});
  }
  return true;
}

// A file that may not be opened has no state: what was kept of it when it was named is not for all.
std::optional<FileState> CacheEntry::state_now() const {
  const auto file = open_asset_file(path_, bounds_);
  if (!file || file->error != container::ResolveError::none) return std::nullopt;
  return file->state;
}

// Whether what was read is what lies there now: nothing was written while the report was made or so
// shortly before that the times need not show it.
bool CacheEntry::settled(const std::vector<Companion>& companions) const {
  if (state_now() != state_) return false;
  const auto old = [this](const FileState& file) { return file.status_change + kTick <= begin_; };
  return old(*state_) && std::all_of(companions.begin(), companions.end(),
                                     [&](const Companion& file) { return old(file.state); });
}

std::string CacheEntry::snapshot(const std::vector<Companion>& companions,
                                 const Hash128& result) const {
  std::string bytes;
  append_value(bytes, result);
  append_value(bytes, *state_);
  for (const Companion& companion : companions) {
    append_text(bytes, companion.path);
    append_value(bytes, companion.state);
  }
  return bytes;
}

void CacheEntry::keep(std::string_view result, const container::Resolver& resolver,
                      const container::LookupLog& lookups) {
  if (!state_) return;
  std::set<std::string> unique;
  for (const auto& lookup : lookups.lookups()) {
    if (lookup.error != container::ResolveError::none) return;
    unique.insert(lookup.path);
  }
  const std::vector<std::string> names(unique.begin(), unique.end());
  HashParts content;
  std::vector<Companion> companions;
  if (!companions_of(names, resolver, content, companions) || !settled(companions)) return;
  const Hash128 key = key_of("content", asset_key_, content);
  std::string listed;
  for (const std::string& name : names) append_text(listed, name);
  const std::array<ResultStore::Value, 3> values{
      {{key, std::string(result)}, {asset_key_, listed}, {path_key_, snapshot(companions, key)}}};
  store_.add(values);
}

}  // namespace gltfx
