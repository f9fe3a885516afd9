// SPDX-License-Identifier: Apache-2.0
/// @file
/// The verbs of the command line as functions.
#pragma once

#include <gltfx/bake.hpp>
#include <gltfx/convert.hpp>
#include <gltfx/decoders.hpp>
#include <gltfx/deletion.hpp>
#include <gltfx/edited_bytes.hpp>
#include <gltfx/fix.hpp>
#include <gltfx/inspect.hpp>
#include <gltfx/memory_asset.hpp>
#include <gltfx/page.hpp>
#include <gltfx/report.hpp>
#include <gltfx/upgrade.hpp>
#include <gltfx/validate.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

/// Validates the file at `path`, and its external assets. Never throws; a file that cannot be read
/// gives a report with `readable == false` and one IO_ERROR. Safe to call from several threads.
FileReport validate_file(const std::string& path, const ValidateOptions& options = {});

/// Validates bytes, such as standard input. The report uses `name`. External resources are
/// looked up only when `options.root` names a folder.
FileReport validate_bytes(std::string bytes, const std::string& name,
                          const ValidateOptions& options = {});

/// Validates an asset in memory, with its resources.
FileReport validate_bytes(MemoryAsset asset, const ValidateOptions& options = {});

/// What the examples of own rules show.
struct OwnRuleTests {
  std::size_t examples = 0;           ///< that were validated
  std::vector<std::string> failures;  ///< bad ones that are not reported, good ones that are
  std::vector<std::string> notes;     ///< errors of other rules in examples
};

/// Validates the bad and the good example of each page. `rules` may be null.
OwnRuleTests test_own_rules(const std::shared_ptr<const OwnRules>& rules);

/// The examples of a rule. Those of a limit on a measure are the same asset, with a limit that it
/// breaks and one that it keeps.
enum class Example : std::uint8_t { bad, good, fixed };

/// The findings on an example of a rule, in the strict profile: the bad one raises the rule, the
/// others nothing. `own`: those of its page.
FileReport validate_example(const RuleDescription& rule, Example which,
                            const std::shared_ptr<const OwnRules>& own = nullptr);

/// Validates many files on `jobs` threads (at least 1) and hands over the reports in the order of
/// `paths`, one at a time. Memory does not grow with the number of files.
void validate_files(const std::vector<std::string>& paths, const ValidateOptions& options,
                    unsigned jobs, const std::function<void(FileReport&&)>& consume);

/// A file and its options, which must outlive the call.
struct ValidateInput {
  std::string path;                          ///< of the file
  const ValidateOptions* options = nullptr;  ///< never null in a call
};

/// The same for files with different options.
void validate_files(std::span<const ValidateInput> inputs, unsigned jobs,
                    const std::function<void(FileReport&&)>& consume);

/// Upgrades the legacy extensions of the file at `path` to their successors, as the options say. A
/// file is changed whole or not at all, only after the new bytes were validated, and never when
/// there is nothing to do. Never throws. Safe to call from several threads for different files.
UpgradeReport upgrade_file(const std::string& path, const UpgradeOptions& options = {});

/// The same for an asset in memory: no file is read or written, and options that name one are
/// refused. `read` and `files` of the asset give its resources, always the same bytes; a file in
/// neither is missing.
EditedBytes<UpgradeReport> upgrade_bytes(MemoryAsset asset, const UpgradeOptions& options = {});

/// Upgrades many files on `jobs` threads (at least 1) and hands over the reports in the order of
/// `inputs`, one at a time.
void upgrade_files(const std::vector<EditInput>& inputs, const UpgradeOptions& options,
                   unsigned jobs, const std::function<void(UpgradeReport&&)>& consume);

/// Fixes the findings of `gltfx validate` in the file at `path` that have a fix which the options
/// allow. Fixes run until nothing is left to do; a fix that causes a new finding is left out and
/// named. A file is changed whole or not at all, only after the new bytes were validated. Buffers
/// that change are written before the file that refers to them. Never throws. Safe to call from
/// several threads for different files.
FixReport fix_file(const std::string& path, const FixOptions& options = {});

/// The same for an asset in memory, as upgrade_bytes(). Other assets that read the same files are
/// not checked. Misspelt names of files are searched for among `files`.
EditedBytes<FixReport> fix_bytes(MemoryAsset asset, const FixOptions& options = {});

/// Fixes many files on `jobs` threads (at least 1) and hands over the reports in the order of
/// `inputs`, one at a time.
void fix_files(const std::vector<EditInput>& inputs, const FixOptions& options, unsigned jobs,
               const std::function<void(FixReport&&)>& consume);

/// The bytes of an example of a rule after that rule's fix alone, as they would be written.
std::string fix_example(const RuleDescription& rule, std::string_view example);

/// Deletes the values that the options name from the asset at `path`: every index and JSON pointer
/// to an object after a deleted one is renumbered. A file is changed whole or not at all, only
/// after the new bytes were validated. Never throws. Safe to call from several threads for
/// different files.
DeleteReport delete_objects(const std::string& path, const DeleteOptions& options);

/// The same for an asset in memory, as upgrade_bytes().
EditedBytes<DeleteReport> delete_objects_in_bytes(MemoryAsset asset, const DeleteOptions& options);

/// The same for many files on `jobs` threads (at least 1), which hands over the reports in the
/// order of `inputs`, one at a time.
void delete_objects_in_files(const std::vector<EditInput>& inputs, const DeleteOptions& options,
                             unsigned jobs, const std::function<void(DeleteReport&&)>& consume);

/// Stores the asset at `path` in another way, step by step as the options ask for it. A file is
/// changed whole or not at all, only after the new bytes were validated. Never throws. Safe to call
/// from several threads for different files.
ConvertReport convert_file(const std::string& path, const ConvertOptions& options = {});

/// The same for an asset in memory, as upgrade_bytes().
EditedBytes<ConvertReport> convert_bytes(MemoryAsset asset, const ConvertOptions& options = {});

/// The same for many files on `jobs` threads (at least 1), which hands over the reports in the
/// order of `inputs`, one at a time.
void convert_files(const std::vector<EditInput>& inputs, const ConvertOptions& options,
                   unsigned jobs, const std::function<void(ConvertReport&&)>& consume);

/// Draws the file at `path` and writes pictures as the options say. Never throws; files are written
/// whole or not at all. Safe to call from several threads for different files.
BakeReport bake_file(const std::string& path, const BakeOptions& options = {});

/// Draws an asset in memory, as upgrade_bytes(). The only file that is read is an environment.
BakedBytes bake_bytes(MemoryAsset asset, const BakeOptions& options = {});

/// A file and where its picture goes; `output` as in BakeOptions.
struct BakeInput {
  std::string path, output;  ///< of the asset and the picture
};

/// Draws many files one after the other, each on all threads, and hands over the reports in the
/// order of `inputs`. `sheet`: path of a contact sheet; empty: none. Returns the problem with the
/// sheet, or an empty text.
std::string bake_files(const std::vector<BakeInput>& inputs, const BakeOptions& options,
                       const std::string& sheet, const std::function<void(BakeReport&&)>& consume);

/// Draws two files in the same way, the second with the camera of the first, and compares the
/// pictures. `options.output` gets the picture of the difference; it has 8 bits for each channel,
/// so OpenEXR is refused.
BakeComparison bake_comparison(const std::string& first, const std::string& second,
                               const BakeOptions& options = {});

/// The contents of the file at `path`, valid or not. Never throws; nothing is written. Safe to call
/// from several threads.
InspectReport inspect_file(const std::string& path, const InspectOptions& options = {});

/// The contents of an asset in memory, as upgrade_bytes().
InspectReport inspect_bytes(MemoryAsset asset, const InspectOptions& options = {});

/// The same for many files on `jobs` threads (at least 1); hands over the reports in the order of
/// `paths`, one at a time.
void inspect_files(const std::vector<std::string>& paths, const InspectOptions& options,
                   unsigned jobs, const std::function<void(InspectReport&&)>& consume);

/// Thumbnails on the page of PageWriter.
struct ThumbnailOptions {
  bool draw = true;          ///< each asset, and its upgraded version
  std::uint32_t size = 160;  ///< pixels per side
  /// Quality of each picture; none: 16 samples and 4 bounces.
  std::optional<BakeQuality> quality;
};

/// Validates, inspects and draws many files on `jobs` threads (at least 1) and hands over the data
/// of the page in the order of `inputs`, one at a time. Memory does not grow with their number.
/// Nothing is written.
void report_files(std::span<const ValidateInput> inputs, const ThumbnailOptions& thumbnails,
                  unsigned jobs, const std::function<void(PageAsset&&)>& consume);

}  // namespace gltfx
