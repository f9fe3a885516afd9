// SPDX-License-Identifier: Apache-2.0
#include "verb_texts.hpp"

#include <algorithm>
#include <array>

namespace gltfx::tool {
namespace {

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

A PATH is a file, a folder that is searched for .gltf and .glb files, a glob, or - for one asset on
standard input. Findings go to standard output as text; other formats can take its place or be
written to files beside it, as many as are asked for.

Images are judged by their headers. Where a rule needs pixels, `--pixels` says whether they are
decoded.

What is asked of every run in a folder can stand in gltfx.toml(5).)";

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

constexpr std::string_view kHook =
    R"(Runs gltfx-validate(1) or gltfx-upgrade(1) with their options over the assets of a commit of
git that is about to be made. PATH names files that changed besides those that git knows of.)";

constexpr std::string_view kBake =
    R"(Draws assets with a path tracer that reads materials as the specification and the material
extensions have them. It needs no display, no network and no environment file: it frames what it has
never seen and brings its own light and backdrop. The same program, asset, options and seed give the
same bytes for any number of threads.

An asset with errors is refused with its findings unless `--force` is given. What is drawn
differently, such as an image that cannot be read, is named in a note. Several assets need a folder
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

constexpr std::string_view kSchema =
    R"(Shows what gltfx knows of an extension or of a type of the core specification: properties with
types, ranges and defaults, the channels that texture slots read, what goes together and what does
not, and the way to a successor. Without a NAME it lists all extensions.)";

constexpr std::string_view kConfig =
    R"(Shows every value of the configuration that holds for a path, or for all paths, and the line of
gltfx.toml(5) or the default that says so. `gltfx config import FILE` prints a configuration of the
Khronos validator, in YAML, as one of gltfx.)";

constexpr std::array<VerbText, 12> kTexts{{
    {"", "VERB [OPTION]... [ARGUMENT]...", kProgram},
    {"validate", "PATH...", kValidate},
    {"upgrade", "PATH...", kUpgrade},
    {"hook", "VERB [OPTION]... [PATH]...", kHook},
    {"bake", "PATH...", kBake},
    {"report", "PATH...", kReport},
    {"inspect", "PATH...", kInspect},
    {"merge", "REPORT...", kMerge},
    {"explain", "CODE...", kExplain},
    {"rules", "", kRules},
    {"schema", "[NAME]", kSchema},
    {"config", "[PATH | import FILE]", kConfig},
}};

}  // namespace

const VerbText* find_verb_text(std::string_view verb) {
  const auto* const found = std::find_if(kTexts.begin(), kTexts.end(),
                                         [&](const VerbText& text) { return text.verb == verb; });
  return found == kTexts.end() ? nullptr : found;
}

}  // namespace gltfx::tool
