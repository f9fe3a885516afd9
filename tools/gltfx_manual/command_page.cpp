// SPDX-License-Identifier: Apache-2.0
// gltfx(1) and gltfx-VERB(1).
#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "commands.hpp"
#include "help_text.hpp"
#include "pages.hpp"
#include "roff.hpp"

namespace gltfx::tool {
namespace {

struct VerbText {
  std::string_view verb;
  std::string_view operands;     ///< text after the options: "PATH..."; may be empty
  std::string_view description;  ///< paragraphs of prose, separated by blank lines
};

constexpr std::string_view kProgram =
    R"(gltfx opens glTF 2.0 assets from any source and says what is wrong with them and where, brings
extensions of former drafts to those of today without touching anything else, and draws pictures of
assets on the CPU. Each job is a verb with a page of its own.

Assets are not trusted. Nothing outside the folder of an asset is opened unless `--root` names
another one, and images and compressed geometry are decoded by separate programs with limits on
memory and time. A verb writes nothing that it was not told to write.)";

constexpr std::string_view kValidate =
    R"(Checks assets against the core specification of glTF 2.0 and all extensions that gltfx knows:
the container, the JSON text, types and ranges, references, accessors, compressed geometry and
images. Each finding has a code, a place, what was expected and, where there is one, a way to fix
it; gltfx-explain(1) tells more about a code.

A PATH is a file, a folder that is searched for .gltf, .glb and .vrm files, a glob, or - for one
asset on standard input. Findings go to standard output as text; other formats replace the text or
are written to files in addition, any number of them.

Images are judged by their headers. Where a rule needs pixels, `--pixels` says whether they are
decoded.

gltfx.toml(5) sets options for every run in a folder.)";

constexpr std::string_view kFix =
    R"(Fixes findings of gltfx-validate(1) whose fix is certain: pictures, animations and names stay,
within the tolerances that gltfx-explain(1) states, and so does every byte that need not change.

Without `--in-place` or `--output` nothing is written: the verb says what would be done. Fixes that
lose something are done when `--only` names them and `--unsafe` is given.

Fixes run until none is left to do. The new asset is validated before it takes the place of the old
one; a fix that would bring a finding which was not there is left out and named. A fix that changes
bytes of a buffer writes that buffer anew, before the asset. A file is replaced whole or not at all,
and not when it changed meanwhile, is no regular file or has other hard links.)";

constexpr std::string_view kUpgrade =
    R"(Legacy extensions become what took their place. The picture stays the same, and so does
every byte of the file that need not change.

Without `--in-place` or `--output` nothing is written: the verb says what would be done, and why.
What cannot be done without a loss is left alone and named unless `--unsafe` is given; extensions
that become a draft or belong to a vendor are upgraded when they are asked for with `--only` or
`--to`.

The new asset is validated before it takes the place of the old one. A file is replaced whole or not
at all, and not when it changed meanwhile, is no regular file or has other hard links. Where an
image has to be made anew it goes where the old one was: into the binary chunk of a GLB, into a file
beside the asset, or into a data URI.)";

constexpr std::string_view kEdit =
    R"(Deletes elements of arrays, or members, that JSON pointers name. Every index and every JSON pointer
to an object after them is renumbered, in the core of glTF and in all extensions that gltfx or a
`--schema` describes. All else in the file stays byte for byte.

What refers to something that would go is listed, and the file stays as it is. With `--cascade` it
goes, too: an entry of a list alone, a member alone where the object can be without it, else the
object. What a deleted object referred to stays.

Without `--in-place` or `--output` nothing is written: the verb says what would be done. The new asset
is validated before it takes the place of the old one. A file is replaced whole or not at all, and not
when it changed meanwhile, is no regular file or has other hard links.)";

constexpr std::string_view kHook =
    R"(Runs gltfx-validate(1), gltfx-fix(1) or gltfx-upgrade(1) with their options over the assets of a commit of
git that is about to be made. PATH names files that changed besides those that git knows of.)";

constexpr std::string_view kBake =
    R"(Draws assets with a path tracer that reads materials as the specification and the material
extensions have them. It needs no display, no network and no environment file: it frames what it has
never seen and brings its own light and backdrop. The same program, asset, options and seed give the
same bytes for any number of threads.

What can be drawn of an asset with errors is drawn; `--strict` refuses it with its findings. What is
drawn differently, such as an image that cannot be read, is named in a note. Several assets need a folder
to write to, and get a contact sheet besides.)";

constexpr std::string_view kReport =
    R"(Writes one page of HTML about an asset or a library: verdicts, findings with the line they are
about, pictures, sizes, triangles and textures, extensions and what gltfx-upgrade(1) would change.
The page needs nothing but itself, and can be filtered by text, path, verdict and rule.

It asks for the same things as gltfx-validate(1), and ends with the same exit codes.)";

constexpr std::string_view kInspect =
    R"(Says what is in an asset, valid or not, and where its bytes go: each byte of its files counts
once, for the mesh, image, animation or skin that refers to it. Memory of the graphics card is an
estimate: images with all mipmaps, geometry decompressed.)";

constexpr std::string_view kMerge =
    R"(Puts reports that `gltfx validate --format jsonl=REPORT` has written together, and makes of
them what one run over all inputs would have written, in any format. With parts of `--shard` it says
which of them is missing.)";

constexpr std::string_view kExplain =
    R"(Prints why a rule exists, what to do about a finding, an asset that raises it, how that is
reported, and the same asset fixed.)";

constexpr std::string_view kRules =
    R"(Prints the code, severity and summary of every rule. With `--format json` all that
gltfx-explain(1) knows of them comes as one object.)";

constexpr std::string_view kTargets =
    R"(Shows what versions of engines do with features of glTF: refuse the asset, ignore the feature,
read or draw it. The data was measured; an empty field was not. `gltfx validate --target` reports
what concerns an asset.)";

constexpr std::string_view kSchema =
    R"(Shows what gltfx knows of an extension or of a type of the core specification: properties with
types, ranges and defaults, the channels that texture slots read, what goes together and what does
not, and the way to a successor. Without a NAME it lists all extensions.)";

constexpr std::string_view kConfig =
    R"(Shows every value of the configuration that holds for a path, or for all paths, and the line of
gltfx.toml(5) or the default that says so. `gltfx config import FILE` prints a configuration of the
Khronos validator, in YAML, as one of gltfx.)";

constexpr std::array<VerbText, 15> kTexts{{
    {"", "VERB [OPTION]... [ARGUMENT]...", kProgram},
    {"validate", "PATH...", kValidate},
    {"fix", "PATH...", kFix},
    {"upgrade", "PATH...", kUpgrade},
    {"edit", "PATH...", kEdit},
    {"hook", "VERB [OPTION]... [PATH]...", kHook},
    {"bake", "PATH...", kBake},
    {"report", "PATH...", kReport},
    {"inspect", "PATH...", kInspect},
    {"merge", "REPORT...", kMerge},
    {"explain", "CODE...", kExplain},
    {"rules", "", kRules},
    {"targets", "[NAME[@VERSION]]...", kTargets},
    {"schema", "[NAME]", kSchema},
    {"config", "[PATH | import FILE]", kConfig},
}};

// The text of a verb, or of the program for an empty name; null for an unknown verb.
const VerbText* find_verb_text(std::string_view verb) {
  const auto* const found = std::find_if(kTexts.begin(), kTexts.end(),
                                         [&](const VerbText& text) { return text.verb == verb; });
  return found == kTexts.end() ? nullptr : found;
}

// The summary after a name, from "Check .gltf, .glb and .vrm files".
std::string summary_of(const CommandEntry& command) {
  if (command.name.empty()) return "validate, fix, upgrade and draw glTF 2.0 assets";
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
  if (!command.positional.name.empty()) {
    page.item(roff_value(command.positional.name), fmt::format("{}.", command.positional.text));
  }
  for (const OptionEntry& option : command.options) {
    page.item(tag_of(option), fmt::format("{}.", option.text), option.type);
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
  page.prose("If several apply, the status is the first of 4, 2, 3 and 1 that does.");
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

// Lines of two columns: a command and its effect.
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
  // The text before "Examples:" belongs here.
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
