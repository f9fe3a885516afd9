// SPDX-License-Identifier: Apache-2.0
#include "prove/compare.hpp"

#include <new>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "pipeline/compare_opened.hpp"
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

}  // namespace

CompareReport compare_opened(std::string old_name, std::string new_name,
                             const CompareOptions& options, const OpenCompared& open_old,
                             const OpenCompared& open_new) {
  CompareReport report;
  report.old_path = std::move(old_name);
  report.new_path = std::move(new_name);
  report.level = CompareLevel::differs;
  try {
    const auto before = open_old();
    report.error = problem_of(before, report.old_path);
    if (!report.error.empty()) return report;
    const auto after = open_new();
    report.error = problem_of(after, report.new_path);
    if (!report.error.empty()) return report;
    const auto schemas = options.schemas ? options.schemas : schema::builtin_set();
    prove::compare_assets(*before, *after, *schemas, options, report);
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

CompareReport compare_bytes(MemoryAsset old_asset, MemoryAsset new_asset,
                            const CompareOptions& options) {
  const std::string old_name = old_asset.name;
  const std::string new_name = new_asset.name;
  return compare_opened(
      old_name, new_name, options, [&] { return open_memory(std::move(old_asset), options.root); },
      [&] { return open_memory(std::move(new_asset), options.root); });
}

}  // namespace gltfx
