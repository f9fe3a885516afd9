// SPDX-License-Identifier: Apache-2.0
#include "pipeline/bake_guard.hpp"

#include <filesystem>
#include <new>
#include <utility>

namespace gltfx {

BakeReport unreadable(const std::string& path, std::string why) {
  BakeReport report;
  report.path = path;
  report.validation.path = path;
  report.problem = BakeProblem::unreadable;
  report.error = std::move(why);
  return report;
}

BakeReport guarded(const std::string& path, const std::function<BakeReport()>& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return unreadable(path, "there is not enough memory to draw this file");
  } catch (const std::filesystem::filesystem_error&) {
    return unreadable(path, "the path cannot be looked up");
  }
}

}  // namespace gltfx
