// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "command_line_parts.hpp"

namespace gltfx::tool {
namespace {

OptionEntry entry_of(const CLI::Option& option) {
  OptionEntry entry;
  if (!option.get_snames().empty()) entry.short_name = "-" + option.get_snames().front();
  if (!option.get_lnames().empty()) entry.name = "--" + option.get_lnames().front();
  entry.text = option.get_description();
  entry.repeatable = option.get_items_expected_max() > 1;
  if (option.get_items_expected_max() > 0) entry.type = option.get_type_name();
  return entry;
}

CommandEntry entry_of(const CLI::App& app, std::string name) {
  CommandEntry entry{std::move(name), app.get_description(), {}, {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) {
      entry.positional = option->get_name();
      entry.positional_text = option->get_description();
    } else {
      entry.options.push_back(entry_of(*option));
    }
  }
  return entry;
}

}  // namespace

std::vector<CommandEntry> table_of(const CLI::App& program) {
  std::vector<CommandEntry> table{entry_of(program, {})};
  for (const CLI::App* verb : program.get_subcommands(nullptr)) {
    table.push_back(entry_of(*verb, verb->get_name()));
  }
  return table;
}

}  // namespace gltfx::tool
