// SPDX-License-Identifier: Apache-2.0
#include "schema/compile.hpp"
#include "schema/embedded.hpp"
#include "schema/image.hpp"

namespace gltfx::schema {
namespace {

std::vector<SourceFile> read_embedded() {
  std::vector<SourceFile> files;
  for (const EmbeddedFile& embedded : embedded_files()) {
    SourceFile file{std::string(embedded.name), {}, false};
    for (const std::string_view piece : embedded.text) file.text += piece;
    files.push_back(std::move(file));
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
    auto ready = read_image(embedded_image());
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
