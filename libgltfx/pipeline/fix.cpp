// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/edit_bytes.hpp"
#include "pipeline/edit_files.hpp"
#include "pipeline/fix_group.hpp"
#include "pipeline/in_order.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

constexpr std::string_view kNoMemory = "there is not enough memory to fix this file";

FixReport unfixed(const std::string& path, std::string_view why) {
  FixReport report;
  report.path = path;
  note_failure(report, EditProblem::unreadable, std::string(why));
  return report;
}

// The library does not throw.
std::vector<FixReport> guarded(const std::vector<EditInput>& assets, FixRun& run) {
  std::string_view why = kNoMemory;
  try {
    return fix_group(assets, run);
  } catch (const std::bad_alloc&) {
  } catch (const std::filesystem::filesystem_error&) {
    why = "the path cannot be looked up";
  }
  std::vector<FixReport> reports;
  for (const EditInput& asset : assets) reports.push_back(unfixed(asset.path, why));
  return reports;
}

FixRun run_with(const FixOptions& options, unsigned jobs) {
  return {options, options.schemas ? options.schemas : schema::builtin_set(), jobs, {}};
}

std::vector<InputGroup> groups_of_inputs(const std::vector<EditInput>& inputs,
                                         const FixOptions& options, unsigned jobs) {
  std::vector<std::string> paths;
  for (const EditInput& input : inputs) paths.push_back(input.path);
  return groups_of(paths, AssetBounds::of(options), jobs);
}

}  // namespace

std::uint64_t FixReport::fixed() const {
  std::uint64_t count = 0;
  for (const FixAction& action : actions) count += action.done ? action.count : 0;
  return count;
}

std::uint64_t FixReport::left() const {
  std::uint64_t count = 0;
  for (const FixAction& action : actions) count += action.done ? 0 : action.count;
  return count;
}

FixReport fix_file(const std::string& path, const FixOptions& options) {
  FixRun run = run_with(options, 1);
  return std::move(guarded({{path, options.output}}, run).front());
}

EditedBytes<FixReport> fix_bytes(MemoryAsset asset, const FixOptions& options) {
  return edit_bytes<FixReport>(std::move(asset), options,
                               [&](EditedAsset opened, FixReport& report) {
                                 FixRun run = run_with(options, 1);
                                 return fix_in_memory(std::move(opened), run, report);
                               });
}

void fix_files(const std::vector<EditInput>& inputs, const FixOptions& options, unsigned jobs,
               const std::function<void(FixReport&&)>& consume) {
  std::vector<InputGroup> groups;
  try {
    groups = groups_of_inputs(inputs, options, jobs);
  } catch (const std::bad_alloc&) {
    for (const EditInput& input : inputs) consume(unfixed(input.path, kNoMemory));
    return;
  }
  FixOptions of_run = options;
  of_run.outputs = outputs_of(inputs);
  FixRun run = run_with(of_run, jobs);
  std::vector<std::optional<FixReport>> reports(inputs.size());
  std::size_t group = 0, next = 0;
  report_in_order<std::vector<FixReport>>(
      groups.size(), jobs,
      [&](std::size_t i) {
        std::vector<EditInput> assets;
        for (const std::size_t position : groups[i]) assets.push_back(inputs[position]);
        return guarded(assets, run);
      },
      [&](std::vector<FixReport>&& of_group) {
        for (std::size_t i = 0; i < of_group.size(); ++i) {
          reports[groups[group][i]] = std::move(of_group[i]);
        }
        ++group;
        for (; next < reports.size() && reports[next]; ++next) {
          consume(*std::exchange(reports[next], std::nullopt));
        }
      });
}

}  // namespace gltfx
