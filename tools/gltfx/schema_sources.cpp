// SPDX-License-Identifier: Apache-2.0
#include "schema_sources.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include "base/directory.hpp"
#include "base/text.hpp"
#include "read_input.hpp"
#include "schema/compile.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;
using SetPointer = std::shared_ptr<const schema::Set>;

constexpr std::string_view kEnding = ".schema.json";

Result<std::vector<std::string>> schema_files_in(const std::string& folder) {
  std::vector<std::string> files;
  DirectoryReader directory(folder);
  while (const char* entry = directory.next()) {
    if (std::string_view(entry).ends_with(kEnding)) files.push_back(fs::path(folder) / entry);
  }
  if (directory.error()) {
    return Error{"--schema-dir: cannot list " + quoted(folder, 200) + ": " +
                 directory.error().message()};
  }
  if (files.empty()) {
    return Error{"--schema-dir: " + quoted(folder, 200) + " holds no file named *.schema.json"};
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string error_lines(const std::vector<schema::SchemaError>& errors) {
  std::string lines = "the schema files have mistakes";
  for (const schema::SchemaError& error : errors) lines += '\n' + printable(error.text());
  return lines;
}

}  // namespace

Result<SetPointer> load_schemas(const std::vector<std::string>& files,
                                const std::vector<std::string>& folders) {
  std::vector<std::string> names;
  for (const std::string& folder : folders) {
    const auto found = schema_files_in(folder);
    if (!found) return found.error();
    names.insert(names.end(), found->begin(), found->end());
  }
  names.insert(names.end(), files.begin(), files.end());
  if (names.empty()) return SetPointer();
  std::vector<schema::SourceFile> sources;
  for (const std::string& name : names) {
    auto text = read_text_file(name, schema::kLongestFile);
    if (!text) return text.error();
    sources.push_back({name, *std::move(text), true});
  }
  schema::Compiled compiled = schema::compile_with(sources);
  if (!compiled.errors.empty()) return Error{error_lines(compiled.errors)};
  return std::move(compiled.set);
}

}  // namespace gltfx::tool
