// SPDX-License-Identifier: Apache-2.0
#include "help_text.hpp"

#include <iterator>

#include <fmt/format.h>

#include "commands.hpp"

namespace gltfx::tool {
namespace {

constexpr std::string_view kProgramExamples = R"(Examples:
  gltfx validate model.glb           validate an asset
  gltfx validate assets/ --jobs 4    validate a folder
  gltfx fix assets/ --in-place       apply safe fixes
  gltfx upgrade assets/ --in-place   upgrade legacy extensions
  gltfx bake model.glb -o model.png  render a preview
  gltfx report assets/ -o r.html     write an HTML page
  gltfx inspect model.glb            show the content and its size
  gltfx explain VALUE_NOT_IN_RANGE   explain a rule
  gltfx schema KHR_materials_volume  show the schema of an extension
  gltfx VERB --help                  show the options of a verb
)";

constexpr std::string_view kValidateExamples =
    R"(Formats: text, json, jsonl, khronos, github, gitlab, sarif, junit, agent, csv.

Examples:
  gltfx validate model.gltf
  gltfx validate assets/ 'props/**/*.glb' --fail-on warning
  gltfx validate assets/ --format text --format json=report.json
  cat model.glb | gltfx validate - --format json
  gltfx validate assets/ --write-baseline known.json   once, then:
  gltfx validate assets/ --baseline known.json         fails on new findings
  gltfx validate model.gltf --schema ACME_leaf.schema.json
  gltfx validate library/ --cache .gltfx-cache         checks changed files only
)";

constexpr std::string_view kFixExamples = R"(Examples:
  gltfx fix model.gltf                      dry run: nothing is written
  gltfx fix model.gltf --diff               show the changes
  gltfx fix assets/ --in-place --backup     safe fixes only
  gltfx fix assets/ --check                 for CI: exit 1 if work is left
  gltfx fix assets/ -o fixed/               copy the tree with its resources
  gltfx fix model.glb --only ACCESSOR_MIN_MISMATCH,ACCESSOR_MAX_MISMATCH
  gltfx fix model.gltf --unsafe --only EXTENSION_NAME_MISSPELT --in-place
)";

constexpr std::string_view kUpgradeExamples = R"(Examples:
  gltfx upgrade model.gltf                  dry run: nothing is written
  gltfx upgrade model.gltf --diff           show the changes
  gltfx upgrade assets/ --in-place          safe upgrades only
  gltfx upgrade model.glb -o new.glb --pack --prune   with fewer images
  gltfx upgrade assets/ --in-place --verify   only if the pictures stay the same
  gltfx upgrade assets/ --check             for CI: exit 1 if work is left
  gltfx upgrade assets/ -o current/         copy the tree with its resources
  gltfx upgrade old.glb -o new.glb --unsafe --generation v2
  gltfx upgrade wax.gltf --only KHR_materials_sss --in-place   opt in to a draft
  gltfx upgrade wax.gltf --to KHR_materials_scatter --in-place
)";

constexpr std::string_view kEditExamples = R"(Examples:
  gltfx edit model.gltf --delete /meshes/3   dry run: what goes, what refers
  gltfx edit model.gltf --delete /nodes/7 --cascade --diff
  gltfx edit model.glb --delete /animations/0 --delete /animations/2 -o new.glb
  gltfx edit model.glb --delete /materials/1 --cascade --in-place --backup
)";

constexpr std::string_view kConvertExamples = R"(Examples:
  gltfx convert chair.gltf -o chair.glb          pack into one file
  gltfx convert chair.glb -o parts/chair.gltf    unpack buffer and images
  gltfx convert chair.gltf --to glb              dry run: nothing is written
  gltfx convert assets/ -o packed/ --to glb --jobs 4
)";

constexpr std::string_view kCompareExamples = R"(Examples:
  gltfx compare old.glb new.glb              what changed; exit 1 if it did
  gltfx compare in.glb out.glb --bounds      within the bounds of an optimizer
  gltfx compare in.glb out.glb --drawn --bounds position=0.1%,normal=2deg
  gltfx compare old/ new/ --format markdown  folders, paired by path
)";

constexpr std::string_view kBakeExamples = R"(Examples:
  gltfx bake model.glb -o model.png
  gltfx bake assets/ -o thumbnails/ --size 256      previews and a contact sheet
  gltfx bake model.glb -o model.webp --background transparent
  gltfx bake model.glb -o turn.webp --turntable 36     an animation
  gltfx bake model.glb -o walk.webp --clip Walk
  gltfx bake model.glb -o still.exr --samples 1024 --environment sky.hdr
  gltfx bake old.glb --compare new.glb -o difference.png
  gltfx bake model.glb --embed                      write asset.thumbnail
)";

constexpr std::string_view kReportExamples = R"(Examples:
  gltfx report assets/ -o report.html                   one page with previews
  gltfx report model.glb -o model.html --profile strict
  gltfx report assets/ -o report.html --no-thumbnails --fail-on never
)";

constexpr std::string_view kInspectExamples = R"(Examples:
  gltfx inspect model.glb               counts, sizes, extensions, images
  gltfx inspect model.glb --top 0       all rows
  gltfx inspect assets/ --format json | jq '.assets[].facts.bytes.total'
)";

constexpr std::string_view kHookExamples =
    R"(Runs on the staged assets, and on assets that reference a staged or deleted
file. Fails if a referenced file is not staged.

Examples:
  gltfx hook fix --in-place              lists the files to stage
  gltfx hook upgrade --check             in .git/hooks/pre-commit
  gltfx hook upgrade --in-place          lists the files to stage
  gltfx hook validate --fail-on warning
)";

constexpr std::string_view kMergeExamples =
    R"(Formats: text, json, jsonl, khronos, github, gitlab, sarif, junit, agent, csv.

Examples:
  gltfx merge 1.jsonl 2.jsonl --format sarif=report.sarif   from:
  gltfx validate library/ --shard 1/2 --format jsonl=1.jsonl
  gltfx validate library/ --shard 2/2 --format jsonl=2.jsonl
  gltfx merge 1.html 2.html -o all.html                     from:
  gltfx report library/ --shard 1/2 -o 1.html
  gltfx report library/ --shard 2/2 -o 2.html
)";

constexpr std::string_view kExplainExamples = R"(Examples:
  gltfx explain UNDEFINED_PROPERTY
  gltfx explain value_not_in_range
)";

constexpr std::string_view kRulesExamples = R"(Examples:
  gltfx rules
  gltfx rules --format json | jq -r '.rules[].code'
  gltfx rules --new ACME_MESH_NAME --on mesh
  gltfx rules --test house/
)";

constexpr std::string_view kTargetsExamples = R"(Examples:
  gltfx targets                         the newest version of each engine
  gltfx targets three@0.160 three       two versions of one engine
  gltfx targets three --format json     all versions of an engine as JSON
)";

constexpr std::string_view kSchemaExamples = R"(Examples:
  gltfx schema                          all extensions with their status
  gltfx schema --status draft           those that can still change
  gltfx schema KHR_materials_ior        properties, ranges, defaults, exclusions
  gltfx schema material --format json   a core type as JSON
)";

constexpr std::string_view kMeasuresExamples = R"(Examples:
  gltfx measures                        names, elements, units
  gltfx measures triangles              definition, example, values
)";

constexpr std::string_view kPresetsExamples = R"(Examples:
  gltfx presets                         identifiers, dates, sources
  gltfx presets shopify                 the limits of one
)";

constexpr std::string_view kConfigExamples = R"(Examples:
  gltfx config                          global settings and their source
  gltfx config props/lamp.glb           settings for a path
  gltfx config import khronos.yaml >gltfx.toml
)";

}  // namespace

std::string_view help_examples(std::string_view verb) {
  if (verb == "validate") return kValidateExamples;
  if (verb == "fix") return kFixExamples;
  if (verb == "upgrade") return kUpgradeExamples;
  if (verb == "edit") return kEditExamples;
  if (verb == "convert") return kConvertExamples;
  if (verb == "compare") return kCompareExamples;
  if (verb == "bake") return kBakeExamples;
  if (verb == "report") return kReportExamples;
  if (verb == "inspect") return kInspectExamples;
  if (verb == "hook") return kHookExamples;
  if (verb == "merge") return kMergeExamples;
  if (verb == "explain") return kExplainExamples;
  if (verb == "rules") return kRulesExamples;
  if (verb == "targets") return kTargetsExamples;
  if (verb == "schema") return kSchemaExamples;
  if (verb == "measures") return kMeasuresExamples;
  if (verb == "presets") return kPresetsExamples;
  if (verb == "config") return kConfigExamples;
  return kProgramExamples;
}

std::string help_footer(std::string_view verb) {
  std::string footer = fmt::format("{}\nExit codes (4 before 2 before 3 before 1):\n{}",
                                   help_examples(verb), exit_code_table());
  footer.pop_back();  // CLI11 ends the help with a line break
  return footer;
}

std::string exit_code_table() {
  std::string table;
  for (const ExitCodeEntry& entry : kExitCodes) {
    fmt::format_to(std::back_inserter(table), "  {}  {}\n", static_cast<int>(entry.code),
                   entry.meaning);
  }
  return table;
}

}  // namespace gltfx::tool
