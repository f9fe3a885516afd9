// SPDX-License-Identifier: Apache-2.0
#include "rules/shared_reports.hpp"

#include <filesystem>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "report/packed.hpp"
#include "rules/validation_key.hpp"

namespace gltfx::validate {
namespace {

using container::LookupLog;

constexpr std::size_t kMostBytes = std::size_t{64} << 20U, kBytesOfEntry = 256;

std::string folder_of_name(const std::string& name) { return name.substr(0, name.rfind('/') + 1); }

/// Parts in a row, whole: a hash of names that others chose could be that of other names.
class ChildKey {
 public:
  void add(std::uint64_t number) { text_ += fmt::format("{};", number); }
  void add(std::string_view text) {
    add(std::uint64_t{text.size()});
    text_ += text;
  }
  void add(const FileIdentity& identity) {
    add(identity.device);
    add(identity.inode);
    add(identity.path);
  }
  void add(const ExternalLinks& links) {
    add(std::uint64_t{links.links.size()});
    for (const ExternalLink& link : links.links) {
      add(std::uint64_t{link.index});
      add(std::uint64_t{link.file});
      add(link.name);
      add(link.errors);
      add(link.not_opened);
      add(link.closed_circle);
    }
    add(std::uint64_t{links.unused_aliases.size()});
    for (const auto& [file, alias] : links.unused_aliases) {
      add(std::uint64_t{file});
      add(std::uint64_t{alias});
    }
  }
  void add(const std::optional<std::vector<LineRange>>& lines) {
    add(lines ? lines->size() + std::uint64_t{1} : std::uint64_t{0});
    for (const LineRange& range : lines.value_or(std::vector<LineRange>())) {
      add(range.first);
      add(range.last);
    }
  }
  std::string finish() { return std::move(text_); }

 private:
  std::string text_;
};

// All that a report on an external asset depends on, while no file changes. References of the asset
// lead from its own path, inside the root of the named asset.
std::string key_of_child(const ValidateOptions& options, const SharedChild& child) {
  const model::OpenedAsset& opened = child.asset.asset();
  const std::string& name = opened.name();
  const container::Resolver& resolver = opened.resolver();
  const Hash128 chosen = validation_key(options, {});
  ChildKey key;
  key.add(chosen.low);
  key.add(chosen.high);
  key.add(options.changed_lines);
  key.add(std::filesystem::path(name).lexically_normal().native());
  key.add(resolver.origin().device);
  key.add(resolver.origin().file);
  key.add(child.asset.identity());
  key.add(child.asset.aliases());
  key.add(static_cast<std::uint64_t>(opened.container().format));
  key.add(child.links);
  // Own rules see the path; look-ups are recorded from the folder of the named asset on.
  if (options.own_rules || options.products) key.add(name);
  if (resolver.log()) key.add(folder_of_name(child.named.name()));
  return key.finish();
}

}  // namespace

std::optional<SharedReports::Kept> SharedReports::find(const std::string& key) {
  std::unique_lock lock(mutex_);
  for (;;) {
    const auto [entry, is_new] = entries_.try_emplace(key);
    if (entry->second.kept) return entry->second.kept;
    if (!entry->second.is_made) {
      entry->second.is_made = true;
      return std::nullopt;
    }
    made_.wait(lock);
  }
}

void SharedReports::keep(const std::string& key, Kept kept) {
  std::size_t size = kBytesOfEntry + key.size() + kept.report.size();
  for (const auto& each : kept.look_ups) size += sizeof(each) + each.path.size();
  const std::lock_guard lock(mutex_);
  if (size > kMostBytes - bytes_) {
    entries_.erase(key);
  } else {
    bytes_ += size;
    entries_[key] = {false, std::move(kept)};
  }
  made_.notify_all();
}

void SharedReports::give_up(const std::string& key) {
  const std::lock_guard lock(mutex_);
  entries_.erase(key);
  made_.notify_all();
}

/// Lets other calls go on without the report, unless it is kept.
class SharedReports::Making {
 public:
  Making(SharedReports& shared, std::string key) : shared_(shared), key_(std::move(key)) {}
  ~Making() {
    if (!kept_) shared_.give_up(key_);
  }
  Making(const Making&) = delete;
  Making& operator=(const Making&) = delete;
  void keep(Kept kept) {
    shared_.keep(key_, std::move(kept));
    kept_ = true;
  }

 private:
  SharedReports& shared_;
  std::string key_;
  bool kept_ = false;
};

FileReport SharedReports::get(const ValidateOptions& options, const SharedChild& child,
                              const std::function<FileReport()>& make) {
  const model::OpenedAsset& opened = child.asset.asset();
  // In the child of a fork(), threads that make reports do not exist.
  const bool is_usable = generation_ == fork_generation();
  if (!is_usable || !opened.resolver().looks_on_disk()) return make();
  const std::string key = key_of_child(options, child);
  const auto& log = opened.resolver().log();
  if (const auto kept = find(key)) {
    auto report = report::unpack(kept->report, rules(options.own_rules.get()));
    if (!report) return make();
    if (log) {
      for (const LookupLog::Lookup& each : kept->look_ups) log->add(each);
    }
    report->path = opened.name();
    return *std::move(report);
  }
  Making making(*this, key);
  const std::size_t before = log ? log->lookups().size() : 0;
  FileReport report = make();
  Kept kept{report::pack(report), {}};
  if (log) {
    kept.look_ups.assign(log->lookups().begin() + static_cast<std::ptrdiff_t>(before),
                         log->lookups().end());
  }
  making.keep(std::move(kept));
  return report;
}

}  // namespace gltfx::validate
