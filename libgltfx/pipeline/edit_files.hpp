// SPDX-License-Identifier: Apache-2.0
/// Verbs that change assets in files, each asset on its own.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <new>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/edit_asset.hpp"
#include "pipeline/in_order.hpp"
#include "pipeline/open_asset.hpp"

namespace gltfx {

/// The report on the asset at `path` as `work(report)` completes it. Does not throw: if memory runs
/// out or the path cannot be looked up, the report is only about that. `verb`: "upgrade".
template <class Report, class Work>
Report guarded(const std::string& path, std::string_view verb, const Work& work) {
  std::string why;
  try {
    Report report;
    report.path = path;
    work(report);
    return report;
  } catch (const std::bad_alloc&) {
    why.append("there is not enough memory to ").append(verb).append(" this file");
  } catch (const std::filesystem::filesystem_error&) {
    why = "the path cannot be looked up";
  }
  Report report;
  report.path = path;
  note_failure(report, EditProblem::unreadable, std::move(why));
  return report;
}

/// The report of `edit(opened, report)` on the asset at `path`. Does not throw.
template <class Report, class Edit>
Report edit_file(const std::string& path, const EditOptions& options, std::string_view verb,
                 const Edit& edit) {
  return guarded<Report>(path, verb, [&](Report& report) {
    auto opened = open_to_edit(path, AssetBounds::of(options));
    if (opened) {
      edit(*std::move(opened), report);
    } else {
      note_failure(report, EditProblem::unreadable, opened.error().message);
    }
  });
}

/// EditOptions::outputs of a run.
inline std::shared_ptr<const std::set<std::string>> outputs_of(
    const std::vector<EditInput>& inputs) {
  auto outputs = std::make_shared<std::set<std::string>>();
  for (const EditInput& input : inputs) {
    outputs->insert(std::filesystem::path(input.output).lexically_normal().native());
  }
  return outputs;
}

/// Calls `edit(path, options, folders)` for each input, on up to `jobs` threads, and `consume` in
/// the order of the inputs, one call at a time.
template <class Report, class Options, class Edit>
void edit_files(const std::vector<EditInput>& inputs, const Options& options, unsigned jobs,
                const Edit& edit, const std::function<void(Report&&)>& consume) {
  FolderIndex folders;
  const auto outputs = outputs_of(inputs);
  report_in_order<Report>(
      inputs.size(), jobs,
      [&](std::size_t i) {
        Options each = options;
        each.output = inputs[i].output;
        each.outputs = outputs;
        // Many files keep all threads busy by themselves.
        if constexpr (requires { each.jobs; }) each.jobs = inputs.size() == 1 ? jobs : 1;
        return edit(inputs[i].path, each, folders);
      },
      consume);
}

}  // namespace gltfx
