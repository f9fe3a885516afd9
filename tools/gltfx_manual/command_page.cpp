// SPDX-License-Identifier: Apache-2.0
// gltfx(1) and gltfx-VERB(1).
#include <algorithm>

#include <fmt/format.h>

#include "exit_code.hpp"
#include "help_text.hpp"
#include "pages.hpp"
#include "roff.hpp"
#include "verb_texts.hpp"

namespace gltfx::tool {
namespace {

// "Check .gltf and .glb files" as the line behind a name.
std::string summary_of(const CommandEntry& command) {
  if (command.name.empty()) return "validate, upgrade and draw glTF 2.0 assets";
  std::string text = command.text;
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') {
    text[0] = static_cast<char>(text[0] - 'A' + 'a');
  }
  return text;
}

void add_synopsis(RoffPage& page, const CommandEntry& command, const VerbText& text) {
  page.section("SYNOPSIS");
  const bool options = !command.name.empty() && command.name != "hook";
  const std::string operands = roff_value(text.operands);
  page.line(fmt::format("\\fBgltfx{}{}\\fR{}{}{}", command.name.empty() ? "" : " ", command.name,
                        options ? " [\\fIOPTION\\fR]..." : "", operands.empty() ? "" : " ",
                        operands));
  if (!command.name.empty()) return;
  page.line(".br\n\\fBgltfx\\fR \\fB\\-\\-help\\fR | \\fB\\-\\-version\\fR");
}

std::string tag_of(const OptionEntry& option) {
  std::string tag;
  if (!option.short_name.empty()) {
    tag = roff_bold(option.short_name) + ", ";
  }
  tag.append(roff_bold(option.name));
  if (option.takes_value()) tag.append(" ").append(roff_value(option.type));
  return tag;
}

void add_options(RoffPage& page, const CommandEntry& command) {
  page.section("OPTIONS");
  if (!command.positional.empty()) {
    page.item(roff_value(command.positional), command.positional_text + ".");
  }
  for (const OptionEntry& option : command.options) {
    page.item(tag_of(option), option.text + ".", option.type);
  }
}

void add_verbs(RoffPage& page, const std::vector<CommandEntry>& table) {
  page.section("VERBS");
  for (const CommandEntry& each : table) {
    if (each.name.empty()) continue;
    page.item(roff_prose(page_of(each) + "(1)"), each.text + ".");
  }
}

void add_exit_codes(RoffPage& page) {
  page.section("EXIT STATUS");
  for (const ExitCodeEntry& entry : kExitCodes) {
    page.item(fmt::format("\\fB{}\\fR", static_cast<int>(entry.code)),
              fmt::format("{}.", entry.meaning));
  }
  page.prose("Where several apply, 4 stands before 2, 2 before 3 and 3 before 1.");
}

bool has_option(const CommandEntry& command, std::string_view name) {
  return std::any_of(command.options.begin(), command.options.end(),
                     [&](const OptionEntry& option) { return option.name == name; });
}

void add_environment(RoffPage& page, const CommandEntry& command) {
  const bool whole = command.name.empty();
  const bool decodes = whole || has_option(command, "--root");
  if (!decodes && !has_option(command, "--color")) return;
  page.section("ENVIRONMENT");
  page.item(roff_bold("NO_COLOR"), "When it is set and not empty, `--color auto` means never.");
  if (!decodes) return;
  page.item(roff_bold("GLTFX_CODEC_WORKERS"),
            "Folder of the programs that decode images and compressed geometry, in place of the "
            "one that they were installed to.");
}

void add_files(RoffPage& page, const CommandEntry& command) {
  if (!command.name.empty() && !has_option(command, "--config")) return;
  page.section("FILES");
  page.item("\\fIgltfx.toml\\fR",
            "Configuration: the nearest one of the working folder and those above it, see "
            "gltfx.toml(5).");
}

// Lines of two columns: a command and what it does.
void add_examples(RoffPage& page, std::string_view examples) {
  page.section("EXAMPLES");
  for (std::size_t at = examples.find('\n') + 1; at < examples.size();) {
    const std::size_t end = std::min(examples.find('\n', at), examples.size());
    std::string_view each = examples.substr(at, end - at);
    at = end + 1;
    each.remove_prefix(std::min(each.find_first_not_of(' '), each.size()));
    const std::size_t gap = std::min(each.find("  "), each.size());
    const std::size_t text = std::min(each.find_first_not_of(' ', gap), each.size());
    page.command(each.substr(0, gap), each.substr(text));
  }
}

void add_see_also(RoffPage& page, const std::vector<CommandEntry>& table,
                  const CommandEntry& command) {
  page.section("SEE ALSO");
  std::string names;
  for (const CommandEntry& each : table) {
    if (each.name != command.name) names.append(page_of(each)).append("(1), ");
  }
  page.prose(names + "gltfx.toml(5)");
}

}  // namespace

std::string page_of(const CommandEntry& command) {
  return command.name.empty() ? "gltfx" : fmt::format("gltfx-{}", command.name);
}

const OptionEntry* find_option(const std::vector<CommandEntry>& table, std::string_view verb,
                               std::string_view option) {
  for (const CommandEntry& command : table) {
    if (command.name != verb) continue;
    for (const OptionEntry& each : command.options) {
      if (each.name == option) return &each;
    }
  }
  return nullptr;
}

std::string command_page(const std::vector<CommandEntry>& table, const CommandEntry& command,
                         const Edition& edition) {
  const VerbText* text = find_verb_text(command.name);
  if (text == nullptr) return {};
  const std::string_view examples = help_examples(command.name);
  const std::size_t begin = examples.find("Examples:");
  RoffPage page(page_of(command), 1, edition.date, edition.version);
  page.name(page_of(command), summary_of(command));
  add_synopsis(page, command, *text);
  page.section("DESCRIPTION");
  page.prose(text->description, text->operands);
  // What stands before "Examples:" belongs here.
  if (begin > 0) page.prose(examples.substr(0, examples.find_last_not_of('\n', begin - 1) + 1));
  if (command.name.empty()) add_verbs(page, table);
  add_options(page, command);
  add_examples(page, examples.substr(begin));
  add_exit_codes(page);
  add_environment(page, command);
  add_files(page, command);
  add_see_also(page, table, command);
  return page.text();
}

}  // namespace gltfx::tool
