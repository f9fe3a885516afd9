// SPDX-License-Identifier: Apache-2.0
// Build step: compiles all schema files, so that a mistake in one fails the build with its place,
// and writes the C++ file that embeds their texts, and the table of material parameters.
//
//   gltfx_schema_compiler OUT.cpp TABLE.hpp ROOT FILE...      FILE relative to ROOT
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "schema/compile.hpp"
#include "schema/compiler/embed.hpp"
#include "schema/stored_set.hpp"

namespace {

using gltfx::schema::Compiled;
using gltfx::schema::SchemaError;
using gltfx::schema::SourceFile;

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

int fail(const std::string& message) {
  std::fprintf(stderr, "%s\n", message.c_str());
  return 1;
}

// Whether the files are free of mistakes; prints each mistake with its place.
bool are_right(const std::vector<SourceFile>& files) {
  const Compiled compiled = gltfx::schema::compile(files);
  for (const SchemaError& error : compiled.errors) {
    std::fprintf(stderr, "%s\n", error.text().c_str());
  }
  return compiled.set != nullptr;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) return fail("usage: gltfx_schema_compiler OUT.cpp TABLE.hpp ROOT FILE...");
  const std::string root = std::string(argv[3]) + "/";
  std::vector<SourceFile> files;
  for (int i = 4; i < argc; ++i) {
    SourceFile file{root + argv[i], {}, false};
    if (!read_file(file.name, file.text)) return fail(file.name + ": cannot be read");
    files.push_back(std::move(file));
  }
  if (!are_right(files)) return fail("schema/ has mistakes: see above");
  for (SourceFile& file : files) {
    file.name.erase(0, root.size());
    file.text = gltfx::schema::minified(file.text);
  }
  const Compiled compiled = gltfx::schema::compile(files);
  std::vector<std::string_view> texts;
  for (const SourceFile& file : files) texts.emplace_back(file.text);
  const std::string out =
      gltfx::schema::embed(files, gltfx::schema::write_set(*compiled.set, texts));
  if (!write_file(argv[1], out)) return fail(std::string(argv[1]) + ": cannot be written");
  // An unchanged header is not written, so that nothing is rebuilt.
  const std::string table = gltfx::schema::material_table(*compiled.set);
  std::string before;
  if (read_file(argv[2], before) && before == table) return 0;
  return write_file(argv[2], table) ? 0 : fail(std::string(argv[2]) + ": cannot be written");
}
