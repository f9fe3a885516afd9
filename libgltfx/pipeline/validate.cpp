// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>
#include <gltfx/result_cache.hpp>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "codec/chance.hpp"
#include "container/container.hpp"
#include "pipeline/in_order.hpp"
#include "pipeline/kept_result.hpp"
#include "pipeline/proposed_fix.hpp"
#include "pipeline/resolver_for.hpp"
#include "pipeline/validation_key.hpp"
#include "report/packed.hpp"
#include "validate/validator.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;

// The library does not throw: memory that cannot be had is one more reason why a file is
// unreadable.
template <class Work>
FileReport without_throwing(const std::string& name, const ValidateOptions& options,
                            const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return validate::unreadable(name, "There is not enough memory to check the file.", options);
  } catch (const fs::filesystem_error&) {
    return validate::unreadable(name, "The path cannot be looked up.", options);
  }
}

template <class Work>
FileReport guarded(const std::string& name, const ValidateOptions& options, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  FileReport report = without_throwing(name, options, work);
  const auto time = std::chrono::steady_clock::now() - start;
  report.microseconds = static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::microseconds>(time).count());
  return report;
}

FileReport validate_opened(const container::Container& opened, const std::string& name,
                           const container::Resolver& resolver, const ValidateOptions& options) {
  FileReport report = validate::validate(opened, name, resolver, options);
  if (options.propose_fixes) propose_fix(report, opened, resolver, options);
  return report;
}

std::optional<FileReport> unpacked(const std::optional<std::string>& kept,
                                   const std::string& path) {
  if (!kept) return std::nullopt;
  auto report = report::unpack(*kept, rules());
  if (report) report->path = path;
  return report;
}

FileReport validate_or_recall(const std::string& path, const ValidateOptions& options) {
  KeptResult kept(path, *options.cache, validation_key(options, options.cache->folder()));
  if (auto report = unpacked(kept.as_it_was(), path)) return *std::move(report);
  const auto opened = container::open_file(path);
  if (!opened) return validate::unreadable(path, opened.error().message, options);
  const container::Resolver resolver = resolver_for(fs::path(path).parent_path(), options.root);
  if (auto report = unpacked(kept.by_content(*opened, resolver), path)) return *std::move(report);
  const auto lookups = std::make_shared<container::LookupLog>();
  container::Resolver recorded = resolver;
  recorded.record(lookups);
  // A report that a missing or interrupted decoder shaped may differ in the next run, even where
  // no finding says so.
  const std::uint64_t chances = codec::faults_by_chance();
  FileReport report = validate_opened(*opened, path, recorded, options);
  if (report.readable && codec::faults_by_chance() == chances) {
    kept.keep(report::pack(report), resolver, *lookups);
  }
  return report;
}

}  // namespace

FileReport validate_file(const std::string& path, const ValidateOptions& options) {
  return guarded(path, options, [&] {
    if (options.cache && !options.changed_lines) return validate_or_recall(path, options);
    const auto opened = container::open_file(path);
    if (!opened) return validate::unreadable(path, opened.error().message, options);
    const container::Resolver resolver = resolver_for(fs::path(path).parent_path(), options.root);
    return validate_opened(*opened, path, resolver, options);
  });
}

FileReport validate_bytes(std::string bytes, const std::string& name,
                          const ValidateOptions& options) {
  return guarded(name, options, [&] {
    const container::Container opened =
        container::open_bytes(container::Bytes::from_string(std::move(bytes)), name);
    const container::Resolver resolver =
        options.root.empty() ? container::Resolver() : resolver_for(options.root, options.root);
    return validate_opened(opened, name, resolver, options);
  });
}

void validate_files(std::span<const ValidateInput> inputs, unsigned jobs,
                    const std::function<void(FileReport&&)>& consume) {
  report_in_order<FileReport>(
      inputs.size(), jobs,
      [inputs](std::size_t i) { return validate_file(inputs[i].path, *inputs[i].options); },
      consume);
}

void validate_files(const std::vector<std::string>& paths, const ValidateOptions& options,
                    unsigned jobs, const std::function<void(FileReport&&)>& consume) {
  // Many files keep all threads busy by themselves.
  const unsigned each = paths.size() == 1 ? jobs : 1;
  report_in_order<FileReport>(
      paths.size(), jobs,
      [&](std::size_t i) {
        return guarded(paths[i], options, [&] {
          ValidateOptions own = options;
          own.jobs = each;
          return validate_file(paths[i], own);
        });
      },
      consume);
}

}  // namespace gltfx
