// SPDX-License-Identifier: Apache-2.0
#include "pipeline/kept_report.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>

#include "pipeline/result_store.hpp"
#include "pipeline/validation_key.hpp"
#include "report/packed.hpp"

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
  const timespec until{time / kSecond, time % kSecond};
  while (::clock_nanosleep(CLOCK_REALTIME, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

// Findings that another machine, or a quieter one, would not have.
bool is_repeatable(const FileReport& report) {
  constexpr std::array<std::string_view, 3> kByChance{"IMAGE_NOT_DECODED", "IMAGE_PIXELS_INVALID",
                                                      "DRACO_DECODE_FAILED"};
  return report.readable && std::none_of(report.diagnostics.begin(), report.diagnostics.end(),
                                         [&](const Diagnostic& finding) {
                                           return std::find(kByChance.begin(), kByChance.end(),
                                                            finding.code) != kByChance.end();
                                         });
}

template <class T>
void append(std::string& out, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Takes values off the front of bytes; false when there are too few.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  bool take(T& value) {
    if (rest_.size() < sizeof value) return false;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    return true;
  }
  bool take_text(std::string_view& text) {
    std::uint64_t size = 0;
    if (!take(size) || size > rest_.size()) return false;
    text = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return true;
  }
  bool empty() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

void append_text(std::string& out, std::string_view text) {
  append(out, std::uint64_t{text.size()});
  out += text;
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

KeptReport::KeptReport(const std::string& path, const ValidateOptions& options)
    : path_(path),
      store_(options.cache->store()),
      options_key_(validation_key(options, options.cache->folder())),
      path_key_(path_key(path, options.cache->folder(), options_key_)) {}

std::optional<FileReport> KeptReport::report_of(const Hash128& key) const {
  const auto bytes = store_.find(key);
  if (!bytes) return std::nullopt;
  auto report = report::unpack(*bytes, rules());
  if (report) report->path = path_;
  return report;
}

std::optional<FileReport> KeptReport::as_it_was() {
  const auto state = file_state(path_);
  if (!state) return std::nullopt;
  state_ = *state;
  if (const auto bytes = store_.find(path_key_)) {
    Cursor cursor(*bytes);
    Hash128 report;
    FileState known;
    bool same = cursor.take(report) && cursor.take(known) && known == *state_;
    const fs::path folder = fs::path(path_).parent_path();
    while (same && !cursor.empty()) {
      std::string_view name;
      same = cursor.take_text(name) && cursor.take(known);
      const auto companion = same ? file_state(folder / name) : Result<FileState>(FileState());
      same = same && companion && *companion == known;
    }
    if (same) {
      if (auto kept = report_of(report)) return kept;
    }
  }
  if (now() < state_->status_change + kTick && now() >= state_->status_change) {
    wait_until(state_->status_change + kTick);
  }
  begin_ = now();
  return std::nullopt;
}

std::optional<FileReport> KeptReport::by_content(const container::Container& opened,
                                                 const container::Resolver& resolver) {
  HashParts asset;
  asset.add(fs::path(path_).filename().native());
  asset.add(hash_bytes(opened.bytes.text()));
  asset_key_ = key_of("asset", options_key_, asset);
  const auto bytes = store_.find(asset_key_);
  if (!bytes) return std::nullopt;
  std::vector<std::string> names;
  for (Cursor cursor(*bytes); !cursor.empty();) {
    std::string_view name;
    if (!cursor.take_text(name)) return std::nullopt;
    names.emplace_back(name);
  }
  HashParts content;
  std::vector<Companion> companions;
  if (!companions_of(names, resolver, content, companions)) return std::nullopt;
  const Hash128 key = key_of("content", asset_key_, content);
  auto report = report_of(key);
  if (report && settled(companions)) {
    const ResultStore::Value value{path_key_, snapshot(companions, key)};
    store_.add({&value, 1});
  }
  return report;
}

bool KeptReport::companions_of(const std::vector<std::string>& names,
                               const container::Resolver& resolver, HashParts& content,
                               std::vector<Companion>& companions) const {
  for (const std::string& name : names) {
    const container::Resolved file = resolver.open(name);
    if (file.fault != container::ResolveFault::none) return false;
    content.add(name);
    content.add(hash_bytes(file.bytes.text()));
    companions.push_back({name, file.state});
  }
  return true;
}

// Whether what was read is what lies there now: nothing was written while the report was made or so
// shortly before that the times need not show it.
bool KeptReport::settled(const std::vector<Companion>& companions) const {
  const auto state = file_state(path_);
  if (!state || !(*state == *state_)) return false;
  const auto old = [this](const FileState& file) { return file.status_change + kTick <= begin_; };
  return old(*state_) && std::all_of(companions.begin(), companions.end(),
                                     [&](const Companion& file) { return old(file.state); });
}

std::string KeptReport::snapshot(const std::vector<Companion>& companions,
                                 const Hash128& report) const {
  std::string bytes;
  append(bytes, report);
  append(bytes, *state_);
  for (const Companion& companion : companions) {
    append_text(bytes, companion.path);
    append(bytes, companion.state);
  }
  return bytes;
}

void KeptReport::keep(const FileReport& report, const container::Resolver& resolver,
                      const container::LookupLog& lookups) {
  if (!state_ || !is_repeatable(report)) return;
  std::set<std::string> unique;
  for (const auto& lookup : lookups.lookups()) {
    if (lookup.fault != container::ResolveFault::none) return;
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
      {{key, report::pack(report)}, {asset_key_, listed}, {path_key_, snapshot(companions, key)}}};
  store_.add(values);
}

}  // namespace gltfx
