// SPDX-License-Identifier: Apache-2.0
#include "base/fork.hpp"
#include "schema/compile.hpp"
#include "schema/embedded.hpp"
#include "schema/stored_set.hpp"

namespace gltfx::schema {
namespace {

std::vector<SourceFile> read_embedded() {
  std::vector<SourceFile> files;
  for (std::size_t i = 0; i < embedded_names().size(); ++i) {
    files.push_back({std::string(embedded_names()[i]), std::string(embedded_texts()[i]), false});
  }
  return files;
}

}  // namespace

const std::vector<SourceFile>& builtin_files() {
  static constinit MadeOnce<std::vector<SourceFile>> files;
  return files.get(read_embedded);
}

const std::shared_ptr<const Set>& builtin_set() {
  // Not destroyed, which would take longer than some runs.
  static constinit MadeOnce<std::shared_ptr<const Set>> set;
  return set.get([] {
    auto ready = read_set(embedded_set(), embedded_texts());
    return ready ? ready : compile(builtin_files()).set;
  });
}

Compiled compile_with(const std::vector<SourceFile>& extra) {
  std::vector<SourceFile> files = builtin_files();
  for (const SourceFile& file : extra) {
    files.push_back(file);
    files.back().from_user = true;
  }
  return compile(files);
}

}  // namespace gltfx::schema
