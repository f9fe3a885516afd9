// SPDX-License-Identifier: Apache-2.0
#include <gltfx/schema.hpp>

#include <new>
#include <utility>

#include "schema/compile.hpp"

namespace gltfx {

std::shared_ptr<const schema::Set> make_schema_set(const std::vector<SchemaSource>& sources,
                                                   std::vector<std::string>& problems) {
  try {
    std::vector<schema::SourceFile> files;
    for (const SchemaSource& source : sources) files.push_back({source.name, source.text, true});
    schema::Compiled compiled = schema::compile_with(files);
    for (const schema::SchemaError& error : compiled.errors) problems.push_back(error.text());
    return std::move(compiled.set);
  } catch (const std::bad_alloc&) {
    problems.emplace_back("there is not enough memory for the schemas");
    return nullptr;
  }
}

}  // namespace gltfx
