// SPDX-License-Identifier: Apache-2.0
#include "prove/compare.hpp"

#include <new>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "pipeline/compare_opened.hpp"
#include "pipeline/compare_pictures.hpp"
#include "pipeline/open_asset.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

std::string problem_of(const Result<model::OpenedAsset>& opened, const std::string& name) {
  if (!opened) return fmt::format("{}: {}", printable(name), opened.error().message);
  if (const auto obstacle = find_obstacle(*opened)) {
    return fmt::format("{}: {}", printable(name), obstacle->message);
  }
  const json::Document& document = opened->document();
  if (!document.is_object(document.root())) {
    return fmt::format("{}: it is not a glTF asset; see 'gltfx validate'", printable(name));
  }
  if (model::is_gltf_1(document)) {
    return fmt::format("{}: it is glTF 1.0, which is not compared", printable(name));
  }
  return {};
}

using Asset = std::optional<model::OpenedAsset>;

// Opens the asset if there is one. An error of the report: it cannot be compared.
Asset opened(const std::string& name, const OpenCompared& open, CompareReport& report) {
  if (name.empty() || !report.error.empty()) return std::nullopt;
  auto asset = open();
  report.error = problem_of(asset, name);
  if (!report.error.empty()) return std::nullopt;
  return *std::move(asset);
}

}  // namespace

CompareReport compare_opened(std::string old_name, std::string new_name,
                             const CompareOptions& options, const OpenCompared& open_old,
                             const OpenCompared& open_new) {
  CompareReport report;
  report.old_path = std::move(old_name);
  report.new_path = std::move(new_name);
  report.level = CompareLevel::differs;
  try {
    const bool both = !report.old_path.empty() && !report.new_path.empty();
    if (!both && options.picture_size == 0) return report;
    Asset before = opened(report.old_path, open_old, report);
    Asset after = opened(report.new_path, open_new, report);
    if (!both) std::swap(report.picture_problem, report.error);
    if (!report.error.empty() || !report.picture_problem.empty()) return report;
    std::vector<prove::ChangedBoxes> boxes;
    if (both) {
      const auto schemas = options.schemas ? options.schemas : schema::builtin_set();
      boxes = prove::compare_assets(*before, *after, *schemas, options, report);
    }
    if (options.picture_size == 0 || report.level == CompareLevel::identical) return report;
    draw_compared(std::move(before), std::move(after), boxes, options, report);
  } catch (const std::bad_alloc&) {
    report.changes.clear();
    report.level = CompareLevel::differs;
    report.error = "there is not enough memory to compare the assets";
  }
  return report;
}

CompareReport compare_files(const std::string& old_path, const std::string& new_path,
                            const CompareOptions& options) {
  const AssetBounds bounds = AssetBounds::of(options);
  return compare_opened(
      old_path, new_path, options, [&] { return open_asset(old_path, bounds); },
      [&] { return open_asset(new_path, bounds); });
}

CompareReport compare_bytes(std::optional<MemoryAsset> old_asset,
                            std::optional<MemoryAsset> new_asset, const CompareOptions& options) {
  const auto name_of = [](const std::optional<MemoryAsset>& asset) {
    if (!asset) return std::string();
    return asset->name.empty() ? std::string("-") : asset->name;
  };
  const std::string old_name = name_of(old_asset);
  const std::string new_name = name_of(new_asset);
  return compare_opened(
      old_name, new_name, options, [&] { return open_memory(*std::move(old_asset), options.root); },
      [&] { return open_memory(*std::move(new_asset), options.root); });
}

}  // namespace gltfx
