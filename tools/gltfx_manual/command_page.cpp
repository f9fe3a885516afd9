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
    R"(gltfx validates and fixes glTF 2.0 assets from any source, upgrades legacy extensions to their
successors without changing anything else, and renders pictures of assets on the CPU. Each task is
a verb with its own page.

Assets are not trusted. Nothing outside the folder of an asset is opened unless `--root` names
another one, and images and compressed geometry are decoded by separate programs with limits on
memory and time. A verb writes files only if an option says so.)";

constexpr std::string_view kValidate =
    R"(Checks assets against the core specification of glTF 2.0 and all extensions with a schema: the
container, the JSON text, types and ranges, references, accessors, compressed geometry and
images. Each finding has a code, a place, what was expected and, if the fix is certain, a help
line; gltfx-explain(1) explains a code.

A PATH is a file, a folder that is searched for .gltf, .glb and .vrm files, a glob, or - for one
asset on standard input. Findings go to standard output as text; other formats replace the text or
are written to files in addition, any number of them.

Images are checked by their headers. `--pixels` says whether pixels are decoded for the rules that
need them.

gltfx.toml(5) sets options for every run in a folder.)";

constexpr std::string_view kFix =
    R"(Fixes findings of gltfx-validate(1) whose fix is certain: pictures, animations and names stay,
within the tolerances that gltfx-explain(1) states, and so does every byte that need not change.

Without `--in-place` or `--output` nothing is written: the verb prints what would be done. Fixes
that lose something are done if `--only` names them and `--unsafe` is given.

Fixes run until none is left to do. The new asset is validated before it replaces the old one; a fix
that would cause a new finding is left out and named. If a fix changes bytes of a buffer, that buffer
is rewritten before the asset. A file is replaced whole or not at all, and not if it changed
meanwhile, is not a regular file or has other hard links.)";

constexpr std::string_view kUpgrade =
    R"(Replaces legacy extensions by their successors. The picture stays the same, and so does every byte
of the file that need not change.

Without `--in-place` or `--output` nothing is written: the verb prints what would be done, and why.
Upgrades with a loss are left out and named unless `--unsafe` is given; extensions whose successor is
a draft, and extensions of vendors, are upgraded on request only, with `--only` or `--to`.

The new asset is validated before it replaces the old one. A file is replaced whole or not at all,
and not if it changed meanwhile, is not a regular file or has other hard links. A new image is stored
like the old one: in the binary chunk of a GLB, in a file beside the asset, or in a data URI.)";

constexpr std::string_view kEdit =
    R"(Deletes elements of arrays, or members, that JSON pointers name. Every index and every JSON pointer
to an object after them is renumbered, in the core of glTF and in all extensions that gltfx or a
`--schema` describes. All other bytes of the file stay.

References to deleted values are listed, and the file is not changed. With `--cascade` they are
deleted, too: an entry of a list, an optional member, else the object. Objects that a deleted object
referred to stay.

Without `--in-place` or `--output` nothing is written: the verb prints what would be done. The new
asset is validated before it replaces the old one. A file is replaced whole or not at all, and not if
it changed meanwhile, is not a regular file or has other hard links.)";

constexpr std::string_view kConvert =
    R"(Stores assets in another way: as one GLB, as JSON text with files for buffers and images, or with data
URIs. All bytes stay, and so does the text but for `uri`, `buffer`, offsets and the buffer views of images:
names, order, `extras`, extensions and the spelling of numbers are as they were.

The form is that of `--to`, or the one that the name of the output tells. Buffers become one in a GLB; an
extension that may hold an index of a buffer, and that neither gltfx nor a `--schema` describes, refuses that by
name. Images become files under their names. What is refused is listed, and nothing is written unless
`--partial` is given.

Without `--output` nothing is written: the verb says what would be done. The new asset is validated before it
takes its place. A file is written whole or not at all, and none with other bytes is replaced by a buffer or an
image.)";

constexpr std::string_view kCompare =
    R"(Tells what changed between two assets, or between the assets of two folders. Objects are matched
by content, name and context first, then their values are compared, so that other numbers, another
order, another container or another codec are no change. Each change has a kind, which
gltfx-explain(1) describes, and the JSON pointer of the most specific value.

The answer is a level: `identical` (the same bytes), `storage` (each value is the same, stored
differently), `bounds` (each difference is within the bound of its kind) or `differs`. The exit code
is 0 up to `storage`, or up to `bounds` with `--bounds`; `--allow` changes that. It is 1 as well if
something could not be compared.)";

constexpr std::string_view kHook =
    R"(Runs gltfx-validate(1), gltfx-fix(1) or gltfx-upgrade(1) with their options on the assets
of the next Git commit. PATH names changed files in addition to those that Git lists.)";

constexpr std::string_view kBake =
    R"(Draws assets with a path tracer that reads materials as the specification and the material
extensions define them. It needs no display, network or environment file: it frames the asset and
adds a studio light and a backdrop. The same program, asset, options and seed give the
same bytes for any number of threads.

An asset with errors is drawn as far as possible; `--strict` refuses it with its findings. A note
names everything that is drawn differently, such as an image that cannot be read. Several assets need
an output folder, and also get a contact sheet.)";

constexpr std::string_view kReport =
    R"(Writes one page of HTML about an asset or a library: verdicts, findings with the line they are
about, pictures, sizes, triangles and textures, extensions and what gltfx-upgrade(1) would change.
The page is a single file, and can be filtered by text, path, verdict and rule.

It takes the options of gltfx-validate(1), and has the same exit codes.)";

constexpr std::string_view kInspect =
    R"(Lists the contents of an asset, valid or not, and the bytes that each part takes: each byte of its
files counts once, for the mesh, image, animation or skin that refers to it. Memory of the graphics
card is an estimate: images with all mipmaps, geometry decompressed.)";

constexpr std::string_view kMerge =
    R"(Merges reports that `gltfx validate --format jsonl=REPORT` has written into the report of one run
on all inputs, in any format. It names missing parts of `--shard`.)";

constexpr std::string_view kExplain =
    R"(Prints why a rule exists, how to fix a finding, an asset that raises it, the report on
that asset, and the same asset fixed.)";

constexpr std::string_view kRules =
    R"(Prints the code, severity and summary of every rule. `--format json` prints all
data of gltfx-explain(1) as one object.)";

constexpr std::string_view kTargets =
    R"(Shows what versions of engines do with features of glTF: refuse the asset, ignore the feature,
read or draw it. The data was measured; an empty field was not. `gltfx validate --target` reports
the outcomes for an asset.)";

constexpr std::string_view kSchema =
    R"(Shows the schema of an extension or of a type of the core specification: properties with types,
ranges and defaults, the channels that texture slots read, relations to other extensions, and the
upgrade to a successor. Without a NAME it lists all extensions.)";

constexpr std::string_view kConfig =
    R"(Shows every value of the configuration that applies to a path, or to all paths, and the line of
gltfx.toml(5) or the default that it comes from. `gltfx config import FILE` converts a configuration
of the Khronos validator, in YAML, or of the Khronos glTF Asset Auditor, in JSON, to one of gltfx.)";

constexpr std::string_view kMeasures =
    R"(Lists what can be measured in an asset and limited by `budgets` in gltfx.toml(5): the name, what
has it (the asset, each mesh and so on), and its unit. With a NAME it prints the definition of that
measure, an example and its values.)";

constexpr std::string_view kPresets =
    R"(Lists published limits of platforms and guidelines, with the source and date of each. With an ID
it prints the limits, as `extends` in gltfx.toml(5) and `--preset` of gltfx-validate(1) apply them.)";

constexpr std::array<VerbText, 19> kTexts{{
    {"", "VERB [OPTION]... [ARGUMENT]...", kProgram},
    {"validate", "PATH...", kValidate},
    {"fix", "PATH...", kFix},
    {"upgrade", "PATH...", kUpgrade},
    {"edit", "PATH...", kEdit},
    {"convert", "PATH...", kConvert},
    {"compare", "OLD NEW", kCompare},
    {"hook", "VERB [OPTION]... [PATH]...", kHook},
    {"bake", "PATH...", kBake},
    {"report", "PATH...", kReport},
    {"inspect", "PATH...", kInspect},
    {"merge", "REPORT...", kMerge},
    {"explain", "CODE...", kExplain},
    {"rules", "", kRules},
    {"targets", "[NAME[@VERSION]]...", kTargets},
    {"schema", "[NAME]", kSchema},
    {"measures", "[NAME]", kMeasures},
    {"presets", "[ID]", kPresets},
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
