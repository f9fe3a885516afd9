// SPDX-License-Identifier: Apache-2.0
#include "schema/compile.hpp"
#include "schema/embedded.hpp"
#include "schema/image.hpp"

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
  static const std::vector<SourceFile> files = read_embedded();
  return files;
}

const std::shared_ptr<const Set>& builtin_set() {
  // Not destroyed, which would take longer than some runs have.
  static const auto& set = *new const auto([] {  // NOLINT(cppcoreguidelines-owning-memory)
    auto ready = read_image(embedded_image(), embedded_texts());
    return ready ? ready : compile(builtin_files()).set;
  }());
  return set;
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
