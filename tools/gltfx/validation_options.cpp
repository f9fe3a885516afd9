// SPDX-License-Identifier: Apache-2.0
#include "validation_options.hpp"

#include <gltfx/result_cache.hpp>

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/text.hpp"
#include "commands.hpp"
#include "git.hpp"
#include "input_paths.hpp"
#include "product_file.hpp"
#include "read_input.hpp"
#include "repository.hpp"

namespace gltfx::tool {

std::string_view profile_name(Profile profile) {
  switch (profile) {
    case Profile::standard:
      return "default";
    case Profile::khronos:
      return "khronos";
    case Profile::strict:
      break;
  }
  return "strict";
}

namespace {

namespace fs = std::filesystem;

// Whether git tracks files of a folder: a proposed change could then add its own.
bool is_tracked(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return false;
  if (repository_of(fs::absolute(folder, error)).empty()) return false;
  const auto files = Git(folder).run({"ls-files", "-z", "--cached", "--", "."});
  return files && files->code == 0 && !files->out.empty();
}

// Removes the line break that editors put after the last line.
std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return text;
}

// A user who can write the key can forge results.
bool can_be_written_by_others(const std::string& file) {
  using std::filesystem::perms;
  std::error_code error;
  const perms permissions = std::filesystem::status(file, error).permissions();
  return (permissions & (perms::group_write | perms::others_write)) != perms::none;
}

Result<std::string> shared_key(const CacheChoice& choice) {
  if (!choice.key_file.empty()) {
    auto text = read_text_file(choice.key_file, kLongestConfig);
    if (!text) return Error{"--cache-key: " + text.error().message};
    if (can_be_written_by_others(choice.key_file)) {
      return Error{"--cache-key: other users can write " + quoted(choice.key_file, 200) +
                   "; run 'chmod go-w' on it"};
    }
    std::string key = trimmed(*std::move(text));
    if (key.empty()) return Error{"--cache-key: " + quoted(choice.key_file, 200) + " is empty"};
    return key;
  }
  const char* const variable = std::getenv("GLTFX_CACHE_KEY");
  return variable == nullptr ? std::string() : trimmed(variable);
}

}  // namespace

Result<std::shared_ptr<ResultCache>> open_cache(const CacheChoice& choice, bool quiet) {
  if (choice.folder.empty()) return std::shared_ptr<ResultCache>();
  if (is_tracked(choice.folder)) {
    return Error{"--cache: git tracks files in " + quoted(choice.folder, 200) +
                 "; name a folder that only gltfx writes to, and list it in .gitignore"};
  }
  const auto key = shared_key(choice);
  if (!key) return key.error();
  std::string problem;
  auto cache = key->empty() ? ResultCache::open(choice.folder, problem)
                            : ResultCache::open(choice.folder, *key, problem);
  if (!cache) {
    const char* const help =
        key->empty() ? "; --cache-key FILE or GLTFX_CACHE_KEY gives another key" : "";
    return Error{"--cache: " + problem + help};
  }
  if (const std::size_t foreign = cache->foreign_files(); foreign > 0 && !quiet) {
    const bool one = foreign == 1;
    complain("note: --cache: " + std::to_string(foreign) + (one ? " file of " : " files of ") +
             quoted(choice.folder, 200) + (one ? " is" : " are") +
             " not used: sealed with another key, or written by another user");
  }
  return cache;
}

Result<ValidateOptions> validation_of(const ValidateRequest& request) {
  ValidateOptions options = request.validation;
  options.jobs = request.common.jobs;
  for (const FormatTarget& target : request.targets) {
    // Lines have the data of all formats.
    options.propose_fixes = options.propose_fixes || target.format == ReportFormat::sarif ||
                            target.format == ReportFormat::jsonl;
  }
  if (auto problem = check_root(options.root)) return *std::move(problem);
  auto schemas = load_schemas(request.schema_files, request.schema_folders);
  if (!schemas) return schemas.error();
  options.schemas = *std::move(schemas);
  if (!request.product.empty()) {
    auto products = read_products(request.product);
    if (!products) return Error{"--product: " + products.error().message};
    options.products = *std::move(products);
  }
  auto cache = open_cache(request.cache, request.quiet);
  if (!cache) return cache.error();
  options.cache = *std::move(cache);
  return options;
}

void note_useless_options(const ValidateRequest& request) {
  const auto& pixels = request.validation.pixels;
  if (!request.quiet && pixels && *pixels != pixel_level(request.validation)) {
    complain("note: --pixels has no effect with --profile khronos, which reads headers only");
  }
}

ExitCode verdict_on(const RunSummary& summary, const ReportRequest& request, bool recording) {
  ExitCode code = ExitCode::ok;
  if (request.fail_on && summary.counts.at_least(*request.fail_on) > 0 && !recording) {
    code = ExitCode::findings;
  }
  return summary.unreadable > 0 ? worse(code, ExitCode::unreadable) : code;
}

const ValidateOptions& OptionsByPath::of(const std::string& path) {
  if (!by_path_) return common_;
  const std::vector<std::size_t> kind = by_path_->kind_of(path);
  if (kind.empty()) return common_;
  const auto [entry, fresh] = differing_.try_emplace(kind, common_);
  if (fresh) by_path_->apply(kind, entry->second);
  return entry->second;
}

void OptionsByPath::set_jobs(unsigned jobs) {
  common_.jobs = jobs;
  differing_.clear();
}

void OptionsByPath::set_searched(std::shared_ptr<const SearchedFolders> searched) {
  common_.searched = std::move(searched);
  differing_.clear();
}

}  // namespace gltfx::tool
