// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "read_input.hpp"
#include "schema/compile.hpp"
#include "schema_print.hpp"
#include "schema_tests.hpp"
#include "schema_words.hpp"
#include "suggestion.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

std::string unknown_name(const schema::Set& set, const std::string& name) {
  std::vector<std::string_view> names = core_type_names(set);
  for (const schema::Extension& extension : set.extensions()) names.push_back(extension.name);
  return fmt::format("schema: {} is unknown.{} 'gltfx schema' lists all names.",
                     gltfx::quoted(name), suggestion(name, names));
}

ExitCode print_schema(const schema::Set& set, const SchemaRequest& request) {
  const bool as_json = request.format == TableFormat::json;
  const Style style(colors_on_stdout(request.common.color));
  if (request.name.empty()) {
    return print(as_json ? schema_list_json(set, request.statuses)
                         : schema_list_text(set, request.statuses, style));
  }
  const schema::ExtensionId extension = set.find_extension(request.name);
  if (extension != schema::kNone) {
    return print(as_json ? extension_json(set, extension) : extension_text(set, extension, style));
  }
  const schema::TypeId type = set.find_type(request.name);
  if (type != schema::kNone) {
    return print(as_json ? type_json(set, type) : type_text(set, type, style));
  }
  complain(unknown_name(set, request.name));
  return ExitCode::usage;
}

}  // namespace

ExitCode run(const SchemaRequest& request) {
  if (!request.new_name.empty()) return print(new_schema(request.new_name));
  if (!request.check_files.empty() || !request.test_files.empty()) return check_schemas(request);
  const auto user_set = load_schemas(request.schema_files, request.schema_folders);
  if (!user_set) {
    complain(user_set.error().message);
    return ExitCode::usage;
  }
  return print_schema(*user_set ? **user_set : *schema::builtin_set(), request);
}

}  // namespace gltfx::tool
