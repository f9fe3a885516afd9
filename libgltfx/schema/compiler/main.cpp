// SPDX-License-Identifier: Apache-2.0
// Build step: compiles all schema files, so that a mistake in one fails the build with its place,
// and writes the C++ file that embeds their texts.
//
//   gltfx_schema_compiler OUT.cpp ROOT FILE...      FILE relative to ROOT
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "schema/compile.hpp"
#include "schema/compiler/embed.hpp"
#include "schema/image.hpp"

namespace {

bool read_file(const std::string& path, std::string& text) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return false;
  text.assign(std::istreambuf_iterator<char>(file), {});
  return true;
}

bool write_file(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  return static_cast<bool>(file.flush());
}

// The vocabulary's own schema is embedded but describes no object of an asset.
bool is_meta(const std::string& name) { return name.rfind("meta/", 0) == 0; }

int fail(const std::string& message) {
  std::fprintf(stderr, "%s\n", message.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace gltfx::schema;
  if (argc < 4) return fail("usage: gltfx_schema_compiler OUT.cpp ROOT FILE...");
  const std::string root = argv[2];
  std::vector<SourceFile> files;
  for (int i = 3; i < argc; ++i) {
    SourceFile file{argv[i], {}, false};
    if (!read_file(root + "/" + file.name, file.text))
      return fail(root + "/" + file.name + ": cannot be read");
    files.push_back(std::move(file));
  }
  std::vector<SourceFile> described;
  for (const SourceFile& file : files) {
    if (!is_meta(file.name)) described.push_back({root + "/" + file.name, file.text, false});
  }
  const Compiled compiled = compile(described);
  for (const SchemaFault& fault : compiled.faults)
    std::fprintf(stderr, "%s\n", fault.text().c_str());
  if (!compiled.set)
    return fail("the schema files have " + std::to_string(compiled.faults.size()) + " faults");
  const std::string out = embed(files, write_image(*compiled.set));
  return write_file(argv[1], out) ? 0 : fail(std::string(argv[1]) + ": cannot be written");
}
