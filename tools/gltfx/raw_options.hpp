// SPDX-License-Identifier: Apache-2.0
/// The command line as CLI11 leaves it: words, not yet values.
#pragma once

#include <string>
#include <vector>

#include "options.hpp"

namespace gltfx::tool {

struct RawCommonOptions {
  std::string jobs;
  std::string color = "auto";
  bool unsandboxed_decoders = false;
};

/// Which inputs a run takes.
struct RawInputOptions {
  std::vector<std::string> paths;
  std::string files_from, shard;
  std::vector<std::string> exclude;
  bool allow_empty = false, no_ignore = false;
};

inline constexpr const char* kKeyWithoutCache =
    "--cache-key seals what --cache keeps; name the folder with --cache.";

/// How findings are listed.
struct ListingWords {
  std::string min_severity, group_by;
  bool statistics = false;
};

/// Empty words were not given.
struct RawValidateOptions {
  RawCommonOptions common;
  ConfigChoice configuration;
  RawInputOptions inputs;
  ListingWords listing;
  std::vector<std::string> formats, select, ignore, severities, schema_files, schema_folders;
  std::vector<std::string> targets, target_files;
  std::string fail_on, profile, lfs, max_issues, pixels, inline_suppressions;
  std::string max_texture_size, max_total_pixels, max_triangles, max_draw_calls, max_file_size;
  std::string root, cache, cache_key, baseline, write_baseline, diff_base;
  bool sarif_notes = false, timings = false, quiet = false;
  bool hook = false;  ///< the paths may be left out
};

struct RawPageOptions {
  RawValidateOptions validate;
  std::string output, title, thumbnail_size = "160", quality;
  bool no_thumbnails = false;
};

struct RawMergeOptions {
  RawCommonOptions common;
  ListingWords listing;
  std::vector<std::string> files, formats;
  std::string fail_on, output;
  bool sarif_notes = false, quiet = false;
};

/// Of the verbs that change assets.
struct RawEditOptions {
  RawCommonOptions common;
  ConfigChoice configuration;
  RawInputOptions inputs;
  std::vector<std::string> schema_files, schema_folders, only;
  std::string output, root, format = "text";
  bool diff = false, raw = false, check = false, in_place = false, backup = false, unsafe = false,
       restore = false, quiet = false;
  bool hook = false;  ///< as above
};

struct RawUpgradeOptions : RawEditOptions {
  std::vector<std::string> to, targets, target_files;
  std::string generation = "auto", ior = "0";
  bool strict = false, pack = false, prune = false, verify = false;
};

struct RawFixOptions : RawEditOptions {
  std::vector<std::string> skip;
  RawValidateOptions validate;  ///< which findings there are, and which of them fail
};

struct RawDeleteOptions : RawEditOptions {
  std::vector<std::string> pointers;
  bool cascade = false;
};

struct RawBakeOptions {
  RawCommonOptions common;
  ConfigChoice configuration;
  RawInputOptions inputs;
  std::vector<std::string> sizes, layers, schema_files, schema_folders;
  std::string output, format = "png", sheet, compare, root, cache, cache_key;
  std::string turntable = "0", quality, samples, bounces, seed = "0";
  std::string camera, projection, frame, interior, lights = "both", environment, exposure = "0";
  std::string scene, animation, time = "0", variant;
  std::string denoise = "on", noise = "0", time_budget = "0", shader = "conserving";
  bool transparent = false, embed = false, strict = false, quiet = false;
};

struct RawInspectOptions {
  RawCommonOptions common;
  ConfigChoice configuration;
  std::vector<std::string> paths, exclude, schema_files, schema_folders;
  std::string format = "text", top = "10", root;
  bool quiet = false, no_ignore = false, allow_empty = false;
};

struct RawExplainOptions {
  RawCommonOptions common;
  std::vector<std::string> codes;
};

struct RawRulesOptions {
  RawCommonOptions common;
  std::string format = "text";
};

struct RawTargetsOptions {
  RawCommonOptions common;
  std::vector<std::string> names, targets, target_files;
  std::string format = "text";
};

struct RawSchemaOptions {
  RawCommonOptions common;
  ConfigChoice configuration;
  std::vector<std::string> names, statuses, check_files, test_files, schema_files, schema_folders;
  std::string format = "text", new_name;
};

struct RawConfigOptions {
  RawCommonOptions common;
  ConfigChoice configuration;
  std::vector<std::string> words;  ///< a path, or "import" and a file
};

// Words into a request; the Error says which word is wrong.
Result<ValidateRequest> request_of(const RawValidateOptions& words);
/// `validate`: what the part of the words about validation came to.
Result<PageRequest> request_of(const RawPageOptions& words, ValidateRequest validate);
Result<MergeRequest> request_of(const RawMergeOptions& words);
Result<UpgradeRequest> request_of(const RawUpgradeOptions& words);
/// But for `validation`.
Result<FixRequest> request_of(const RawFixOptions& words);
Result<DeleteRequest> request_of(const RawDeleteOptions& words);
Result<BakeRequest> request_of(const RawBakeOptions& words);
Result<InspectRequest> request_of(const RawInspectOptions& words);
Result<ExplainRequest> request_of(const RawExplainOptions& words);
Result<RulesRequest> request_of(const RawRulesOptions& words);
Result<TargetsRequest> request_of(const RawTargetsOptions& words);
Result<SchemaRequest> request_of(const RawSchemaOptions& words);
Result<ConfigRequest> request_of(const RawConfigOptions& words);

}  // namespace gltfx::tool
