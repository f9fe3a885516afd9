// SPDX-License-Identifier: Apache-2.0
/// @file
/// The verdict on one asset, and the formats it can be written in.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

/// Findings by severity, repeats counted one by one.
struct Counts {
  std::uint64_t errors = 0, warnings = 0, infos = 0, hints = 0;  ///< of that severity
  void add(Severity severity, std::uint64_t count = 1);          ///< counts some more
  std::uint64_t at_least(Severity severity) const;  ///< findings of this severity or a higher one
  Counts& operator+=(const Counts& other);          ///< adds all of the other
};

/// One entry of the Khronos report's `info.resources`.
struct ResourceInfo {
  std::string pointer;                       ///< of the buffer or image (RFC 6901)
  std::string mime_type;                     ///< of an image; else "application/gltf-buffer"
  std::string storage;                       ///< "external", "data-uri", "glb", "buffer-view"
  std::string uri;                           ///< of a file beside the asset; else empty
  std::optional<std::uint64_t> byte_length;  ///< where the bytes were read
  /// What the headers of an image say.
  struct Image {
    std::uint32_t width = 0, height = 0, bits = 0;  ///< pixels, and bits a channel
    std::string format, primaries, transfer;        ///< as the Khronos report names them
  };
  std::optional<Image> image;  ///< of an image that was understood
};

/// Facts about an asset, as the Khronos report's `info` block has them.
struct AssetInfo {
  std::string version, min_version;      ///< "2.0"; the latter may be empty
  std::optional<std::string> generator;  ///< of `asset`
  std::vector<std::string> extensions_used, extensions_required;  ///< as they are declared
  std::vector<ResourceInfo> resources;                            ///< buffers, then images
  /// Numbers of objects; a primitive is a draw call.
  std::uint64_t animation_count = 0, material_count = 0, draw_call_count = 0;
  std::uint64_t total_vertex_count = 0, total_triangle_count = 0;     ///< of all primitives
  std::uint64_t max_uvs = 0, max_influences = 0, max_attributes = 0;  ///< of any primitive
  bool has_morph_targets = false, has_skins = false;                  ///< whether there are any
  bool has_textures = false, has_default_scene = false;               ///< the same
};

/// A finding that was folded into another one of the report: the same code at another place.
struct Repeat {
  std::size_t finding = 0;    ///< position of that one in FileReport::diagnostics
  std::string message, help;  ///< as in Diagnostic
  std::string pointer;        ///< the same
  std::string object_name;    ///< the same
  Location location;          ///< the same
  std::uint64_t count = 1;    ///< errors at that place
  std::shared_ptr<const CheckedLimit> requirement;  ///< as in Diagnostic
};

/// Whether a limit holds. `not_measured`: the measure could not be taken; `not_applicable`: there
/// is nothing to take it of.
enum class Verdict : std::uint8_t { pass, fail, not_measured, not_applicable };

/// "pass", "fail", "not-measured", "not-applicable".
std::string_view verdict_name(Verdict verdict);
/// The verdict with that name, or nothing.
std::optional<Verdict> verdict_from_name(std::string_view name);

/// One limit on the asset or on one of its elements, and the verdict.
struct Requirement : CheckedLimit {
  std::string pointer;                  ///< of the element (RFC 6901); empty: the asset
  std::string object_name;              ///< `name` of the element, may be empty
  Verdict verdict = Verdict::pass;      ///< on this value
  Severity severity = Severity::error;  ///< of the finding if the limit is not met
};

/// The report on one asset. Owns its text; independent of the asset.
struct FileReport {
  std::string path;                       ///< as the user named it, "-" for standard input
  std::uint64_t position = 0;             ///< among all named files, also those of other shards
  std::string mime_type;                  ///< "model/gltf+json", "model/gltf-binary" or empty
  bool readable = true;                   ///< false: the file itself could not be opened
  std::vector<Diagnostic> diagnostics;    ///< in the order they were found
  Counts counts;                          ///< of all diagnostics, those not listed included
  std::vector<Repeat> repeats;            ///< the first thousands of those folded, by `finding`
  bool truncated = false;                 ///< --max-issues ended the listing
  std::uint64_t suppressed = 0;           ///< findings in the baseline
  std::uint64_t left_out = 0;             ///< findings that the asset suppresses
  std::uint64_t unchanged = 0;            ///< findings on lines that were not requested
  std::uint64_t fixable = 0;              ///< findings with a safe fix, repeats counted
  std::uint64_t unverified = 0;           ///< resources that were not checked: Git LFS pointers
  std::uint64_t images_wanted = 0;        ///< images whose pixels rules need
  std::uint64_t images_decoded = 0;       ///< of those, the ones that were decoded
  std::uint64_t microseconds = 0;         ///< that the validation took
  std::optional<AssetInfo> info;          ///< where the JSON text could be read
  std::vector<Requirement> requirements;  ///< all limits that were checked, also those that are met
  std::uint64_t unlisted_requirements = 0;  ///< those that are not in the list: it is bounded
  /// On all external assets (glTF 2.1) below this one, each once; their own lists are empty.
  /// Writers get them as files of their own.
  std::vector<FileReport> external_assets;
};

/// Totals of a run.
struct RunSummary {
  std::uint64_t files = 0;                                     ///< reported
  std::uint64_t files_with_errors = 0;                         ///< those with at least one
  std::uint64_t unreadable = 0;                                ///< that could not be opened
  std::uint64_t unverified = 0, suppressed = 0, left_out = 0;  ///< sums of those of the files
  std::uint64_t images_wanted = 0, images_decoded = 0;         ///< the same
  std::uint64_t unchanged = 0, fixable = 0;                    ///< the same
  std::string fixable_path;  ///< of the file with such findings, if it is the only one; else empty
  Counts counts;             ///< the same
  std::optional<int> exit_code;        ///< exit code of the program, if known
  void add(const FileReport& report);  ///< adds one report
};

/// One of several runs that share the inputs among them.
struct Shard {
  std::uint32_t index = 1;  ///< from 1 to count
  std::uint32_t count = 1;  ///< of all runs
};

/// How a report is written.
enum class ReportFormat : std::uint8_t {
  text,
  json,
  jsonl,
  khronos,
  github,
  gitlab,
  sarif,
  junit,
  agent,
  csv
};

/// "text", "json" and so on.
std::string_view report_format_name(ReportFormat format);
/// The format with that name, or nothing.
std::optional<ReportFormat> report_format_from_name(std::string_view name);
/// All names, for help texts.
std::span<const std::string_view> report_format_names();

/// How the text format lists findings.
enum class TextLayout : std::uint8_t {
  findings,    ///< a block each, with the source
  by_rule,     ///< a block for each rule, with the first places
  statistics,  ///< numbers by rule and by file
};

/// Options of formats.
struct FormatOptions {
  bool color = false;                        ///< text: ANSI colours
  bool quiet = false;                        ///< text: findings only, no summary
  TextLayout layout = TextLayout::findings;  ///< text: how findings are listed
  /// Findings of a lower severity are counted, not listed.
  Severity min_severity = Severity::hint;
  std::string command;  ///< text: how the user calls the program, for help lines ("gltfx")
  std::string profile;  ///< named in json, jsonl, sarif, junit and agent
  /// The level of image checks; named there and in github, in text if any image was decoded.
  std::string pixel_level;
  /// All rules, sorted by code, for sarif and agent. Static storage.
  std::span<const RuleDescription> rules;
  /// sarif, gitlab: the absolute folder that relative paths start from; may be empty.
  std::string folder;
  /// gitlab: the absolute folder that paths in the report start from; empty: `folder`.
  std::string repository;
  Shard shard;  ///< named in jsonl
  /// junit: findings of this severity or a higher one are failures; named in jsonl; nothing: never.
  std::optional<Severity> fail_on = Severity::error;
  /// sarif: infos and hints as results, too; otherwise only those at or above `fail_on`.
  bool sarif_notes = false;
  /// junit, jsonl: FileReport::microseconds are written. Two runs over the same files differ then.
  bool timings = false;
};

/// Writes reports one after the other, so that memory does not grow with their number. Calls:
/// begin, file for each report in order, end. Each appends text to `out`, which the caller writes
/// and clears as it likes. Not thread-safe.
class ReportWriter {
 public:
  virtual ~ReportWriter() = default;
  virtual void begin(std::string& out) = 0;                           ///< before the first report
  virtual void file(const FileReport& report, std::string& out) = 0;  ///< each report
  virtual void end(const RunSummary& summary, std::string& out) = 0;  ///< after the last one
};

/// A writer of that format, never null.
std::unique_ptr<ReportWriter> make_report_writer(ReportFormat format, const FormatOptions& options);

/// The JSON Schema (2020-12) of `--format json`.
std::string_view json_report_schema();

}  // namespace gltfx
