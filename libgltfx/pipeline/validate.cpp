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

#include "container/container.hpp"
#include "pipeline/cached_verb.hpp"
#include "pipeline/in_order.hpp"
#include "pipeline/open_asset.hpp"
#include "pipeline/proposed_fix.hpp"
#include "pipeline/resolver_for.hpp"
#include "pipeline/validate_asset.hpp"
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

Validation with_report(validate::ValidatedAsset validated) {
  FileReport report = validated.take_report();
  return {std::move(report), validated.take_asset()};
}

/// Validation of one file, for cached().
struct ValidateVerb {
  using Report = Validation;
  const std::string& path;
  const ValidateOptions& options;

  Result<model::OpenedAsset> open() const { return open_asset(path, options.root); }
  Validation refuse(const std::string& why) const {
    return {validate::unreadable(path, why, options), std::nullopt};
  }
  Validation run(model::OpenedAsset asset) const {
    return with_report(validate_asset(std::move(asset), options));
  }
  static std::optional<std::string> pack(const Validation& validation) {
    if (!validation.report.readable) return std::nullopt;
    return report::pack(validation.report);
  }
  std::optional<Validation> unpack(const std::string& kept, model::OpenedAsset* asset) const {
    auto report = report::unpack(kept, rules());
    if (!report) return std::nullopt;
    report->path = path;
    Validation validation{*std::move(report), std::nullopt};
    if (asset != nullptr) validation.asset = std::move(*asset);
    return validation;
  }
};

Validation validate_or_recall(const std::string& path, const ValidateOptions& options) {
  const ValidateVerb verb{path, options};
  if (options.cache && !options.changed_lines) {
    return cached(path, *options.cache, validation_key(options, options.cache->folder()), verb);
  }
  auto opened = verb.open();
  return opened ? verb.run(*std::move(opened)) : verb.refuse(opened.error().message);
}

}  // namespace

validate::ValidatedAsset validate_asset(model::OpenedAsset asset, const ValidateOptions& options) {
  validate::ValidatedAsset validated(std::move(asset), options);
  if (options.propose_fixes) propose_fix(validated, options);
  return validated;
}

Validation validate_path(const std::string& path, const ValidateOptions& options) {
  Validation validation;
  validation.report = guarded(path, options, [&] {
    Validation made = validate_or_recall(path, options);
    validation.asset = std::move(made.asset);
    return std::move(made.report);
  });
  return validation;
}

FileReport validate_file(const std::string& path, const ValidateOptions& options) {
  return validate_path(path, options).report;
}

FileReport validate_bytes(std::string bytes, const std::string& name,
                          const ValidateOptions& options) {
  return guarded(name, options, [&] {
    container::Container opened =
        container::open_bytes(container::Bytes::from_string(std::move(bytes)), name);
    const container::Resolver resolver =
        options.root.empty() ? container::Resolver() : resolver_for(options.root, options.root);
    return validate_asset({name, std::move(opened), resolver}, options).take_report();
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
